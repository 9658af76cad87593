// SPDX-License-Identifier: BSL-1.0
// A slab pressed and rubbed by a ball: of triangles, and by its formula.
#include <stickslip/geometry/triangulated.hpp>
#include <stickslip/stickslip.hpp>

#include <doctest/doctest.h>

#include "../unit/icosphere.hpp"

namespace {

using namespace stickslip;
using V3 = Vec<Real, 3>;

template <class Tool_>
struct Rubbed : QuasistaticDefaults {
  using Kinematics = ThreeDimensional;
  using Element = MeanDilatation<Hex8>;
  using Friction = Coulomb;
  using Tool = Tool_;
};

struct Result {
  V3 force = V3::Zero();
  Index iterations = 0;
  Real slid = 0, friction = 0;  // the latter over mu N
};

// Pressed by 0.15 until time 1.
Real height(Real t) {
  return 3.001 - 0.15 * std::min(t, 1.0);
}
// Then drawn by 0.3 along x.
V3 drawn(Real t) {
  return {t > 1 ? 0.3 * (t - 1) : 0, 0, height(t)};
}
// Then turned three times about y.
rigid::Pose<3> turned(Real t) {
  const Real angle = 6 * pi * std::max(0.0, t - 1);
  rigid::Pose<3> pose;
  pose.rotation << std::cos(angle), 0, std::sin(angle), 0, 1, 0, -std::sin(angle), 0, std::cos(angle);
  pose.translation = V3(0, 0, height(t));
  return pose;
}

template <class Tool>
Result rub(const Tool& ball, const rigid::Motion<3>& motion, Index steps = 10) {
  Problem<Rubbed<Tool>> slab{{.body = mesh::box({.origin = {-2, -2, -1}, .size = {4, 4, 1}, .cells = {8, 8, 2}}),
                              .material = {.young = 100, .poisson = 0.3},
                              .contacts = {{.side = "front",
                                            .tool = ball,
                                            .motion = motion,
                                            .friction = {.mu = 0.2},
                                            .enforcement = {.normal = 1e3, .tangential = 3e2}}}}};
  for (const int i : {0, 1, 2}) slab.hold("back", i);
  Result result;
  auto march = slab.march({.end = 2, .steps = steps, .tolerance = 1e-8});
  for (const StepReport& step : march) result.iterations += step.iterations;
  CHECK(bool(march.outcome()));
  result.slid = march.report().max_slip;
  result.force = slab.contact_force("front");
  Real pressure = 0;
  for (const auto& node : slab.contact("front").states()) {
    pressure += node.pressure;
    result.friction += std::sqrt(std::max(0.0, node.force.squaredNorm() - node.pressure * node.pressure)) / 0.2;
  }
  result.friction /= pressure;
  return result;
}

rigid::Triangulated triangles(int level) {
  auto s = icosphere(level);
  for (V3& v : s.vertices) v *= 3;
  return rigid::Triangulated(s);
}

TEST_CASE("a triangulated ball has the contact forces of a sphere") {
  const Result exact = rub(rigid::sphere({0, 0, 0}, 3), drawn);
  Real before = 0;
  for (const int level : {1, 2, 3}) {
    const Result made = rub(triangles(level), drawn);
    const Real error = (made.force - exact.force).norm() / exact.force.norm();
    MESSAGE(Index(20 << (2 * level)), " triangles: force off by ", error, ", ", made.iterations, " iterations against ",
            exact.iterations);
    if (level > 1) CHECK(error < before / 4);
    CHECK(made.iterations <= exact.iterations + 15);
    before = error;
  }
  CHECK(before < 1e-3);
}

TEST_CASE("a triangulated ball that rotates three times in four steps has the friction work of a sphere") {
  const Result exact = rub(rigid::sphere({0, 0, 0}, 3), turned, 8), made = rub(triangles(3), turned, 8);
  CHECK(exact.force[0] > 0.19 * exact.force[2]);
  CHECK(exact.friction == doctest::Approx(1).epsilon(0.02));
  CHECK(exact.slid == doctest::Approx(18 * pi).epsilon(0.02));
  CHECK((made.force - exact.force).norm() < 5e-3 * exact.force.norm());
  CHECK(made.slid == doctest::Approx(exact.slid).epsilon(5e-3));
}

}  // namespace
