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
};

// Pressed by 0.15, then drawn by 0.3 along x.
template <class Tool>
Result rub(const Tool& ball) {
  Problem<Rubbed<Tool>> slab{{.body = mesh::box({.origin = {-2, -2, -1}, .size = {4, 4, 1}, .cells = {8, 8, 2}}),
                              .material = {.young = 100, .poisson = 0.3},
                              .contacts = {{.side = "front",
                                            .tool = ball,
                                            .motion = rigid::Motion<3>([](Real t) {
                                              return V3(t > 1 ? 0.3 * (t - 1) : 0, 0, 3.001 - 0.15 * std::min(t, 1.0));
                                            }),
                                            .friction = {.mu = 0.2},
                                            .enforcement = {.normal = 1e3, .tangential = 3e2}}}}};
  for (const int i : {0, 1, 2}) slab.hold("back", i);
  Result result;
  auto march = slab.march({.end = 2, .steps = 10, .tolerance = 1e-8});
  for (const StepReport& step : march) result.iterations += step.iterations;
  CHECK(bool(march.outcome()));
  result.force = slab.contact_force("front");
  return result;
}

rigid::Triangulated triangles(int level) {
  auto s = icosphere(level);
  for (V3& v : s.vertices) v *= 3;
  return rigid::Triangulated(s);
}

TEST_CASE("a ball of triangles presses and rubs as a ball") {
  const Result exact = rub(rigid::sphere({0, 0, 0}, 3));
  Real before = 0;
  for (const int level : {1, 2, 3}) {
    const Result made = rub(triangles(level));
    const Real error = (made.force - exact.force).norm() / exact.force.norm();
    MESSAGE(Index(20 << (2 * level)), " triangles: force off by ", error, ", ", made.iterations, " iterations against ",
            exact.iterations);
    if (level > 1) CHECK(error < before / 4);
    CHECK(made.iterations <= exact.iterations + 15);
    before = error;
  }
  CHECK(before < 1e-3);
}

}  // namespace
