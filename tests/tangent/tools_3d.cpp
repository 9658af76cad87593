// SPDX-License-Identifier: BSL-1.0
// The tools of space: gap, normal and Hessian belong to one another, on, off and inside the surface.
#include <stickslip/geometry/any_of.hpp>
#include <stickslip/geometry/extruded.hpp>
#include <stickslip/geometry/revolution.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <random>

#include "tools_3d.hpp"

namespace tools_3d {

using namespace tools_3d;
static_assert(RigidTool<rigid::Revolution, 3> && RigidTool<rigid::Extruded, 3>);
static_assert(RigidTool<rigid::AnyOf<rigid::Revolution, rigid::Extruded>, 3>);

struct Where {
  bool has_normals = true;  // not so at an apex
  bool one_piece = true;    // not so where the curvature jumps
};

// Derivatives at random points of the box of `size` about `centre`; `expected(x)` is the gap.
template <class Tool, class Gap>
void check_tool(const Tool& tool, const V3& centre, Real size, Gap&& expected, Where where = {}) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> u(-1, 1);
  Real worst = 0, worst_gap = 0, worst_third = 0;
  for (int i = 0; i < 300; ++i) {
    V3 x = centre + size * V3(u(random), u(random), u(random));
    if (where.has_normals && i % 3 == 0) {  // on the surface
      const auto at = tool.distance(x);
      x -= at.gap * at.normal;
      CHECK(std::abs(tool.distance(x).gap) < 1e-12);
    }
    worst = std::max(worst, derivatives(tool, x).worst());
    worst_gap = std::max(worst_gap, std::abs(tool.distance(x).gap - expected(x)));
    if (where.one_piece) worst_third = std::max(worst_third, third_derivative(tool, x, 1e-3));
  }
  CHECK(worst < 1e-9);
  CHECK(worst_gap < 1e-12);
  CHECK(worst_third < 1e-4);
}

const V3 centre(1, -2, 0.5), axis(1, 2, 2), a = axis / 3;
Real height(const V3& x) {
  return (x - centre).dot(a);
}
Real radius(const V3& x) {
  return (x - centre - height(x) * a).norm();
}

TEST_CASE("a plane in space has the exact gap, normal and derivatives") {
  check_tool(rigid::plane(centre, axis), centre, 2, [](const V3& x) { return height(x); });
}
TEST_CASE("a sphere and a cavity have the exact gap, normal and derivatives") {
  check_tool(rigid::sphere(centre, 1.5), centre + V3(2, 0, 0), 1.6,
             [](const V3& x) { return (x - centre).norm() - 1.5; });
  check_tool(rigid::cavity(centre, 4.5), centre + V3(2, 1, 0), 0.9,
             [](const V3& x) { return 4.5 - (x - centre).norm(); });
}
TEST_CASE("a cylinder and a tube have the exact gap, normal and derivatives") {
  const V3 beside = centre + 2 * rigid::detail::perpendicular(a);
  check_tool(rigid::cylinder(centre, axis, 1.5), beside, 0.7, [](const V3& x) { return radius(x) - 1.5; });
  check_tool(rigid::tube(centre, axis, 1.5), beside, 0.7, [](const V3& x) { return 1.5 - radius(x); });
}
TEST_CASE("a cone and a funnel have the exact gap, normal and derivatives") {
  const Real alpha = 0.6, s = std::sin(alpha), c = std::cos(alpha);
  const V3 beside = centre + 3 * a + 2 * rigid::detail::perpendicular(a);
  const auto gap = [&](const V3& x) { return c * radius(x) - s * height(x); };
  check_tool(rigid::cone(centre, axis, alpha), beside, 0.8, gap);
  check_tool(rigid::funnel(centre, axis, alpha), beside, 0.8, [&](const V3& x) { return -gap(x); });
  // Past the apex it is the closest point: outside the cone, and inside the funnel's wall.
  const auto past = [](const V3& x) { return (x - centre).norm(); };
  check_tool(rigid::cone(centre, axis, alpha), centre - 2 * a, 0.5, past, {.has_normals = false});
  check_tool(rigid::funnel(centre, axis, alpha), centre - 2 * a, 0.5, [&](const V3& x) { return -past(x); },
             {.has_normals = false});
}
TEST_CASE("a torus has the exact gap, normal and derivatives") {
  check_tool(rigid::torus(centre, axis, 3, 1), centre + 3 * rigid::detail::perpendicular(a) + V3(0.3, 0.2, 0.4), 0.8,
             [](const V3& x) { return std::hypot(radius(x) - 3, height(x)) - 1; });
}
TEST_CASE("a surface of revolution has the gap of its meridian") {
  const rigid::Profile punch = rigid::path({0, -1}, {1, 0}).left(1, pi / 2).straight(2);
  const rigid::Revolution tool(punch, centre, axis);
  const V3 e = rigid::detail::perpendicular(a);
  check_tool(tool, centre + 1.3 * e, 0.6,
             [&](const V3& x) { return punch.closest(Vec<Real, 2>(radius(x), height(x))).gap; }, {.one_piece = false});
}

TEST_CASE("an extruded profile has the gap of its section") {
  const auto bead = rigid::path({-3, 0}, {1, 0}).straight(2).left(0.4, 0.7).straight(1).endless();
  const V3 e = rigid::detail::perpendicular(a), f = cross(a, e);
  const rigid::Extruded tool(bead, centre, 2 * e, 3 * f);
  check_tool(tool, centre - 0.88 * e + 0.08 * f, 0.05,
             [&](const V3& x) { return bead.closest(Vec<Real, 2>((x - centre).dot(e), (x - centre).dot(f))).gap; });
}

TEST_CASE("surfaces of revolution are exact on the axis and near it") {
  // Tips above and below: a sphere by its meridian, a hemispherical punch whose meridian ends on the axis, a plane, an
  // apex seen from outside.
  const V3 e = (rigid::detail::perpendicular(a) + 0.3 * cross(a, rigid::detail::perpendicular(a))).normalized();
  const rigid::Revolution punch(rigid::path({0, -2}, {1, 0}).left(2, pi / 2).straight(2), centre, axis);
  const rigid::Revolution ball(rigid::disc({0, 0}, 2), centre, axis), plane = rigid::plane(centre, axis),
                                                                      cone = rigid::cone(centre, axis, 0.5);
  for (const Real r : {0.0, 1e-300, 1e-13, 1e-9, 1e-7, 0.9e-6, 1.1e-6, 1e-5, 1e-3, 0.1}) {
    for (const Real z : {-2.5, -2.0, -1.5, 2.2}) {
      CAPTURE(r);
      CAPTURE(z);
      const V3 x = centre + z * a + r * e;
      const auto at = ball.distance(x);
      const V3 out = (x - centre).normalized();
      const Mat<Real, 3> hess = (Mat<Real, 3>::Identity() - out * out.transpose()) / (x - centre).norm();
      CHECK(std::abs(at.gap - ((x - centre).norm() - 2)) < 1e-14);
      CHECK((at.normal - out).norm() < 1e-14);
      CHECK((at.hess_gap - hess).norm() < 1e-8);
      CHECK(derivatives(ball, x).worst() < 1e-8);
      if (z < 0) {
        const auto inside = punch.distance(x);  // the body is inside the bowl
        CHECK(std::abs(inside.gap + at.gap) < 1e-14);
        CHECK((inside.normal + out).norm() < 1e-14);
        CHECK((inside.hess_gap + hess).norm() < 1e-8);
        CHECK(derivatives(punch, x).worst() < 1e-8);
        CHECK(std::abs(cone.distance(x).gap - (x - centre).norm()) < 1e-14);
        CHECK((cone.distance(x).hess_gap - hess).norm() < 1e-8);
        CHECK(derivatives(cone, x).worst() < 1e-8);
      }
      CHECK(std::abs(plane.distance(x).gap - z) < 1e-14);
      CHECK(plane.distance(x).hess_gap.norm() < 1e-14);
      CHECK(derivatives(plane, x).worst() < 1e-14);
    }
  }
  // Third derivatives on the axis: those of a sphere.
  CHECK(third_derivative(ball, centre - 2.1 * a, 1e-3) < 1e-6);
}

TEST_CASE("where the closest points form a circle one of them is taken") {
  for (const auto& tool :
       {rigid::cylinder(centre, axis, 2), rigid::tube(centre, axis, 2), rigid::torus(centre, axis, 3, 1)}) {
    const auto at = tool.distance(centre);
    CHECK(std::abs(std::abs(at.gap) - 2) < 1e-8);
    CHECK(std::abs(at.normal.norm() - 1) < 1e-14);
    CHECK(at.hess_gap.allFinite());
    CHECK(derivatives(tool, centre).worst() < 1e-9);
  }
  const auto at = rigid::cone(centre, axis, 0.5).distance(V3(centre + 2 * a));
  CHECK(std::abs(at.gap + 2 * std::sin(0.5)) < 1e-8);
  CHECK(at.hess_gap.allFinite());
}

TEST_CASE("a rotated axis rotates gap gradient and Hessian") {
  const auto upright = rigid::torus({0, 0, 0}, {0, 0, 1}, 3, 1);
  const auto tilted = rigid::torus({0, 0, 0}, {0, -std::sin(0.4), std::cos(0.4)}, 3, 1);
  Mat<Real, 3> Q;
  Q << 1, 0, 0, 0, std::cos(0.4), -std::sin(0.4), 0, std::sin(0.4), std::cos(0.4);
  for (const V3& x : {V3(2.5, 1, 0.3), V3(-3, 2, 1), V3(0.1, -1.5, -0.7)}) {
    const auto at = upright.distance(x), turned = tilted.distance(V3(Q * x));
    CHECK(std::abs(at.gap - turned.gap) < 1e-14);
    CHECK((Q * at.normal - turned.normal).norm() < 1e-14);
    CHECK((Q * at.hess_gap * Q.transpose() - turned.hess_gap).norm() < 1e-14);
  }
}

TEST_CASE("AnyOf has the gap and normal of the tool that it holds") {
  using Any = rigid::AnyOf<rigid::Revolution, rigid::Extruded>;
  const auto ball = rigid::sphere(centre, 1);
  const rigid::Extruded wall(rigid::line({0, 0}, {1, 0}), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const std::vector<Any> tools{ball, wall};
  const V3 x(0.3, -0.4, 0.7);
  CHECK(!tools[0].empty());
  CHECK(tools[0].distance(x).gap == ball.distance(x).gap);
  CHECK(tools[0].distance(x).normal == ball.distance(x).normal);
  CHECK(tools[0].distance(x).hess_gap == ball.distance(x).hess_gap);
  CHECK(tools[1].distance(x).gap == doctest::Approx(-0.4));
  CHECK(tools[1].as<rigid::Extruded>() != nullptr);
  CHECK(tools[1].as<rigid::Revolution>() == nullptr);
  for (const Any& tool : tools) CHECK(derivatives(tool, x).worst() < 1e-12);
  Any copy = tools[0];
  copy = tools[1];
  CHECK(copy.distance(x).gap == tools[1].distance(x).gap);
  CHECK(Any(rigid::Revolution(rigid::path({0, 0}, {1, 0}), centre, axis)).empty());
}

TEST_CASE("the gap of an empty tool or of a point that is not finite is not a contact") {
  constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();
  const rigid::Extruded wall(rigid::line({0, 0}, {1, 0}), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (const Real bad : {nan, infinity, -infinity})
    for (int k = 0; k < 3; ++k) {
      V3 x(1, 2, 3);
      x[k] = bad;
      CHECK(std::isnan(rigid::sphere(centre, 1).distance(x).gap));
      CHECK(std::isnan(rigid::plane(centre, axis).distance(x).gap));
      CHECK(std::isnan(wall.distance(x).gap));
    }
  CHECK(std::isnan(rigid::Revolution(rigid::path({0, 0}, {1, 0}), centre, axis).distance(V3(1, 2, 3)).gap));
}

TEST_CASE("tools in space refuse wrong input by name") {
  const auto says = [](const char* part, auto&& make) {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).find(part) != std::string::npos;
    }
    return false;
  };
  const V3 zero(0, 0, 0), z(0, 0, 1), nan(0, std::nan(""), 0);
  CHECK(says("the axis", [&] { (void)rigid::plane(zero, zero); }));
  CHECK(says("the axis", [&] { (void)rigid::cylinder(zero, nan, 1); }));
  CHECK(says("the origin", [&] { (void)rigid::plane(nan, z); }));
  CHECK(says("sphere: the radius", [&] { (void)rigid::sphere(zero, 0); }));
  CHECK(says("cavity: the radius", [&] { (void)rigid::cavity(zero, -1); }));
  CHECK(says("cylinder: the radius", [&] { (void)rigid::cylinder(zero, z, std::nan("")); }));
  CHECK(says("tube: the radius", [&] { (void)rigid::tube(zero, z, -1); }));
  CHECK(says("cone: the half angle", [&] { (void)rigid::cone(zero, z, 2); }));
  CHECK(says("funnel: the half angle", [&] { (void)rigid::funnel(zero, z, 0); }));
  CHECK(says("torus: the minor radius", [&] { (void)rigid::torus(zero, z, 1, 0); }));
  CHECK(says("torus: the major radius", [&] { (void)rigid::torus(zero, z, 1, 2); }));
  CHECK(says("first direction", [&] { (void)rigid::Extruded(rigid::line({0, 0}, {1, 0}), zero, zero, z); }));
  CHECK(says("second direction", [&] { (void)rigid::Extruded(rigid::line({0, 0}, {1, 0}), zero, z, nan); }));
  CHECK(says("right angle", [&] { (void)rigid::Extruded(rigid::line({0, 0}, {1, 0}), zero, z, V3(0, 1, 1)); }));
}

}  // namespace tools_3d
