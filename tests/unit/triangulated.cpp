// SPDX-License-Identifier: BSL-1.0
// Tools of triangles: orders of convergence, continuity, the search, sharp and open edges, wrong input.
#include <stickslip/geometry/any_of.hpp>
#include <stickslip/geometry/revolution.hpp>
#include <stickslip/geometry/triangulated.hpp>

#include <doctest/doctest.h>

#include <random>

#include "../tangent/tools_3d.hpp"
#include "icosphere.hpp"

namespace {

using namespace tools_3d;
using rigid::Triangles;
using rigid::Triangulated;
static_assert(RigidTool<Triangulated, 3>);

std::vector<V3> directions(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<Real> n;
  std::vector<V3> out;
  for (int i = 0; i < count; ++i) out.push_back(V3(n(random), n(random), n(random)).normalized());
  return out;
}

// Twelve triangles, outward.
Triangles cube(Real half, bool inside_out = false) {
  Triangles s;
  for (int i = 0; i < 8; ++i) s.vertices.push_back(half * V3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  s.corners = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  if (inside_out)
    for (auto& t : s.corners) std::swap(t[1], t[2]);
  return s;
}
Real distance_to_cube(const V3& x, Real half) {
  const V3 over = x.cwiseAbs() - V3::Constant(half);
  return over.maxCoeff() > 0 ? over.cwiseMax(0).norm() : over.maxCoeff();
}

// A bar of n facets, radius 1, between z = -1 and 1, with flat ends.
Triangles bar(int n) {
  Triangles s;
  s.vertices = {{0, 0, -1}, {0, 0, 1}};
  for (int i = 0; i < n; ++i)
    for (const Real z : {-1.0, 1.0}) s.vertices.push_back({std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), z});
  for (int i = 0; i < n; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % n);
    s.corners.insert(s.corners.end(), {{a, b, b + 1}, {a, b + 1, a + 1}, {0, b, a}, {1, a + 1, b + 1}});
  }
  return s;
}

TEST_CASE("the gap of a triangulated sphere converges faster than h^3, the normal faster than h^2") {
  std::array<Real, 2> before{};
  for (const int level : {1, 2, 3, 4}) {
    const Triangulated ball(icosphere(level));
    std::array<Real, 2> worst{};
    std::mt19937 random(5);
    std::uniform_real_distribution<Real> off(-0.1, 0.1);
    for (const V3& d : directions(1000, 3)) {
      const Real g = off(random);
      const auto at = ball.distance(V3((1 + g) * d));
      worst[0] = std::max(worst[0], std::abs(at.gap - g));
      worst[1] = std::max(worst[1], (at.normal - d).norm());
    }
    MESSAGE(ball.size(), " triangles: gap ", worst[0], ", normal ", worst[1]);
    if (level > 1) {
      CHECK(std::log2(before[0] / worst[0]) > 3.5);
      CHECK(std::log2(before[1] / worst[1]) > 2.5);
    }
    before = worst;
  }
  CHECK(before[0] < 1e-6);
}

TEST_CASE("an ellipsoid converges with normals averaged from facets, and better with given ones") {
  const V3 axes(1, 0.7, 1.3);
  const V3 inverse = axes.cwiseInverse();
  std::array<std::array<Real, 2>, 2> before{};
  for (const int level : {2, 3, 4}) {
    Triangles s = icosphere(level);
    std::vector<V3> normals;
    for (V3& v : s.vertices) {
      normals.push_back(v.cwiseProduct(inverse).normalized());
      v = v.cwiseProduct(axes);
    }
    for (const bool given : {false, true}) {
      if (given) s.normals = normals;
      const Triangulated tool(s);
      std::array<Real, 2> worst{};
      for (const V3& d : directions(1000, 3)) {
        const V3 n = d.cwiseProduct(inverse).normalized();
        const auto at = tool.distance(V3(d.cwiseProduct(axes) + 0.05 * n));
        worst[0] = std::max(worst[0], std::abs(at.gap - 0.05));
        worst[1] = std::max(worst[1], (at.normal - n).norm());
      }
      MESSAGE(std::string(given ? "given" : "made"), " normals, ", tool.size(), " triangles: gap ", worst[0],
              ", normal ", worst[1], ", orders ", std::log2(before[given][0] / worst[0]), " and ",
              std::log2(before[given][1] / worst[1]));
      if (level > 2) {
        CHECK(std::log2(before[given][0] / worst[0]) > (given ? 2.5 : 1.7));
        CHECK(std::log2(before[given][1] / worst[1]) > (given ? 2 : 0.7));
      }
      before[given] = worst;
    }
  }
}

TEST_CASE("gap, normal and Hessian of a triangulated surface are consistent on, outside and inside it") {
  const Triangulated ball(icosphere(2));
  Real worst = 0, third = 0;
  for (const V3& d : directions(300, 8))
    for (const Real g : {-0.3, -1e-3, 0.0, 1e-6, 0.2, 1.0}) {
      const V3 x = (1 + g) * d;
      worst = std::max(worst, derivatives(ball, x).worst());
      // Differences must not step over an edge: only well inside a patch is the third derivative asked for.
      Real jump = 0;
      for (int k = 0; k < 3; ++k)
        for (const Real h : {-4e-4, 4e-4})
          jump = std::max(jump, (ball.distance(V3(x + h * V3::Unit(k))).hess_gap - ball.distance(x).hess_gap).norm());
      if (jump < 5e-3) third = std::max(third, third_derivative(ball, x, 1e-4));
    }
  CHECK(worst < 1e-12);
  CHECK(third < 1e-5);
}

TEST_CASE("gap and normal jump at most by h^2 across the edges of a smooth triangulated surface") {
  std::array<Real, 2> before{};
  for (const int level : {1, 2, 3}) {
    const Triangles s = icosphere(level);
    const Triangulated ball(s);
    std::array<Real, 2> jump{};
    for (const auto& t : s.corners)
      for (std::size_t k = 0; k < 3; ++k) {
        const V3 a = s.vertices[std::size_t(t[k])], b = s.vertices[std::size_t(t[(k + 1) % 3])];
        for (const Real share : {0.0, 0.1, 0.5, 0.7})
          for (const Real g : {-0.05, -1e-4, 0.0, 0.05}) {
            const V3 x = (a + share * (b - a)).normalized() * (1 + g);
            const V3 across = cross(a, b).normalized();
            const auto left = ball.distance(V3(x + 1e-9 * across)), right = ball.distance(V3(x - 1e-9 * across));
            jump[0] = std::max(jump[0], std::abs(left.gap - right.gap));
            jump[1] = std::max(jump[1], (left.normal - right.normal).norm());
            CHECK(left.hess_gap.norm() < 3);  // no bend between patches counts as an edge
          }
      }
    MESSAGE("jumps of gap ", jump[0], " and normal ", jump[1]);
    if (level > 1) {
      CHECK(jump[0] < before[0] / 4 + 1e-8);
      CHECK(jump[1] < before[1] / 4 + 1e-8);
    }
    before = jump;
  }
}

TEST_CASE("the search tree finds the closest of all triangles") {
  for (const auto& s : {icosphere(3), cube(1), bar(12)}) {
    const Triangulated tool(s);
    std::mt19937 random(21);
    std::uniform_real_distribution<Real> scale(0, 2);
    for (const V3& d : directions(300, 4)) {
      const V3 x = scale(random) * d;
      const auto found = tool.distance(x), all = tool.distance_by_all(x);
      CHECK(found.gap == all.gap);
      CHECK(found.normal == all.normal);
      CHECK(found.hess_gap == all.hess_gap);
    }
    // On the vertices, where several patches are as near.
    for (const V3& v : s.vertices)
      for (const Real stretch : {0.9, 1.0, 1.1})
        CHECK(tool.distance(V3(stretch * v)).normal == tool.distance_by_all(V3(stretch * v)).normal);
  }
}

TEST_CASE("a cube and its hollow have exact gaps at sharp edges") {
  const Triangulated block(cube(1)), hollow(cube(1, true));
  std::mt19937 random(2);
  std::uniform_real_distribution<Real> u(-2, 2);
  Real worst = 0, derivative = 0, third = 0;
  for (int i = 0; i < 500; ++i) {
    const V3 x(u(random), u(random), u(random));
    const Real gap = distance_to_cube(x, 1);
    worst = std::max(worst, std::abs(block.distance(x).gap - gap));
    worst = std::max(worst, std::abs(hollow.distance(x).gap + gap));
    for (const Triangulated& tool : {block, hollow}) derivative = std::max(derivative, derivatives(tool, x).worst());
    if ((x.cwiseAbs().array() > 1.1).all()) third = std::max(third, third_derivative(block, x, 1e-3));
  }
  CHECK(worst < 1e-12);
  CHECK(derivative < 1e-10);
  CHECK(third < 1e-6);
  // On an edge and on a corner it is that of a face.
  for (const V3& x : {V3(1, 1, 0.3), V3(1, 1, 1), V3(-1, 0.2, -1)})
    for (const Triangulated& tool : {block, hollow}) {
      CHECK(std::abs(tool.distance(x).gap) < 1e-12);
      CHECK(tool.distance(x).normal.cwiseAbs().maxCoeff() == doctest::Approx(1));
      CHECK(tool.distance(x).hess_gap.norm() < 1e-12);
    }
  // Without creases it is a pebble.
  const Triangulated pebble(cube(1), pi);
  CHECK(pebble.distance(V3(2, 2, 2)).normal.dot(V3(1, 1, 1).normalized()) > 0.999);
  CHECK(pebble.distance(V3(0, 0, 0)).gap < 0);
}

TEST_CASE("the sharp rim of a flat-ended bar is as round as the bar") {
  Real before = 0;
  for (const int n : {12, 24, 48}) {
    const Triangulated tool(bar(n));
    Real worst = 0;
    for (int i = 0; i < 97; ++i) {
      const Real phi = 2 * pi * i / 97;
      const V3 r(std::cos(phi), std::sin(phi), 0), z(0, 0, 1);
      const auto error = [&](const V3& x, Real gap, const V3& normal) {
        const auto at = tool.distance(x);
        worst = std::max(worst, std::abs(at.gap - gap));
        CHECK((at.normal - normal).norm() < 60.0 / (n * n));
        CHECK(derivatives(tool, x).worst() < 1e-10);
      };
      error(1.1 * r, 0.1, r);
      error(0.95 * r + 0.3 * z, -0.05, r);
      error(0.5 * r + 1.2 * z, 0.2, z);
      error(1.3 * r + 1.4 * z, 0.5, 0.6 * r + 0.8 * z);
    }
    MESSAGE(n, " facets: ", worst);
    if (before > 0) CHECK(std::log2(before / worst) > 3);
    before = worst;
  }
}

TEST_CASE("past an open edge of a triangulated surface there is no contact") {
  Triangles s;
  s.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  s.corners = {{0, 1, 2}, {0, 2, 3}};
  const Triangulated plate(s);
  CHECK(plate.distance(V3(0.3, 0.6, -0.1)).gap == doctest::Approx(-0.1));
  CHECK(plate.distance(V3(0.5, 0.5, 0.1)).gap == doctest::Approx(0.1));
  CHECK(plate.distance(V3(0.5, 0, -0.1)).gap == doctest::Approx(-0.1));  // on the edge itself
  CHECK(plate.distance(V3(0, 0, -0.1)).gap == doctest::Approx(-0.1));
  CHECK(plate.distance(V3(0.5, -0.1, -0.1)).gap == doctest::Approx(0.1 * std::sqrt(2.0)));
  CHECK(plate.distance(V3(-0.1, -0.1, -0.1)).gap == doctest::Approx(0.1 * std::sqrt(3.0)));
  CHECK(derivatives(plate, V3(0.5, -0.1, -0.1)).worst() < 1e-12);
  CHECK(derivatives(plate, V3(-0.1, -0.1, -0.1)).worst() < 1e-12);
}

TEST_CASE("a patch that its normals would fold is flat") {
  Triangles s;
  s.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  s.corners = {{0, 1, 2}};
  s.normals = {{-5, 0.1, 1}, {6, 1, 1}, {0, -9, 0.5}};
  const auto at = Triangulated(s).distance(V3(0.2, 0.3, 0.4));
  CHECK(at.gap == doctest::Approx(0.4));
  CHECK((at.normal - V3(0, 0, 1)).norm() < 1e-12);
}

TEST_CASE("a triangulated surface has a gap far away and at its centre, and none at NaN") {
  const Triangulated ball(icosphere(2));
  CHECK(ball.distance(V3(300, -400, 0)).gap == doctest::Approx(499).epsilon(1e-5));
  const auto middle = ball.distance(V3(0, 0, 0));
  CHECK(middle.gap == doctest::Approx(-1).epsilon(1e-2));
  CHECK(middle.normal.norm() == doctest::Approx(1));
  CHECK(std::isnan(ball.distance(V3(0, std::nan(""), 0)).gap));
  CHECK(std::isnan(ball.distance(V3(0, 0, INFINITY)).gap));
  CHECK(!ball.empty());
  const rigid::AnyOf<rigid::Revolution, Triangulated> any = ball;
  CHECK(any.distance(V3(2, 1, 1)).gap == ball.distance(V3(2, 1, 1)).gap);
}

TEST_CASE("the smallest size of a closed surface is the shortest edge of its box, of an open one the longest") {
  CHECK(Triangulated(cube(0.25)).smallest_size() == doctest::Approx(0.5));
  Triangles flat = cube(1);
  for (V3& x : flat.vertices) x[2] *= 0.1;
  CHECK(Triangulated(flat).smallest_size() == doctest::Approx(0.2));
  flat.corners.pop_back();
  CHECK(Triangulated(flat).smallest_size() == doctest::Approx(2));
}

TEST_CASE("wrong triangles are refused by number") {
  const auto complaint = [](auto&& change, Real crease = 1) -> std::string {
    Triangles s = cube(1);
    change(s);
    try {
      (void)Triangulated(s, crease);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "none";
  };
  CHECK(complaint([](auto&) {}) == "none");
  CHECK(complaint([](auto& s) { s.corners.clear(); }) == "triangulated: there are no triangles");
  CHECK(complaint([](auto& s) { s.corners[7][1] = 8; }) == "triangulated: triangle 7 names vertex 8, but there are 8");
  CHECK(complaint([](auto& s) { s.corners[7][1] = -1; }) ==
        "triangulated: triangle 7 names vertex -1, but there are 8");
  CHECK(complaint([](auto& s) { s.corners[5][1] = s.corners[5][0]; }) ==
        "triangulated: triangle 5 is degenerate: it has no area");
  CHECK(complaint([](auto& s) { s.vertices[5][2] = INFINITY; }) ==
        "triangulated: triangle 2 has a vertex that is not finite");
  CHECK(
      complaint([](auto& s) { std::swap(s.corners[4][0], s.corners[4][1]); }).starts_with("triangulated: triangle 4"));
  CHECK(complaint([](auto& s) { s.corners.push_back(s.corners[3]); }) ==
        "triangulated: triangle 12 runs along an edge in the same direction as triangle 3: one is inside out, or more "
        "than two meet at the edge");
  CHECK(complaint([](auto& s) { s.normals.resize(3); }) == "triangulated: 3 normals for 8 vertices");
  CHECK(complaint([](auto& s) { s.normals.assign(8, V3::Zero()); }) ==
        "triangulated: triangle 0 has a normal that is zero or not finite");
  CHECK(complaint([](auto& s) { s.normals.assign(8, V3::UnitZ()); }) ==
        "triangulated: triangle 0 is opposed to the normal of its vertex 0");
  CHECK(complaint([](auto&) {}, -1) == "triangulated: the crease angle must not be negative");
}

}  // namespace
