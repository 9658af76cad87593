// SPDX-License-Identifier: BSL-1.0
// Implicit dynamics: order, momentum, energy, rigid rotation, impact.
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/time_integration/quasistatic.hpp>
#include <stickslip/verify/energy.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <type_traits>

namespace inertia {

using namespace stickslip;

struct Flying {
  using Kinematics = PlaneStrain;
  using Element = MeanDilatation<Quad4>;
  using Material = Hencky;
  using Friction = Frictionless;
  using Enforcement = NoContact;
  using TimeIntegration = GeneralizedAlpha;
  using LinearSolver = EigenLdlt;
};
struct Landing : Flying {
  using Enforcement = Penalty;
};
struct Skidding : Landing {
  using Material = FiniteJ2<LinearHardening>;
  using Friction = QuasiCoulomb;
};
struct Resting : Flying {
  using TimeIntegration = Quasistatic;
};

// What is not called for is not there; inertia does not widen the symmetry.
static_assert(std::is_empty_v<System<Resting>::Inertia>);
static_assert(!std::is_empty_v<System<Flying>::Inertia>);
static_assert(system_symmetry<Skidding> == Symmetry::symmetric && Problem<Skidding>::symmetric_storage);
static_assert(sizeof(Problem<Resting>) < sizeof(Problem<Flying>));

const Hencky rubber{.young = 100, .poisson = 0.3};

// A block of 2 x 2, held at its foot and started sideways: it sways by half its height.
Field swayed(const TimeScheme& scheme, Index steps, bool lumped = false) {
  Problem<Flying> block{{.body = mesh::rectangle({.size = {1, 2}, .cells = {2, 4}}),
                         .material = rubber,
                         .density = 1, .time_integration = {.scheme = scheme, .lumped = lumped}}};
  block.hold("bottom", 0).hold("bottom", 1);
  block.start_velocity([](const Vec<Real, 2>& X) { return Vec<Real, 2>(2.5 * X[1], 0); });
  auto march = block.march({.end = 0.5, .steps = steps, .tolerance = 1e-10});
  REQUIRE(march.finish());
  REQUIRE(march.report().steps == steps);
  return block.displacement();
}

TEST_CASE("the schemes are of second order on a nonlinear vibration") {
  for (const TimeScheme& scheme : {chung_hulbert(0.0), chung_hulbert(0.5), chung_hulbert(1.0), newmark(), hht(0.1)}) {
    CAPTURE(scheme.alpha_f);
    const Field reference = swayed(scheme, 6400);
    REQUIRE(reference.lpNorm<Eigen::Infinity>() > 0.5);
    const Real coarse = (swayed(scheme, 200) - reference).norm(), fine = (swayed(scheme, 400) - reference).norm();
    const Real order = std::log2(coarse / fine);
    CHECK(order > 1.85);
    CHECK(order < 2.2);
  }
}

TEST_CASE("first-order weights converge at first order") {
  // gamma > 1/2 without the means of generalised-alpha: the contrast that shows the test above can fail.
  const Field reference = swayed(newmark(), 3200);
  const Real coarse = (swayed(newmark(0.49, 0.9), 100) - reference).norm(),
             fine = (swayed(newmark(0.49, 0.9), 200) - reference).norm();
  CHECK(std::log2(coarse / fine) < 1.3);
}

TEST_CASE("consistent and lumped mass have the same total and differ by the mesh only") {
  for (const bool lumped : {false, true}) {
    Problem<Flying> block{{.body = mesh::rectangle({.size = {1, 2}, .cells = {3, 5}}),
                           .kinematics = {.thickness = 0.7},
                           .material = rubber,
                           .density = 3, .time_integration = {.lumped = lumped}}};
    block.start_velocity({4, 0});
    CHECK(block.inertia().kinetic_energy() == doctest::Approx(0.5 * 3 * 2 * 0.7 * 16).epsilon(1e-13));
  }
  const Field consistent = swayed(newmark(), 800), lumped = swayed(newmark(), 800, true);
  const Real difference = (consistent - lumped).norm() / consistent.norm();
  CHECK(difference > 1e-4);
  CHECK(difference < 0.1);
}

TEST_CASE("a body in free flight keeps its momentum and takes no strain") {
  Problem<Flying> block{
      {.body = mesh::rectangle({.cells = {3, 3}}), .material = rubber, .density = 2}};
  block.start_velocity({3, -1});
  auto march = block.march({.end = 100, .steps = 50});
  verify::EnergyBalance<Flying> ledger(block);
  for (const StepReport& step : march) ledger.update(step);
  REQUIRE(march.outcome());
  for (Index n = 0; n < block.body().mesh().node_count(); ++n)
    CHECK((block.displacement(n) - Vec<Real, 2>(300, -100)).norm() < 1e-9);
  CHECK(ledger.energies().elastic < 1e-18 * ledger.energies().kinetic);
  CHECK(march.report().iterations == 0);  // the guess is the motion
}

TEST_CASE("a rigid rotation continues without strain") {
  Problem<Flying> block{{.body = mesh::rectangle({.origin = {-0.5, -0.5}, .cells = {2, 2}}),
                         .material = {.young = 1e6, .poisson = 0.3},
                         .density = 1, .time_integration = {.scheme = chung_hulbert(0.5)}}};
  block.start_velocity([](const Vec<Real, 2>& X) { return Vec<Real, 2>(-X[1], X[0]); });
  const auto angular_momentum = [&] {
    Field momentum = Field::Zero(block.displacement().size());
    block.inertia().add_product(block.inertia().velocity(), momentum);
    Real sum = 0;
    for (Index n = 0; n < block.body().mesh().node_count(); ++n) {
      const Vec<Real, 2> x = block.body().mesh().nodes[std::size_t(n)] + block.displacement(n);
      sum += x[0] * momentum[2 * n + 1] - x[1] * momentum[2 * n];
    }
    return sum;
  };
  const Real before = angular_momentum();
  auto march = block.march({.end = 2 * pi, .steps = 400, .tolerance = 1e-8});
  verify::EnergyBalance<Flying> ledger(block);
  for (const StepReport& step : march) {
    ledger.update(step);
    // Centrifugal strain is of the order density omega^2 / young.
    REQUIRE(ledger.energies().elastic < 1e-5 * ledger.energies().kinetic);
  }
  REQUIRE(march.outcome());
  for (Index n = 0; n < block.body().mesh().node_count(); ++n)
    CHECK(block.displacement(n).norm() < 5e-3);  // once around
  CHECK(angular_momentum() == doctest::Approx(before).epsilon(1e-3));
}

TEST_CASE("the energy balance closes when an elastic block rebounds from a rigid wall") {
  for (const Real radius : {0.0, 0.5, 1.0}) {
    CAPTURE(radius);
    Problem<Landing> block{
        {.body = mesh::rectangle({.cells = {3, 3}}),
         .material = {.young = 1000, .poisson = 0.3},
         .density = 1, .time_integration = {.scheme = chung_hulbert(radius)},
         .contacts = {{.side = "bottom", .tool = rigid::line({0, -0.05}, {1, 0}), .enforcement = {.normal = 2e3}}}}};
    block.start_velocity({0, -1});
    auto march = block.march({.end = 0.4, .steps = 1600, .tolerance = 1e-11});
    verify::EnergyBalance<Landing> ledger(block);
    bool touched = false;
    for (const StepReport& step : march) {
      ledger.update(step);
      touched = touched || step.contact.touching > 0;
      REQUIRE(std::abs(ledger.energies().unbalanced()) < 1e-6 * ledger.energies().external);
    }
    REQUIRE(march.outcome());
    CHECK(touched);
    const auto& e = ledger.energies();
    CHECK(e.external == doctest::Approx(0.5).epsilon(1e-12));  // nothing but the start went in
    CHECK(e.penalty == 0);                                     // it has left the wall
    // Damping schemes take a little, none gives; what is not lost is in motion and vibration.
    CHECK(std::abs(e.algorithmic) < 0.03 * e.external);
    if (radius < 1) CHECK(e.algorithmic > 0);
    Real upwards = 0;
    for (Index n = 0; n < block.body().mesh().node_count(); ++n) upwards += block.inertia().velocity()[2 * n + 1];
    CHECK(upwards / block.body().mesh().node_count() > 0.5);
  }
}

TEST_CASE("the energy balance closes when a plastic block slides over a rough floor") {
  Problem<Skidding> block{{.body = mesh::rectangle({.cells = {3, 3}}),
                           .material = {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 50}},
                           .density = 1,
                           .contacts = {{.side = "bottom",
                                         .tool = rigid::line({0, -0.01}, {1, 0}),
                                         .friction = {.mu = 0.3},
                                         .enforcement = {.normal = 2e3, .tangential = 2e3}}}}};
  block.start_velocity({1, -0.5});
  auto march = block.march({.end = 0.3, .steps = 600, .tolerance = 1e-11});
  verify::EnergyBalance<Skidding> ledger(block);
  Real friction = 0;
  for (const StepReport& step : march) {
    ledger.update(step);
    CHECK(ledger.energies().friction >= friction);
    friction = ledger.energies().friction;
  }
  REQUIRE(march.outcome());
  const auto& e = ledger.energies();
  CHECK(e.friction > 0);
  CHECK(e.plastic > 0);
  CHECK(std::abs(e.unbalanced()) < 1e-6 * e.external);
  CHECK(std::abs(e.algorithmic) < 0.05 * e.external);
}

TEST_CASE("steps keep the local error below its tolerance, and the error of the answer decreases with it") {
  const Field reference = swayed(chung_hulbert(0.5), 6400);
  Real last_error = 1;
  Index last_steps = 0;
  for (const Real tolerance : {1e-3, 1e-4, 1e-5}) {
    Problem<Flying> block{{.body = mesh::rectangle({.size = {1, 2}, .cells = {2, 4}}),
                           .material = rubber,
                           .density = 1, .time_integration = {.scheme = chung_hulbert(0.5)}}};
    block.hold("bottom", 0).hold("bottom", 1);
    block.start_velocity([](const Vec<Real, 2>& X) { return Vec<Real, 2>(2.5 * X[1], 0); });
    auto march = block.march({.end = 0.5, .initial = 1e-4, .tolerance = 1e-10, .time_tolerance = tolerance});
    for (const StepReport& step : march) CHECK(step.local_error <= 2 * tolerance);
    REQUIRE(march.outcome());
    const Real error = (block.displacement() - reference).norm();
    CHECK(error < 0.5 * last_error);
    CHECK(march.report().steps > 1.5 * last_steps);
    last_error = error;
    last_steps = march.report().steps;
  }
  CHECK(last_error < 1e-3 * reference.norm());
}

TEST_CASE("an imposed velocity with a consistent start causes no wave") {
  Problem<Flying> bar{{.body = mesh::rectangle({.size = {1, 5}, .cells = {1, 10}}),
                       .material = rubber,
                       .density = 1}};
  bar.drive("top", 1, [](Real t) { return -2 * t; }).start_velocity({0, -2});
  auto march = bar.march({.end = 1, .steps = 20});
  for ([[maybe_unused]] const StepReport& step : march) CHECK(std::abs(bar.reaction("top", 1)) < 1e-9);
  REQUIRE(march.outcome());
}

TEST_CASE("a start velocity acts before the first step and is refused after it") {
  const auto bar = [] {
    return Problem<Flying>{{.body = mesh::rectangle({.size = {1, 5}, .cells = {1, 10}}),
                            .material = rubber,
                            .density = 1}};
  };
  auto before = bar(), begun = bar();
  before.start_velocity({0, -2});
  CHECK(bool(before.march({.end = 1, .steps = 5}).finish()));
  auto march = begun.march({.end = 1, .steps = 5});
  begun.start_velocity({0, -2});
  CHECK(bool(march.finish()));
  CHECK(begun.displacement() == before.displacement());
  CHECK_THROWS_WITH_AS(begun.start_velocity({0, 0}), "start velocity: the run has begun, it is at time 1 already",
                       std::invalid_argument);
}

TEST_CASE("an inertia without density is refused by name") {
  CHECK_THROWS_WITH_AS((Problem<Flying>{{.body = mesh::rectangle({}), .material = rubber}}),
                       "inertia: the density must be positive", std::invalid_argument);
  CHECK_THROWS_AS((void)chung_hulbert(1.5), std::invalid_argument);
  CHECK_THROWS_AS((void)hht(0.5), std::invalid_argument);
  CHECK_THROWS_AS((void)newmark(0.25, 0.4), std::invalid_argument);
}

}  // namespace inertia
