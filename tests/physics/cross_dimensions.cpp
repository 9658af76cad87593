// SPDX-License-Identifier: BSL-1.0
// Contact and friction in space against the sections that they come to.
#include "scene.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_direct.hpp>

#include <doctest/doctest.h>

namespace cross_dimensions {

using namespace scene;
using V3 = Vec<Real, 3>;
template <class F, class K = PlaneStrain, class E = Penalty>
using Section = Model<EigenDirect, F, Hencky, K, MeanDilatation<Quad4>, E>;
template <class F, class E = Penalty>
using Solid = Model<EigenDirect, F, Hencky, ThreeDimensional, MeanDilatation<Hex8>, E>;
const Penalty by_area{.normal = 1e5, .tangential = 2e4, .per = PenaltyPer::area};

template <class M>
void finish(Problem<M>& problem, const MarchOptions& options) {
  auto march = problem.march(options);
  const Outcome& outcome = march.finish();
  REQUIRE_MESSAGE(outcome, outcome.message());
  CHECK(march.report().rejected_steps == 0);
}

// A block is pressed on an inclined tool, which is dragged along: it touches more and more nodes, of which some slide
// and some stick. Places in space are points and in the plane arc lengths, which on a flat tool is the same.
template <class F>
void check_layer(const typename F::Law& law) {
  const Real thickness = 0.7;
  const auto tool = rigid::line({0, -0.05}, {1, 0.01});
  const auto along = [](Real t) { return 0.3 * std::max(0.0, t - 0.3); };
  Problem<Section<F>> plane({.body = mesh::rectangle({.size = {10, 5}, .cells = {6, 3}}),
                             .kinematics = {.thickness = thickness},
                             .material = material<Hencky>(),
                             .contacts = {{.side = "bottom",
                                           .tool = tool,
                                           .motion = [&](Real t) { return V(along(t), 0); },
                                           .friction = law,
                                           .enforcement = by_area}}});
  Problem<Solid<F>> space({.body = mesh::box({.size = {10, 5, thickness}, .cells = {6, 3, 1}}),
                           .material = material<Hencky>(),
                           .contacts = {{.side = "bottom",
                                         .tool = rigid::Extruded(tool, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                         .motion = [&](Real t) { return V3(along(t), 0, 0); },
                                         .friction = law,
                                         .enforcement = by_area}}});
  space.hold("front", 2).hold("back", 2);
  const auto run = [](auto& p) {
    p.hold("top", 0).drive("top", 1, [](Real t) { return -0.15 * t; });
    finish(p, {.end = 1, .steps = 10, .tolerance = 1e-12});
  };
  run(plane);
  run(space);
  const V force = plane.contact_force("bottom");
  const V3 in_space = space.contact_force("bottom");
  CHECK(plane.contact("bottom").summary().sliding > 0);
  CHECK(space.contact("bottom").summary().dissipated > 0);
  CHECK((in_space.template head<2>() - force).norm() < 1e-9 * force.norm());
  CHECK(std::abs(in_space[2]) < 1e-12 * force.norm());
  Index found = 0;
  Real worst = 0;
  for (Index n = 0; n < space.body().mesh().node_count(); ++n)
    for (Index m = 0; m < plane.body().mesh().node_count(); ++m)
      if ((space.body().mesh().nodes[std::size_t(n)].template head<2>() - plane.body().mesh().nodes[std::size_t(m)])
              .norm() < 1e-12) {
        ++found;
        worst = std::max(worst, (space.displacement(n).template head<2>() - plane.displacement(m)).norm());
      }
  CHECK(found == space.body().mesh().node_count());
  CHECK(worst < 1e-10);
}
TEST_CASE("a layer of hexahedra held along z rubs as plane strain does") {
  check_layer<Coulomb>({.mu = 0.2});
  check_layer<Quasi<CappedCoulomb>>({.mu = 0.2, .tau_max = 40});
}

// A ring is held below and pressed from above by a tool that is inclined outwards: it widens and slides.
const Penalty rough{.normal = 1e5, .tangential = 2e5, .per = PenaltyPer::area};
const auto inclined = rigid::line({1, 1}, {-1, 0.1});
constexpr Real press = 0.12;

std::array<Real, 2> ring() {
  Problem<Section<Coulomb, Axisymmetric>> p({.body = mesh::rectangle({.origin = {1, 0}, .cells = {2, 2}}),
                                             .material = material<Hencky>(),
                                             .contacts = {{.side = "top",
                                                           .tool = inclined,
                                                           .motion = [](Real t) { return V(0, -press * t); },
                                                           .friction = {.mu = 0.05},
                                                           .enforcement = rough}}});
  p.hold("bottom", 0).hold("bottom", 1);
  finish(p, {.end = 1, .steps = 6, .tolerance = 1e-11});
  CHECK(p.contact("top").summary().sliding > 0);
  return {p.contact_force("top")[1], p.displacement(p.body().mesh().side("top").nodes.front())[0]};
}
// A quarter of it, of n wedges.
std::array<Real, 2> quarter(Index n) {
  auto mesh = mesh::box({.origin = {1, 0, 0}, .cells = {2, 2, n}});
  for (V3& x : mesh.nodes) x = V3(x[0] * std::cos(0.5 * pi * x[2]), x[1], x[0] * std::sin(0.5 * pi * x[2]));
  Problem<Solid<Coulomb>> p({.body = mesh,
                             .material = material<Hencky>(),
                             .contacts = {{.side = "top",
                                           .tool = rigid::Revolution(inclined, {0, 0, 0}, {0, 1, 0}),
                                           .motion = [](Real t) { return V3(0, -press * t, 0); },
                                           .friction = {.mu = 0.05},
                                           .enforcement = rough}}});
  for (const Index i : {0, 1, 2}) p.hold("bottom", i);
  p.hold("back", 2).hold("front", 0);
  finish(p, {.end = 1, .steps = 6, .tolerance = 1e-11});
  for (Index k = 0; k < p.body().mesh().node_count(); ++k)
    if ((p.body().mesh().nodes[std::size_t(k)] - V3(2, 1, 0)).norm() < 1e-12)
      return {4 * p.contact_force("top")[1], p.displacement(k)[0]};
  FAIL("the ring has no outer node");
  return {};
}
TEST_CASE("wedges in space, with contact and friction, tend to axisymmetry at second order in their angle") {
  const auto exact = ring();
  std::array<Real, 2> before{};
  for (const Index n : {2, 4, 8}) {
    const auto now = quarter(n);
    for (std::size_t i = 0; i < 2; ++i) {
      const Real error = std::abs(now[i] / exact[i] - 1);
      MESSAGE(n, " wedges, ", std::string(i == 0 ? "force" : "displacement"), ": error ", error, ", order ",
              n > 2 ? std::log2(before[i] / error) : 0);
      if (n > 2) CHECK(std::abs(std::log2(before[i] / error) - 2) < 0.3);
      before[i] = error;
    }
  }
  CHECK(before[0] < 1e-2);
}

template <class F>
void check_multipliers() {
  Real before = 1;
  for (const Real tolerance : {1e-2, 1e-5}) {
    Problem<Solid<F, AugmentedLagrangian>> p(
        {.body = mesh::box({.size = {4, 2, 4}, .cells = {4, 1, 4}}),
         .material = material<Hencky>(),
         .contacts = {
             {.side = "top",
              .tool = rigid::sphere({2, 8, 2}, 6),
              .motion = [](Real t) { return V3(0.2 * std::max(0.0, t - 0.5), -0.3 * std::min(1.0, 2 * t), 0); },
              .friction = {.mu = 0.2}}}});
    for (const Index i : {0, 1, 2}) p.hold("bottom", i);
    auto march = p.march({.end = 1, .steps = 2, .tolerance = 1e-9, .outer_tolerance = tolerance});
    const Outcome& outcome = march.finish();
    REQUIRE_MESSAGE(outcome, outcome.message());
    const Real left = march.report().max_penetration;
    CHECK(left < tolerance);  // the nodes are one apart
    CHECK(left < before);
    before = left;
    CHECK(p.contact_force("top")[1] > 100);
    MESSAGE(tolerance << ": penetration " << left << ", outer iterations " << march.report().outer_iterations);
  }
}
TEST_CASE("the augmented Lagrangian leaves no penetration of a ball") {
  check_multipliers<Coulomb>();
  check_multipliers<WithPressure<Coulomb, LagIterated>>();
}

}  // namespace cross_dimensions
