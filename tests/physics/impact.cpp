// SPDX-License-Identifier: BSL-1.0
// Contact in dynamics: impact makes no energy whatever the scheme and the enforcement, forces are those of waves, tools
// may move as they like; friction's flutter grows as it should, and damping stops it.
#include <stickslip/damping/stiffness_damping.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/time_integration/quasistatic.hpp>
#include <stickslip/verify/energy.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

namespace impact {

using namespace stickslip;
using V = Vec<Real, 2>;

struct Smooth {
  using Kinematics = PlaneStrain;
  using Element = MeanDilatation<Quad4>;
  using Material = Hencky;
  using Friction = Frictionless;
  using Enforcement = Penalty;
  using TimeIntegration = GeneralizedAlpha;
  using LinearSolver = EigenLdlt;
};
struct Exact : Smooth {
  using Enforcement = AugmentedLagrangian;
};
struct Damped : Smooth {
  using Friction = Coulomb;
  using Damping = StiffnessDamping;
  using LinearSolver = EigenLu;
};
struct Undamped_ : Damped {
  using Damping = Undamped;
};
struct Still : Smooth {
  using TimeIntegration = Quasistatic;
};

// Damping that is not called for is not there: no byte of state or parameters, and no weight of its own in the matrix.
static_assert(!has_damping<Smooth> && std::is_same_v<DampingOf<Smooth>, Undamped> && has_damping<Damped>);
static_assert(std::is_same_v<MechanicsOf<Undamped_>::Damping, Undamped>);
static_assert(std::is_empty_v<decltype(Problem<Smooth>::Parameters::damping)>);
static_assert(sizeof(Problem<Undamped_>::Parameters) + sizeof(Real) == sizeof(Problem<Damped>::Parameters));
static_assert(sizeof(InertiaForces<Undamped_>) + sizeof(Field) + 2 * sizeof(Real) == sizeof(InertiaForces<Damped>));
static_assert(std::is_empty_v<System<MechanicsOf<Still>>::Inertia> && !System<MechanicsOf<Still>>::weighs_body);

constexpr Real wave = 1000, length = 10, transit = length / wave, gap = 0.002;

template <class M>
typename M::Enforcement stiff(Real normal) {
  return {.normal = normal, .tangential = 0, .per = PenaltyPer::stiffness};
}
// A bar that flies at a wall at velocity 1, or that a wall hits at velocity 1. Force by the wave: rho c v A = 10.
template <class M>
std::unique_ptr<Problem<M>> bar(const TimeScheme& scheme, Real normal, bool wall_moves = false) {
  auto problem = std::make_unique<Problem<M>>(
      typename Problem<M>::Parameters{.body = mesh::rectangle({.size = {1, length}, .cells = {2, 50}}),
                                      .material = {.young = 1e4, .poisson = 0},
                                      .density = 1e-2, .time_integration = {.scheme = scheme},
                                      .contacts = {{.side = "bottom",
                                                    .tool = rigid::line({0, -gap}, {1, 0}),
                                                    .motion = [=](Real t) { return V(0, wall_moves ? t : 0); },
                                                    .enforcement = stiff<M>(normal),
                                                    .name = "wall"}}});
  if (!wall_moves) problem->start_velocity({0, -1});
  return problem;
}

template <class M>
void hits(const TimeScheme& scheme, Real normal, Index steps_per_transit, bool wall_moves = false) {
  CAPTURE(scheme.alpha_f);
  CAPTURE(normal);
  CAPTURE(steps_per_transit);
  const auto problem = bar<M>(scheme, normal, wall_moves);
  const Real dt = transit / Real(steps_per_transit), start = 0.05, mass = 0.1;
  const Index steps = 5 * steps_per_transit / 2;
  auto march = problem->march({.end = dt * Real(steps), .steps = steps, .tolerance = 1e-9});
  verify::EnergyBalance<M> ledger(*problem);
  Real largest = 0, end = 0, low = 100, high = 0, impulse = 0, first = -1, last = 0;
  for (const StepReport& step : march) {
    ledger.update(step);
    // Energy in the frame of the wall.
    Field v = problem->inertia().velocity(), momentum = Field::Zero(v.size());
    for (Index i = 1; i < v.size(); i += 2) v[i] -= wall_moves ? 1 : 0;
    problem->inertia().add_product(v, momentum);
    end = (0.5 * v.dot(momentum) + ledger.energies().elastic + ledger.energies().penalty) / start;
    largest = std::max(largest, end);
    const Real force = -problem->contact_force("wall")[1], t = (step.time - 0.5 * dt - gap) / transit;
    impulse += force * dt;
    if (t > 0.3 && t < 1.7) low = std::min(low, force), high = std::max(high, force);
    if (step.contact.touching > 0) last = t + 0.5 / Real(steps_per_transit);
    if (step.contact.touching > 0 && first < 0) first = t - 0.5 / Real(steps_per_transit);
    REQUIRE(std::abs(ledger.energies().unbalanced()) < 1e-4 * start);
  }
  REQUIRE(march.outcome());
  for (const Warning& warning : march.warnings()) CHECK(warning.name != "energy_gained");
  CHECK(largest < 1 + 1e-9);
  CHECK(low > 9.9);
  CHECK(high < 10.1);
  const bool overdamped = scheme.alpha_m < -0.9;  // radius 0
  CHECK(end > (overdamped ? 0.94 : 0.97));
  CHECK(end < 0.997);
  CHECK(impulse / mass - 1 > (overdamped ? 0.95 : 0.96));
  CHECK(impulse / mass - 1 < 0.997);
  const Real resolution = 0.5 / Real(steps_per_transit);
  // A spring as soft as a row of elements holds on to the bar for longer.
  CHECK((last - first) / 2 > 0.99 - resolution);
  CHECK((last - first) / 2 < (normal > 1 ? 1.03 : 1.05) + resolution);
}

TEST_CASE("a bar that hits a wall gains no energy, and its force is that of the wave") {
  for (const TimeScheme& scheme : {newmark(), chung_hulbert(0.9), chung_hulbert(0.5), chung_hulbert(0.0), hht(0.1)}) {
    for (const Real normal : {1.0, 100.0, 1e4}) hits<Smooth>(scheme, normal, 50);
    hits<Smooth>(scheme, 1e4, 100);
    hits<Exact>(scheme, 10, 50);
    hits<Exact>(scheme, 10, 100);
  }
  hits<Smooth>(chung_hulbert(0.5), 1e14, 100);  // closed at less
}

TEST_CASE("a bar at rest that a moving wall hits gains no energy, and its force is that of the wave") {
  hits<Smooth>(newmark(), 1e4, 100, true);
  hits<Exact>(chung_hulbert(0.5), 10, 100, true);
}

TEST_CASE("multipliers leave no gap that the motion of a step opens") {
  const auto problem = bar<Exact>(newmark(), 10);
  const Real dt = transit / 400;
  auto march = problem->march({.end = 200 * dt, .steps = 200, .tolerance = 1e-9});
  for (const StepReport& step : march)
    if (step.contact.touching > 0) CHECK(step.contact.max_penetration < 0.011 * dt);
  REQUIRE(march.outcome());
}

TEST_CASE("under a smooth pressure displacements converge at second order and forces at first") {
  const auto pressed = [](Index steps) {
    Problem<Smooth> p{{.body = mesh::rectangle({.size = {1, length}, .cells = {1, 20}}),
                       .material = {.young = 1e4, .poisson = 0},
                       .density = 1e-2,
                       .contacts = {{.side = "bottom",
                                     .tool = rigid::line({0, 0}, {1, 0}),
                                     .enforcement = stiff<Smooth>(1e4),
                                     .name = "wall"}}}};
    const Real end = 5 * transit;
    p.load("top", 1, [=](Real t) { return -10 * std::pow(t / end, 2) * (3 - 2 * t / end); });
    REQUIRE(p.march({.end = end, .steps = steps, .tolerance = 1e-12}).finish());
    return V(p.displacement(p.body().mesh().side("top").nodes[0])[1], p.contact_force("wall")[1]);
  };
  const V reference = pressed(3200), coarse = pressed(100) - reference, fine = pressed(200) - reference;
  CHECK(std::abs(coarse[0] / reference[0]) < 1e-3);
  CHECK(std::log2(coarse[0] / fine[0]) > 1.8);
  CHECK(std::abs(coarse[1] / reference[1]) < 2e-2);
  CHECK(std::log2(coarse[1] / fine[1]) > 0.8);
}

TEST_CASE("a node pulled off the tool separates in the same step") {
  Problem<Smooth> block{{.body = mesh::rectangle({.cells = {1, 1}}),
                         .material = {.young = 1e4, .poisson = 0},
                         .density = 1,
                         .contacts = {{.side = "bottom",
                                       .tool = rigid::line({0, 0}, {1, 0}),
                                       .enforcement = stiff<Smooth>(100),
                                       .name = "wall"}}}};
  // A force on the foot itself, so that no wave comes in between.
  block.load("bottom", 1, [](Real t) { return t < 0.5 ? -1 : 1; });
  auto march = block.march({.end = 1, .steps = 100, .tolerance = 1e-9});
  for (const StepReport& step : march)
    if (step.number > 5) CHECK(step.contact.touching == (step.time < 0.5 - 1e-9 ? 2 : 0));
  REQUIRE(march.outcome());
}

TEST_CASE("a reaction contains the contact force at its nodes once") {
  // Driven into a wall with all the block at that velocity: nothing is strained, support and tool hold each other.
  Problem<Smooth> block{
      {.body = mesh::rectangle({.cells = {2, 2}}),
       .material = {.young = 1e3, .poisson = 0},
       .density = 1,
       .contacts = {
           {.side = "bottom", .tool = rigid::line({0, 0}, {1, 0}), .enforcement = {.normal = 100}, .name = "wall"}}}};
  for (const char* side : {"bottom", "top"}) block.drive(side, 1, [](Real t) { return -t; });
  block.start_velocity({0, -1});
  auto march = block.march({.end = 0.1, .steps = 20, .tolerance = 1e-9});
  verify::EnergyBalance<Smooth> ledger(block);
  for (const StepReport& step : march) {
    ledger.update(step);
    CHECK(block.contact_force("wall")[1] == doctest::Approx(-300 * step.time).epsilon(1e-9));
    CHECK(block.reaction("bottom", 1) == doctest::Approx(block.contact_force("wall")[1]).epsilon(1e-9));
    CHECK(std::abs(block.reaction("top", 1)) < 1e-9);
    CHECK(std::abs(ledger.energies().unbalanced()) < 1e-9 * ledger.energies().penalty);
    CHECK(block.inertia().velocity()[1] == doctest::Approx(-1));
  }
  REQUIRE(march.outcome());
  CHECK(ledger.energies().kinetic == doctest::Approx(0.5));
}

// A block of one element and mass 1 on a rough plate.
std::unique_ptr<Problem<Damped>> plated(const V& centre, const rigid::Tool<2>& plate, const rigid::Motion<2>& motion,
                                        const char* side) {
  return std::make_unique<Problem<Damped>>(Problem<Damped>::Parameters{
      .body = mesh::rectangle({.origin = centre - V(0.5, 0.5), .size = {1, 1}, .cells = {1, 1}}),
      .material = {.young = 1e4, .poisson = 0.3},
      .density = 1,
      .damping = {.tau = 1e-2},
      .contacts = {{.side = side,
                    .tool = plate,
                    .motion = motion,
                    .friction = {.mu = 10},
                    .enforcement = {.normal = 100, .tangential = 100, .per = PenaltyPer::stiffness},
                    .name = "plate"}}});
}

TEST_CASE("a tool that accelerates pushes with mass times acceleration") {
  // Half the mass is that of contact nodes: their velocities must be the tool's at the end of the step, not its mean.
  const auto block = plated(
      {0.5, 0.5}, rigid::line({0, 0}, {1, 0}), [](Real t) { return V(0, t * t); }, "bottom");
  auto march = block->march({.end = 2, .steps = 200, .tolerance = 1e-9});
  for (const StepReport& step : march)
    if (step.time > 1) CHECK(block->contact_force("plate")[1] == doctest::Approx(-2).epsilon(1e-2));
  REQUIRE(march.outcome());
  for (Index n = 0; n < 4; ++n) CHECK(block->inertia().velocity()[2 * n + 1] == doctest::Approx(4).epsilon(1e-3));
}

TEST_CASE("a block that sticks to a rotating plate moves on its circle") {
  const auto block = plated(
      {0, 9.5}, rigid::line({0, 10}, {-1, 0}),
      [](Real t) {
        return rigid::turned(t, {0, 0});
      },
      "top");
  block->start_velocity([](const V& x) { return V(-x[1], x[0]); });
  auto march = block->march({.end = 2, .steps = 400, .tolerance = 1e-9});
  for (const StepReport& step : march)
    if (step.time > 1) {
      const V force = block->contact_force("plate");
      const V outwards(-std::sin(step.time), std::cos(step.time));
      CHECK(force.dot(outwards) == doctest::Approx(9.5).epsilon(1e-2));
      CHECK(std::abs(force.dot(V(outwards[1], -outwards[0]))) < 0.2);
    }
  REQUIRE(march.outcome());
}

TEST_CASE("a force on a rotating normal has the direction halfway through the step, and its impulse is bounded") {
  const auto at = [](Real angle) { return V(std::cos(angle), std::sin(angle)); };
  const V force = 3 * at(0.9);  // of any direction against the normal
  CHECK((halfway<2>(at(0.1), at(0.5), force) - 3 * at(0.7)).norm() < 1e-14);
  CHECK((halfway<2>(at(0.5), at(0.5), force) - force).norm() < 1e-14);
  CHECK((halfway<2>(at(0.5 - 0.5 * pi), at(0.5), force) - force).norm() == 0);  // an edge
  const Vec<Real, 3> n0(0, 0, 1), n1(0, std::sin(0.4), std::cos(0.4)), along(1, 0, 0);
  CHECK((halfway<3>(n0, n1, Vec<Real, 3>(along + 2 * n1)) - Vec<Real, 3>(1, 2 * std::sin(0.2), 2 * std::cos(0.2)))
            .norm() < 1e-14);
  CHECK(share_within<2>({1, 0}, {1, 0}, 4) == doctest::Approx(1));
  CHECK(share_within<2>({1, 0}, {2, 0}, 4) == doctest::Approx(0.5));
  CHECK(share_within<2>({1, 0}, {1, 0}, 0.5) == 0);
  CHECK(share_within<2>({1, 0}, {-1, 0}, 0) == 1);
  // Normal velocities: hard contact, a spring that the step resolves, a node at rest.
  CHECK(persistent(-1, 1, 0) == 0);
  CHECK(persistent(-1, -0.9, -0.95) == -0.9);
  CHECK(persistent(0, -1, -0.5) == -0.5);
}

TEST_CASE("stiffness damping has the ratio tau omega / 2, and its work is in the energy balance") {
  Problem<Damped> rod{
      {.body = mesh::rectangle({.size = {1, length}, .cells = {1, 20}}),
       .material = {.young = 1e4, .poisson = 0},
       .density = 1e-2, .time_integration = {.scheme = newmark()},
       .damping = {.tau = 2e-4},
       .contacts = {
           {.side = "top", .tool = rigid::line({0, 20}, {-1, 0}), .enforcement = {.normal = 1, .tangential = 1}}}}};
  rod.hold("bottom", 1);
  rod.start_velocity([](const V& x) { return V(0, 1e-3 * std::sin(0.5 * pi * x[1] / length)); });
  const Real omega = 0.5 * pi / transit, end = 4 * 2 * pi / omega;
  auto march = rod.march({.end = end, .steps = 800, .tolerance = 1e-11});
  verify::EnergyBalance<Damped> ledger(rod);
  for (const StepReport& step : march) ledger.update(step);
  REQUIRE(march.outcome());
  const auto& e = ledger.energies();
  CHECK((e.kinetic + e.elastic) / e.external == doctest::Approx(std::exp(-2e-4 * omega * omega * end)).epsilon(0.01));
  CHECK(e.damping + e.kinetic + e.elastic == doctest::Approx(e.external).epsilon(1e-3));
  CHECK(std::abs(e.unbalanced()) < 1e-9 * e.external);
}

// A soft block of 1 x 0.5 m on a plane, pressed by its weight and pulled along by `along` times that.
std::unique_ptr<Problem<Damped>> slider(Real tau, Real mu, const TimeScheme& scheme,
                                        const std::function<Real(Real)>& down, const std::function<Real(Real)>& along) {
  auto block = std::make_unique<Problem<Damped>>(Problem<Damped>::Parameters{
      .body = mesh::rectangle({.size = {1, 0.5}, .cells = {8, 4}}),
      .material = {.young = 1e7, .poisson = 0.3},
      .density = 1000, .time_integration = {.scheme = scheme},
      .damping = {.tau = tau},
      .contacts = {{.side = "bottom",
                    .tool = rigid::line({0, 0}, {1, 0}),
                    .friction = {.mu = mu},
                    .enforcement = {.normal = 100, .tangential = 100, .per = PenaltyPer::stiffness},
                    .name = "plane"}}});
  for (const char* side : {"top", "bottom"}) {
    block->load(side, 1, [=](Real t) { return -0.5 * down(t); });
    block->load(side, 0, [=](Real t) { return 0.5 * along(t); });
  }
  return block;
}
constexpr Real weight = 500 * 9.81;
Real ramp(Real t) {
  const Real s = std::min(1.0, 2 * t);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

TEST_CASE("with 3 ms of damping a soft block slides down a slope as a rigid one does") {
  for (const Real radius : {0.5, 1.0}) {
    CAPTURE(radius);
    const Real cosine = 1 / std::sqrt(1.25), sine = 0.5 * cosine;
    const auto block = slider(
        3e-3, 0.49, chung_hulbert(radius), [=](Real t) { return weight * cosine * ramp(t); },
        [=](Real t) { return weight * sine * ramp(t); });
    auto march = block->march({.end = 4, .steps = 1000, .tolerance = 1e-8});
    Real v1 = 0;
    for (const StepReport& step : march) {
      if (step.time < 2 - 1e-9) continue;
      const Real force = -block->contact_force("plane")[1] / (weight * cosine);
      CHECK(force == doctest::Approx(1).epsilon(1e-3));
      if (v1 == 0) v1 = block->inertia().velocity()[0];
    }
    REQUIRE(march.outcome());
    for (const Warning& warning : march.warnings()) CHECK(warning.name != "energy_gained");
    CHECK((block->inertia().velocity()[0] - v1) / 2 == doctest::Approx(0.0877).epsilon(0.01));
  }
}

TEST_CASE("without damping flutter by friction grows as its eigenvalue predicts, and there is none without friction") {
  for (const Real mu : {0.0, 0.49}) {
    CAPTURE(mu);
    // Steady sliding in large steps, which damp all vibrations; then small ones, and a disturbance of 1e-6.
    const Real start = 4;
    const auto block = slider(
        1e-12, mu, chung_hulbert(0.5),
        [=](Real t) {
          const Real s = (t - start) / 4e-3;
          return weight * (ramp(t) + (s > 0 && s < 1 ? 1e-6 * std::sin(pi * s) : 0.0));
        },
        [=](Real t) { return mu * weight * ramp(t); });
    block->start_velocity({1, 0});
    REQUIRE(block->march({.end = start, .steps = 80, .tolerance = 1e-10}).finish());
    auto march = block->march({.end = start + 0.25, .steps = 1500, .tolerance = 1e-10});
    Real before = 0, last = 0, largest = 0;
    std::vector<V> peaks;
    for (const StepReport& step : march) {
      const Real now = -block->contact_force("plane")[1] / weight - 1;
      if (last > before && last > now && step.time > start + 0.09) peaks.emplace_back(step.time - step.dt, last);
      before = last;
      last = now;
      largest = std::max(largest, std::abs(now));
    }
    REQUIRE(march.outcome());
    if (mu == 0) {
      CHECK(largest < 1e-5);
      continue;
    }
    REQUIRE(peaks.size() > 4);
    const V a = peaks[1], b = peaks.back();
    CHECK(Real(peaks.size() - 2) / (b[0] - a[0]) == doctest::Approx(43).epsilon(0.03));
    const Real growth = std::log(b[1] / a[1]) / (b[0] - a[0]);
    CHECK(growth > 44);
    CHECK(growth < 54);
  }
}

TEST_CASE("a restart in contact continues bit for bit") {
  const auto scene = [] {
    auto block = plated(
        {0.5, 0.5}, rigid::line({0, 0}, {1, 0}), [](Real t) { return V(0.3 * t, t * t); }, "bottom");
    block->start_velocity({0.5, 0});
    return block;
  };
  const MarchOptions options{.end = 0.4, .steps = 80};
  const auto whole = scene(), again = scene();
  auto march = whole->march(options);
  Archive kept;
  Index touching = 0;
  for (const StepReport& step : march)
    if (step.number == 30) {
      kept = Archive::of(march);
      touching = step.contact.touching;
    }
  REQUIRE(march.outcome());
  REQUIRE(touching > 0);
  auto restored = again->march(options);
  kept.restore(restored);
  REQUIRE(restored.finish());
  CHECK(restored.report().steps == march.report().steps);
  CHECK((again->displacement().array() == whole->displacement().array()).all());
  CHECK((again->inertia().velocity().array() == whole->inertia().velocity().array()).all());
}

TEST_CASE("energy gained by the scheme warns, and ends the run on request") {
  // The trapezoidal rule on large rotations: averaged forces are no gradient.
  const auto swaying = [](MarchOptions options, RunReport& report, Outcome& outcome) {
    Problem<Smooth> block{
        {.body = mesh::rectangle({.size = {1, 2}, .cells = {1, 2}}),
         .material = {.young = 100, .poisson = 0.3},
         .density = 1, .time_integration = {.scheme = newmark()},
         .contacts = {{.side = "top", .tool = rigid::line({0, 20}, {-1, 0}), .enforcement = {.normal = 1}}}}};
    block.hold("bottom", 0).hold("bottom", 1);
    block.start_velocity([](const V& x) { return V(2.5 * x[1], 0); });
    options.end = 4;
    options.tolerance = 1e-9;
    auto march = block.march(options);
    outcome = march.finish();
    report = march.report();
    CHECK((outcome ? report.steps == options.steps : block.time() == outcome.time));
    return march.warnings();
  };
  RunReport report;
  Outcome outcome;
  const auto coarse = swaying({.steps = 20}, report, outcome);
  REQUIRE(outcome);
  REQUIRE(coarse.size() == 1);
  CHECK(coarse[0].name == "energy_gained");
  CHECK(coarse[0].step > 0);
  CHECK(swaying({.steps = 400}, report, outcome).empty());
  CHECK(swaying({.steps = 20, .energy_gain = 0}, report, outcome).empty());
  const auto refused = swaying({.steps = 20, .refuse_energy_gain = true}, report, outcome);
  CHECK(outcome.failure.cause == FailureCause::energy_gained);
  CHECK(report.steps == coarse[0].step);
  CHECK(outcome.message().find(coarse[0].text) != std::string::npos);
  CHECK(refused.size() == 1);
  Problem<Smooth> any{
      {.body = mesh::rectangle({}), .material = {.young = 1, .poisson = 0}, .density = 1}};
  CHECK_THROWS_WITH_AS((void)any.march({.energy_gain = -1}), "march: the energy gain must not be negative",
                       std::invalid_argument);
}

TEST_CASE("a damping without a time constant is refused by name") {
  CHECK_THROWS_WITH_AS(
      (Problem<Damped>{
          {.body = mesh::rectangle({}), .material = {.young = 1, .poisson = 0}, .density = 1}}),
      "stiffness damping: the time constant tau must be positive", std::invalid_argument);
}

}  // namespace impact
