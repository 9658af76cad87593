// SPDX-License-Identifier: BSL-1.0
// Bodies that touch bodies, and themselves, against known solutions and against what must not change the answer.
#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/io/checkpoint.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/stickslip.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/verify/energy.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace stickslip;

struct Block : BodyDefaults {};
template <class Kinematics_, class TimeIntegration_ = Quasistatic>
struct Blocks : QuasistaticDefaults {
  using Kinematics = Kinematics_;
  using TimeIntegration = TimeIntegration_;
  using Bodies = BodyTypes<Block>;
  using Surfaces = SurfaceContact<QuasiCoulomb>;
};
using Plane = Blocks<PlaneStrain>;
using Ring = Blocks<Axisymmetric>;
// Multipliers, and slip bounds that outer iterations bring up to date.
struct Exact : QuasistaticDefaults {
  using Bodies = BodyTypes<Block>;
  using Enforcement = AugmentedLagrangian;
  using Surfaces = SurfaceContact<WithPressure<Coulomb, LagIterated>>;
};
// The exact tangent on a symmetric factor.
struct OnFactor : QuasistaticDefaults {
  using Bodies = BodyTypes<Block>;
  using Surfaces = SurfaceContact<Coulomb>;
  using LinearSolver = Corrected<EigenLdlt>;
};
// A thin strip that bends.
struct Strip : QuasistaticDefaults {
  using Element = AssumedStrain<Quad4>;
  using Surfaces = SurfaceContact<QuasiCoulomb>;
};

Penalty penalty(Real normal) {
  return {.normal = normal, .tangential = 0.3 * normal, .per = PenaltyPer::area};
}

Mesh<2, 4> turned(Mesh<2, 4> mesh, Real angle) {
  for (auto& x : mesh.nodes)
    x = Vec<Real, 2>(std::cos(angle) * x[0] - std::sin(angle) * x[1], std::sin(angle) * x[0] + std::cos(angle) * x[1]);
  return mesh;
}
// A part of the side "top" between two abscissas as a side of its own.
void name_part(Mesh<2, 4>& mesh, const std::string& name, Real from, Real to) {
  Side<2> part;
  for (const auto& facet : mesh.side("top").facets) {
    const Real middle =
        0.5 * (mesh.nodes[static_cast<std::size_t>(facet[0])][0] + mesh.nodes[static_cast<std::size_t>(facet[1])][0]);
    if (middle < from || middle > to) continue;
    part.facets.push_back(facet);
    for (const Index n : facet)
      if (std::find(part.nodes.begin(), part.nodes.end(), n) == part.nodes.end()) part.nodes.push_back(n);
  }
  mesh.sides[name] = part;
}
// Largest difference of a component of the deformation gradient between two points of the bodies.
template <class Problem>
Real scatter(const Problem& problem) {
  Mat<Real, 2> low = Mat<Real, 2>::Constant(1e9), high = -low;
  problem.bodies().for_each([&](const auto& body) {
    body.visit_points(problem.displacement(), [&](Index, int, const auto& F, const auto&, Real) {
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
          low(i, j) = std::min(low(i, j), F(i, j));
          high(i, j) = std::max(high(i, j), F(i, j));
        }
    });
  });
  return (high - low).maxCoeff();
}

// Taylor & Papadopoulos: a punch on a wider block, the same pressure on the punch and on what of the block is free.
// Either side is slave, or both with half the penalty.
template <class Model>
Real patch_test(Index on_punch, Index under, int slave, Real normal) {
  auto block = mesh::rectangle({.origin = {1, 0}, .size = {3, 1}, .cells = {3 * under, 2}});
  name_part(block, "free", 2, 9);
  auto punch = mesh::rectangle({.origin = {1, 1}, .size = {1, 1}, .cells = {on_punch, 2}});
  const Real weight = slave == 2 ? normal / 2 : normal;
  SurfaceContacts<Model> contacts;
  if (slave != 1) contacts.push_back({.side = "punch.bottom", .against = "block.top", .enforcement = penalty(weight)});
  if (slave != 0) contacts.push_back({.side = "block.top", .against = "punch.bottom", .enforcement = penalty(weight)});
  for (auto& c : contacts) c.friction = {.mu = 0.2};
  Problem<Model> problem{{.bodies = {{.name = "block", .mesh = block, .material = {.young = 100, .poisson = 0.3}},
                                     {.name = "punch", .mesh = punch, .material = {.young = 100, .poisson = 0.3}}},
                          .surfaces = contacts}};
  problem.hold("block.bottom", 1);
  problem.hold("block.left", 0);
  problem.hold("punch.left", 0);
  const Real inner = Model::Kinematics::hoop ? pi * 3 : 1, outer = Model::Kinematics::hoop ? pi * 12 : 2;
  problem.load("punch.top", 1, [=](Real t) { return -inner * t; });
  problem.load("block.free", 1, [=](Real t) { return -outer * t; });
  auto march = problem.march({.end = 1, .steps = 1, .tolerance = 1e-12});
  REQUIRE_MESSAGE(march.finish(), march.outcome().message());
  CHECK(problem.reaction("block.bottom", 1) == doctest::Approx(inner + outer).epsilon(1e-10));
  return scatter(problem);
}

}  // namespace

TEST_CASE("a uniform pressure passes through meshes that do not match: patch test, either side slave, and both") {
  for (const int slave : {0, 1, 2})
    for (const Real normal : {1e3, 1e6}) {
      CHECK(patch_test<Plane>(7, 5, slave, normal) < 1e-10);
      CHECK(patch_test<Plane>(3, 5, slave, normal) < 1e-10);
    }
}
TEST_CASE("the same in axisymmetry, held at the bore") {
  for (const int slave : {0, 1, 2}) {
    // The bore is held and the outside is free: not a uniform state, but one that the interface must not disturb.
    const auto bulge = [&](Index on_punch, Index under) {
      auto low = mesh::rectangle({.origin = {1, 0}, .size = {1, 1}, .cells = {under, 2}});
      auto high = mesh::rectangle({.origin = {1, 1}, .size = {1, 1}, .cells = {on_punch, 2}});
      SurfaceContacts<Ring> contacts;
      const Real weight = slave == 2 ? 5e3 : 1e4;
      if (slave != 1) contacts.push_back({.side = "high.bottom", .against = "low.top", .enforcement = penalty(weight)});
      if (slave != 0) contacts.push_back({.side = "low.top", .against = "high.bottom", .enforcement = penalty(weight)});
      Problem<Ring> problem{{.bodies = {{.name = "low", .mesh = low, .material = {.young = 100, .poisson = 0}},
                                        {.name = "high", .mesh = high, .material = {.young = 100, .poisson = 0}}},
                             .surfaces = contacts}};
      problem.hold("low.bottom", 1);
      problem.hold("low.left", 0);
      problem.hold("high.left", 0);
      problem.load("high.top", 1, [](Real t) { return -3 * pi * t; });
      auto march = problem.march({.end = 1, .steps = 1, .tolerance = 1e-12});
      REQUIRE_MESSAGE(march.finish(), march.outcome().message());
      return scatter(problem);
    };
    CHECK(bulge(7, 5) < 1e-10);
    CHECK(bulge(24, 25) < 1e-10);
  }
}

TEST_CASE("an inclined interface passes the patch test, also after a finite slide that has come to rest") {
  const Real tilt = pi / 6;
  Real forces[2];
  for (const bool inclined : {false, true}) {
    const Real angle = inclined ? tilt : 0;
    auto low = turned(mesh::rectangle({.origin = {-2, -1}, .size = {6, 1}, .cells = {15, 2}}), angle);
    auto high = turned(mesh::rectangle({.origin = {0, 0}, .size = {1, 0.5}, .cells = {3, 1}}), angle);
    Problem<Plane> problem{{.bodies = {{.name = "low", .mesh = low, .material = {.young = 1e4, .poisson = 0}},
                                       {.name = "high", .mesh = high, .material = {.young = 1e4, .poisson = 0}}},
                            .surfaces = {{.side = "high.bottom",
                                          .against = "low.top",
                                          .friction = {.mu = 0},
                                          .enforcement = penalty(1e5),
                                          .name = "joint"}}}};
    for (const auto* side : {"low.bottom", "low.top", "high.top", "high.bottom"})
      for (const Index i : {0, 1}) {
        const bool moves = side[0] == 'h';
        // Down by 0.001 along the normal of the joint, then along it by 0.77, then at rest.
        const Real normal[2] = {-std::sin(angle), std::cos(angle)}, along[2] = {std::cos(angle), std::sin(angle)};
        const Real n = normal[i], a = along[i];
        if (moves)
          problem.drive(side, i,
                        [=](Real t) { return -0.001 * std::min(t, 1.0) * n + 0.77 * std::clamp(t - 1, 0.0, 1.0) * a; });
        else
          problem.hold(side, i);
      }
    auto march = problem.march({.end = 2.2, .steps = 22, .tolerance = 1e-11});
    REQUIRE_MESSAGE(march.finish(), march.outcome().message());
    const auto& contact = problem.contact("joint");
    CHECK(contact.summary().touching == 4);
    // All pressures are those of one gap.
    const auto areas = problem.bodies().side_areas("high.bottom");
    for (std::size_t k = 0; k < areas.size(); ++k)
      CHECK(contact.states()[k].pressure / areas[k] ==
            doctest::Approx(contact.states()[0].pressure / areas[0]).epsilon(1e-9));
    forces[inclined] = contact.force().norm();
    CHECK(contact.states()[1].accumulated_slip == doctest::Approx(0.77).epsilon(1e-6));
  }
  CHECK(forces[0] == doctest::Approx(forces[1]).epsilon(1e-9));
}

TEST_CASE("a shrink fit of rings has Lame's pressure, better on finer meshes") {
  const auto ring = [](Real inner, Real outer, Index across, Index around) {
    auto mesh = mesh::rectangle({.origin = {inner, 0}, .size = {outer - inner, pi / 2}, .cells = {across, around}});
    for (auto& x : mesh.nodes) x = Vec<Real, 2>(x[0] * std::cos(x[1]), x[0] * std::sin(x[1]));
    return mesh;
  };
  const Real exact = 100 / (1 - 0.09) * 0.02 / 2 / (5.0 / 3 + 13.0 / 5);  // 0.2576
  Real before = 1;
  for (const Index n : {6, 12, 24}) {
    Problem<Plane> problem{
        {.bodies = {{.name = "in", .mesh = ring(1, 2.01, n / 2, n), .material = {.young = 100, .poisson = 0.3}},
                    {.name = "out", .mesh = ring(1.99, 3, n / 2, n + 1), .material = {.young = 100, .poisson = 0.3}}},
         .surfaces = {{.side = "in.right",
                       .against = "out.left",
                       .friction = {.mu = 0},
                       .enforcement = penalty(2.6e5),
                       .name = "fit"}}}};
    for (const std::string body : {"in", "out"}) problem.hold(body + ".bottom", 1).hold(body + ".top", 0);
    auto march = problem.march({.end = 1, .steps = 1, .tolerance = 1e-10});
    REQUIRE_MESSAGE(march.finish(), march.outcome().message());
    const auto areas = problem.bodies().side_areas("in.right");
    const auto& states = problem.contact("fit").states();
    Real sum = 0, area = 0, low = 1, high = 0;
    for (std::size_t k = 0; k < areas.size(); ++k) {
      sum += states[k].pressure;
      area += areas[k];
      if (k > 0 && k + 1 < areas.size())
        low = std::min(low, states[k].pressure / areas[k]), high = std::max(high, states[k].pressure / areas[k]);
    }
    const Real error = std::abs(sum / area / exact - 1);
    CHECK(error < before / 3);
    before = error;
    if (n == 24) {
      CHECK(error < 0.005);
      CHECK(high / low - 1 < 1e-3);
    }
  }
}

TEST_CASE("an elastica folds on itself at 0.8184 of its length, and Newton's method converges quadratically there") {
  const Real length = 40, young = 1000, critical = 4 * pi * pi * young / 12 / (length * length);
  auto strip = mesh::rectangle({.size = {length, 1}, .cells = {80, 2}});
  for (auto& x : strip.nodes) x[1] += 0.01 * (1 - std::cos(2 * pi * x[0] / length));
  Problem<Strip> problem{
      {.body = strip,
       .material = {.young = young, .poisson = 0},
       .surfaces = {
           {.side = "bottom", .against = "bottom", .friction = {.mu = 0}, .enforcement = penalty(1e3), .name = "fold"},
           {.side = "top", .against = "top", .friction = {.mu = 0}, .enforcement = penalty(1e3), .name = "other"}}}};
  problem.hold("left", 0).hold("left", 1).hold("right", 1);
  problem.drive("right", 0, [=](Real t) { return -length * t; });
  for (const auto& [end, largest] : {std::pair{0.02, 2e-4}, {0.79, 0.01}}) {
    auto march = problem.march(
        {.end = end, .initial = largest / 20, .largest = largest, .target_iterations = 6, .tolerance = 1e-8});
    REQUIRE_MESSAGE(march.finish(), march.outcome().message());
    CHECK(problem.contact("fold").summary().touching == 0);
    CHECK(problem.contact("other").summary().touching == 0);
  }
  auto march =
      problem.march({.end = 0.93, .initial = 0.001, .largest = 0.002, .target_iterations = 6, .tolerance = 1e-8});
  Real first = 0, load = 0;
  for (const StepReport& step : march)
    if (first == 0 && step.contact.touching > 0) {
      first = step.time;
      load = -problem.reaction("right", 0) / critical;
    }
  REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
  CHECK(first == doctest::Approx(0.8184).epsilon(0.004));
  CHECK(load == doctest::Approx(1.772).epsilon(0.02));
  CHECK(problem.contact("other").summary().touching + problem.contact("fold").summary().touching > 2);
  CHECK(march.report().rejected_steps < 5);
}

TEST_CASE("a wall thinner than its facets does not touch itself") {
  auto strip = mesh::rectangle({.size = {10, 0.2}, .cells = {10, 1}});
  mesh::join(strip, "skin", {"bottom", "right", "top", "left"});
  Problem<Strip> problem{
      {.body = strip,
       .material = {.young = 1000, .poisson = 0.3},
       .surfaces = {
           {.side = "skin", .against = "skin", .friction = {.mu = 0.1}, .enforcement = penalty(1e4), .name = "self"}}}};
  problem.hold("left", 0).hold("left", 1);
  problem.drive("right", 1, [](Real t) { return -3 * t; });
  auto march = problem.march({.end = 1, .initial = 0.02});
  for (const StepReport& step : march) CHECK(step.contact.touching == 0);
  REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
  CHECK(problem.contact("self").force().norm() == 0);
}

TEST_CASE("three layers share a load, and the friction of a driven middle one is that of both its sides") {
  const auto layer = [](Real low, Index cells) {
    return mesh::rectangle({.origin = {0, low}, .size = {4, 0.5}, .cells = {cells, 2}});
  };
  auto middle = mesh::rectangle({.origin = {-1, 0.5}, .size = {6, 0.5}, .cells = {17, 2}});
  Problem<Plane> problem{{.bodies = {{.name = "a", .mesh = layer(0, 8), .material = {.young = 1e3, .poisson = 0.3}},
                                     {.name = "b", .mesh = middle, .material = {.young = 1e3, .poisson = 0.3}},
                                     {.name = "c", .mesh = layer(1, 9), .material = {.young = 1e3, .poisson = 0.3}}},
                          .surfaces = {{.side = "a.top",
                                        .against = "b.bottom",
                                        .friction = {.mu = 0.2},
                                        .enforcement = penalty(1e5),
                                        .name = "low"},
                                       {.side = "c.bottom",
                                        .against = "b.top",
                                        .friction = {.mu = 0.2},
                                        .enforcement = penalty(1e5),
                                        .name = "high"}}}};
  problem.hold("a.bottom", 0).hold("a.bottom", 1).hold("c.top", 0);
  problem.drive("c.top", 1, [](Real t) { return -0.01 * std::min(t, 1.0); });
  problem.drive("b.right", 0, [](Real t) { return 0.3 * std::max(t - 1, 0.0); });
  auto march = problem.march({.end = 2, .steps = 40});
  REQUIRE_MESSAGE(march.finish(), march.outcome().message());
  const auto low = problem.contact_force("low"), high = problem.contact_force("high");
  CHECK(low[1] == doctest::Approx(-high[1]).epsilon(1e-4));
  CHECK(std::abs(low[0] / low[1]) == doctest::Approx(0.2).epsilon(0.01));
  CHECK(std::abs(high[0] / high[1]) == doctest::Approx(0.2).epsilon(0.01));
  CHECK(problem.reaction("b.right", 0) == doctest::Approx(std::abs(low[0]) + std::abs(high[0])).epsilon(1e-4));
}

TEST_CASE(
    "friction on a strip that is stretched: no jump from step to step, and an error of the bound of first order") {
  const auto run = [](Index steps) {
    auto strip = mesh::rectangle({.origin = {-3, -0.2}, .size = {6, 0.2}, .cells = {30, 1}});
    auto block = mesh::rectangle({.origin = {-0.5, 0}, .size = {1, 0.5}, .cells = {4, 2}});
    auto problem = std::make_unique<Problem<Plane>>(Problem<Plane>::Parameters{
        .bodies = {{.name = "strip", .mesh = strip, .material = {.young = 100, .poisson = 0}},
                   {.name = "block", .mesh = block, .material = {.young = 1e4, .poisson = 0.3}}},
        .surfaces = {{.side = "block.bottom",
                      .against = "strip.top",
                      .friction = {.mu = 0.2},
                      .enforcement = penalty(1e4),
                      .name = "joint"}}});
    problem->hold("strip.bottom", 1).hold("block.top", 0).drive("block.top", 1, [](Real t) {
      return -0.01 * std::min(t, 1.0);
    });
    // From 1 to 2 the strip is drawn along and stretched by half; then it rests.
    for (const Real end : {-3.0, 3.0})
      problem->drive(end < 0 ? "strip.left" : "strip.right", 0, [=](Real t) {
        const Real share = std::clamp(t - 1, 0.0, 1.0);
        return share * (0.5 * end + 0.8);
      });
    auto press = problem->march({.end = 1, .steps = 4, .tolerance = 1e-10});
    REQUIRE_MESSAGE(press.finish(), press.outcome().message());
    auto march = problem->march({.end = 2, .steps = steps, .tolerance = 1e-10});
    Real sum = 0;
    Index looked = 0;
    for (const StepReport& step : march)
      if (step.time > 1.2) {
        const auto f = problem->contact_force("joint");
        sum += 1 - std::abs(f[0] / f[1]) / 0.2;
        ++looked;
      }
    REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
    // A step at rest changes nothing: the forces were carried to the new lengths of the strip.
    const auto before = problem->contact_force("joint");
    auto rest = problem->march({.end = 2.1, .steps = 1, .tolerance = 1e-10});
    REQUIRE_MESSAGE(rest.finish(), rest.outcome().message());
    CHECK(problem->contact_force("joint")[0] == doctest::Approx(before[0]).epsilon(1e-3));
    return sum / Real(looked);
  };
  // The force of a step is the bound over the stretch of that step.
  const Real coarse = run(20), fine = run(40);
  CHECK(coarse == doctest::Approx(0.008).epsilon(0.2));
  CHECK(coarse / fine == doctest::Approx(2).epsilon(0.25));
}

TEST_CASE(
    "multipliers leave no gap, outer iterations no lag, and a corrected factor gives the forces of the full matrix") {
  const auto slid = []<class Model>(std::type_identity<Model>) {
    auto slab = mesh::rectangle({.origin = {0, 0}, .size = {4, 1}, .cells = {12, 3}});
    auto slider = mesh::rectangle({.origin = {1, 1}, .size = {1, 0.5}, .cells = {4, 2}});
    SurfaceContacts<Model> contacts(1);
    contacts[0].side = "slider.bottom";
    contacts[0].against = "slab.top";
    contacts[0].friction = {.mu = 0.3};
    contacts[0].enforcement = {.normal = 1e4, .tangential = 3e3, .per = PenaltyPer::area};
    contacts[0].name = "joint";
    auto problem = std::make_unique<Problem<Model>>(typename Problem<Model>::Parameters{
        .bodies = {{.name = "slab", .mesh = slab, .material = {.young = 1e3, .poisson = 0.3}},
                   {.name = "slider", .mesh = slider, .material = {.young = 3e3, .poisson = 0.3}}},
        .surfaces = contacts});
    problem->hold("slab.bottom", 0).hold("slab.bottom", 1);
    problem->drive("slider.top", 1, [](Real t) { return -0.02 * std::min(t, 1.0); });
    problem->drive("slider.top", 0, [](Real t) { return 0.4 * std::max(t - 1, 0.0); });
    auto march = problem->march({.end = 2, .steps = 20, .tolerance = 1e-9, .outer_tolerance = 1e-6});
    REQUIRE_MESSAGE(march.finish(), march.outcome().message());
    return problem;
  };
  struct Full : OnFactor {
    using LinearSolver = EigenLu;
  };
  const auto exact = slid(std::type_identity<Exact>{});
  const auto full = slid(std::type_identity<Full>{});
  const auto corrected = slid(std::type_identity<OnFactor>{});
  const auto& joint = exact->contact("joint");
  for (const auto& state : joint.states())
    if (state.touching) CHECK(std::abs(state.gap) < 1e-6);
  CHECK(joint.summary().lag < 1e-5 * joint.summary().friction_capacity);
  CHECK((corrected->contact_force("joint") - full->contact_force("joint")).norm() <
        1e-7 * full->contact_force("joint").norm());
  CHECK((corrected->displacement() - full->displacement()).lpNorm<Eigen::Infinity>() < 1e-8);
  const auto f = full->contact_force("joint"), g = exact->contact_force("joint");
  CHECK(std::abs(f[0] / f[1] - g[0] / g[1]) < 5e-3);
}

TEST_CASE("a body slides off the end of another and is free") {
  auto slab = mesh::rectangle({.origin = {0, 0}, .size = {4, 1}, .cells = {10, 3}});
  auto slider = mesh::rectangle({.origin = {2, 1}, .size = {1, 0.5}, .cells = {3, 2}});
  Problem<Plane> problem{{.bodies = {{.name = "slab", .mesh = slab, .material = {.young = 1e3, .poisson = 0.3}},
                                     {.name = "slider", .mesh = slider, .material = {.young = 1e3, .poisson = 0.3}}},
                          .surfaces = {{.side = "slider.bottom",
                                        .against = "slab.top",
                                        .friction = {.mu = 0.1},
                                        .enforcement = penalty(1e5),
                                        .name = "joint"}}}};
  problem.hold("slab.bottom", 0).hold("slab.bottom", 1);
  problem.drive("slider.top", 1, [](Real t) { return -0.01 * std::min(t, 1.0); });
  problem.drive("slider.top", 0, [](Real t) { return 2.5 * std::max(t - 1, 0.0); });
  auto march = problem.march({.end = 2, .initial = 0.05, .largest = 0.05});
  Real before = 1e9;
  for (const StepReport& step : march)
    if (step.time > 1.4 && step.time < 1.8) {
      CHECK(problem.contact_force("joint").norm() < before * (1 + 1e-3));
      before = problem.contact_force("joint").norm();
    }
  REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
  CHECK(problem.contact("joint").summary().touching == 0);
  CHECK(problem.contact_force("joint").norm() == 0);
}

TEST_CASE("a master of held nodes gives the forces of the rigid tool, to the error of the slave's means") {
  const auto block = mesh::rectangle({.origin = {0, 0}, .size = {2, 1}, .cells = {20, 8}});
  auto die = mesh::rectangle({.origin = {-2, -1}, .size = {6, 1}, .cells = {60, 1}});
  for (auto& x : die.nodes)
    if (x[1] > -0.5) x[1] = 0.05 * (x[0] - 1) * (x[0] - 1);
  auto raised = block;
  for (auto& x : raised.nodes) x[1] += 0.05 * (x[0] - 1) * (x[0] - 1);
  Problem<Plane> soft{{.bodies = {{.name = "block", .mesh = raised, .material = {.young = 1e3, .poisson = 0.3}},
                                  {.name = "die", .mesh = die, .material = {.young = 1e3, .poisson = 0.3}}},
                       .surfaces = {{.side = "block.bottom",
                                     .against = "die.top",
                                     .friction = {.mu = 0.2},
                                     .enforcement = penalty(1e5),
                                     .name = "joint"}}}};
  for (const auto* side : {"die.bottom", "die.top"}) soft.hold(side, 0).hold(side, 1);
  struct OnTool : QuasistaticDefaults {
    using Friction = QuasiCoulomb;
  };
  std::vector<Vec<Real, 2>> points;
  for (Index i = 0; i <= 60; ++i) {
    const Real x = -2 + 0.1 * Real(i);
    points.push_back({x, 0.05 * (x - 1) * (x - 1)});
  }
  const auto chain = rigid::rounded(points, 0.1);
  Problem<OnTool> hard{
      {.body = raised,
       .material = {.young = 1e3, .poisson = 0.3},
       .contacts = {
           {.side = "bottom", .tool = chain, .friction = {.mu = 0.2}, .enforcement = penalty(1e5), .name = "joint"}}}};
  const auto push = [](auto& problem, const std::string& top) {
    problem.drive(top, 1, [](Real t) { return -0.02 * std::min(t, 1.0); });
    problem.drive(top, 0, [](Real t) { return 0.1 * std::max(t - 1, 0.0); });
    auto march = problem.march({.end = 2, .steps = 20});
    REQUIRE_MESSAGE(march.finish(), march.outcome().message());
    return problem.contact_force("joint");
  };
  const auto a = push(soft, "block.top"), b = push(hard, "top");
  CHECK((a - b).norm() < 0.01 * b.norm());
}

TEST_CASE("bars in collision exchange their velocities after a stress of half rho c v") {
  using Moving = Blocks<PlaneStrain, GeneralizedAlpha>;
  const auto bar = [](Real from, Index cells) {
    return mesh::rectangle({.origin = {from, 0}, .size = {10, 1}, .cells = {cells, 1}});
  };
  const Real density = 1e-3, young = 1000, c = std::sqrt(young / density), v = 1;
  Problem<Moving> problem{
      {.bodies =
           {{.name = "left", .mesh = bar(-10, 50), .material = {.young = young, .poisson = 0}, .density = density},
            {.name = "right", .mesh = bar(0.01, 53), .material = {.young = young, .poisson = 0}, .density = density}},
       .time_integration = {.scheme = chung_hulbert(0.8)},
       .surfaces = {{.side = "left.right",
                     .against = "right.left",
                     .friction = {.mu = 0},
                     .enforcement = penalty(1e4),
                     .name = "joint"}}}};
  problem.hold("left.bottom", 1).hold("left.top", 1).hold("right.bottom", 1).hold("right.top", 1);
  problem.start_velocity([&](const Vec<Real, 2>& x) { return Vec<Real, 2>(x[0] < 0.005 ? v : 0, 0); });
  const Real transit = 10 / c, touch = 0.01 / v;
  auto march = problem.march({.end = touch + 4 * transit, .steps = 400, .tolerance = 1e-8});
  verify::EnergyBalance balance(problem);
  const Real energy = 0.5 * density * 10 * v * v;
  Real impulse = 0, last = 0, largest_energy = 0, plateau = 0;
  Index looked = 0;
  for (const StepReport& step : march) {
    balance.update(step);
    const Real force = std::abs(problem.contact_force("joint")[0]);
    impulse += force * step.dt;
    if (force > 0) last = step.time;
    const auto& e = balance.energies();
    largest_energy = std::max(largest_energy, e.kinetic + e.elastic + e.penalty);
    if (step.time > touch + 0.3 * transit && step.time < touch + 1.7 * transit) {
      plateau += force;
      ++looked;
    }
  }
  REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
  CHECK(plateau / Real(looked) == doctest::Approx(0.5 * density * c * v).epsilon(0.01));
  CHECK(last - touch == doctest::Approx(2 * transit).epsilon(0.03));
  CHECK(impulse == doctest::Approx(density * 10 * v).epsilon(0.01));
  CHECK(largest_energy < energy * (1 + 1e-9));
  // Mean velocities: the left bar rests, the right one has all.
  Field momentum = Field::Zero(problem.displacement().size());
  problem.inertia().add_product(problem.inertia().velocity(), momentum);
  Real of[2] = {0, 0};
  for (Index n = 0; n < problem.bodies().node_count(); ++n)
    of[problem.bodies().positions()[static_cast<std::size_t>(n)][0] < 0.005 ? 0 : 1] += momentum[2 * n];
  CHECK(std::abs(of[0]) < 0.01 * density * 10 * v);
  CHECK(of[0] + of[1] == doctest::Approx(density * 10 * v).epsilon(1e-9));
}

TEST_CASE("a body that would go through another in one step is stopped by shorter ones") {
  auto wall = mesh::rectangle({.origin = {0, -0.1}, .size = {4, 0.1}, .cells = {8, 1}});
  auto block = mesh::rectangle({.origin = {1, 1}, .size = {1, 0.3}, .cells = {3, 1}});
  Problem<Plane> problem{{.bodies = {{.name = "wall", .mesh = wall, .material = {.young = 1e3, .poisson = 0.3}},
                                     {.name = "block", .mesh = block, .material = {.young = 1e3, .poisson = 0.3}}},
                          .surfaces = {{.side = "block.bottom",
                                        .against = "wall.top",
                                        .friction = {.mu = 0.1},
                                        .enforcement = penalty(1e5),
                                        .name = "joint"}}}};
  problem.hold("wall.bottom", 0).hold("wall.bottom", 1).hold("block.top", 0);
  problem.drive("block.top", 1, [](Real t) { return -1.02 * t; });
  auto march = problem.march({.end = 1, .steps = 2});
  REQUIRE_MESSAGE(march.finish(), march.outcome().message());
  CHECK(problem.contact("joint").summary().touching > 2);
  Problem<Plane> fast{{.bodies = {{.name = "wall", .mesh = wall, .material = {.young = 1e3, .poisson = 0.3}},
                                  {.name = "block", .mesh = block, .material = {.young = 1e3, .poisson = 0.3}}},
                       .surfaces = {{.side = "block.bottom",
                                     .against = "wall.top",
                                     .friction = {.mu = 0.1},
                                     .enforcement = penalty(1e5),
                                     .name = "joint"}}}};
  fast.hold("wall.bottom", 0).hold("wall.bottom", 1).hold("block.top", 0);
  fast.drive("block.top", 1, [](Real t) { return -2 * t; });
  auto through = fast.march({.end = 1, .steps = 1});
  CHECK(!through.finish());
  CHECK(fast.contact("joint").summary().touching == 4);
  CHECK(fast.contact_force("joint")[1] < -1000);  // it presses on the wall, which it would have passed
  CHECK(through.report().rejected_steps > 0);
}

TEST_CASE("a run that is restarted with its folds in contact continues bit for bit") {
  const auto make = [] {
    auto strip = mesh::rectangle({.size = {12, 1}, .cells = {24, 2}});
    for (auto& x : strip.nodes) x[1] += 0.05 * (1 - std::cos(2 * pi * x[0] / 12));
    auto problem =
        std::make_unique<Problem<Strip>>(Problem<Strip>::Parameters{.body = strip,
                                                                    .material = {.young = 1000, .poisson = 0.3},
                                                                    .surfaces = {{.side = "bottom",
                                                                                  .against = "bottom",
                                                                                  .friction = {.mu = 0.2},
                                                                                  .enforcement = penalty(1e3),
                                                                                  .name = "fold"}}});
    problem->hold("left", 0).hold("left", 1).hold("right", 1);
    problem->drive("right", 0, [](Real t) { return -12 * t; });
    return problem;
  };
  const MarchOptions options{.end = 0.86, .initial = 0.001, .largest = 0.02, .target_iterations = 6};
  const auto file = std::filesystem::temp_directory_path() / ("stickslip_fold_" + std::to_string(::getpid()));
  auto whole = make();
  auto march = whole->march(options);
  bool saved = false;
  for (const StepReport& step : march)
    if (!saved && step.contact.touching > 0) {
      io::save(file, march);
      saved = true;
    }
  REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
  REQUIRE(saved);
  auto half = make();
  auto again = half->march(options);
  io::load(file, again);
  std::filesystem::remove(file);
  REQUIRE_MESSAGE(again.finish(), again.outcome().message());
  CHECK(half->contact("fold").summary().touching > 0);
  CHECK((half->displacement() - whole->displacement()).lpNorm<Eigen::Infinity>() == 0);
  CHECK(again.report().iterations == march.report().iterations);
}

TEST_CASE("what cannot touch is refused by name") {
  const auto block = mesh::rectangle({.origin = {0, 0}, .size = {1, 1}, .cells = {2, 2}});
  const auto problem = [&](Real low, const std::string& side, const std::string& against) {
    auto other = block;
    for (auto& x : other.nodes) x[1] += low;
    Problem<Plane> p{
        {.bodies = {{.name = "a", .mesh = block, .material = {.young = 1, .poisson = 0}},
                    {.name = "b", .mesh = other, .material = {.young = 1, .poisson = 0}}},
         .surfaces = {
             {.side = side, .against = against, .friction = {.mu = 0.1}, .enforcement = penalty(1), .name = "joint"}}}};
    p.hold("a.bottom", 0).hold("a.bottom", 1).hold("b.top", 0).hold("b.top", 1);
    (void)p.march({.end = 1});
  };
  CHECK_NOTHROW(problem(1, "a.top", "b.bottom"));
  CHECK_THROWS_WITH_AS(problem(0.2, "a.top", "b.bottom"), doctest::Contains("contact \"joint\": node"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(problem(1, "a.top", "a.left"), doctest::Contains("are of one body"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(problem(1, "a.top", "c.left"), doctest::Contains("there is no side called \"c.left\""),
                       std::invalid_argument);
}
