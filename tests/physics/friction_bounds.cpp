// SPDX-License-Identifier: BSL-1.0
// The bounds beside Coulomb's, in closed form.
#include "sliding_block.hpp"

#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>

namespace friction_bounds {

using namespace scene;

constexpr Real length = 4;  // of the block, and its area at unit thickness

TEST_CASE("under Tresca's law a sliding block is dragged by tau A at every pressure") {
  int sliding = 0;
  (void)sliding_block<Tresca>({.tau = 20}, 50, 0.02, [&](const StepReport& step, const V& force) {
    CHECK(step.contact.dissipated >= 0);
    CHECK(step.lag == 0);
    CHECK(step.contact.friction_capacity == doctest::Approx(20 * length).epsilon(1e-13));
    if (step.contact.sliding < 5) return;
    ++sliding;
    CHECK(std::abs(force[0]) == doctest::Approx(20 * length).epsilon(1e-13));
  });
  CHECK(sliding > 20);
}

TEST_CASE("Tresca's bound on a ring takes the area of the full turn for every penalty unit") {
  using M = Model<EigenDirect, Tresca, Hencky, Axisymmetric>;
  for (const PenaltyPer per : {PenaltyPer::unit_depth, PenaltyPer::area}) {
    Problem<M> p({.body = mesh::rectangle({.origin = {3, 0}, .size = {1, 2}, .cells = {3, 2}}),
                  .material = material<Hencky>(),
                  .contacts = {{.side = "top",
                                .tool = rigid::line({0, 2}, {-1, 0}),
                                .motion = [](Real t) { return V(0.1 * t, -0.02); },
                                .friction = {.tau = 5},
                                .enforcement = {.normal = 1e5, .tangential = 1e5, .per = per}}}});
    p.hold("bottom", 0).hold("bottom", 1);
    auto march = p.march({.end = 1, .steps = 4});
    for (const StepReport& step : march)
      CHECK(step.contact.friction_capacity == doctest::Approx(5 * pi * (16 - 9)).epsilon(1e-12));
    CHECK(bool(march.outcome()));
    CHECK(p.contact_force("top")[0] == doctest::Approx(-5 * pi * (16 - 9)).epsilon(1e-12));
  }
}

TEST_CASE("under capped Coulomb a block is dragged by mu N below the cap and by tau_max A at it") {
  const V coulomb = sliding_block<Coulomb>({.mu = 0.3}, 20, 0.02);
  const V below = sliding_block<CappedCoulomb>({.mu = 0.3, .tau_max = 1e6}, 20, 0.02);
  CHECK(below == coulomb);
  const V at = sliding_block<CappedCoulomb>({.mu = 0.3, .tau_max = 30}, 20, 0.02);
  CHECK(0.3 * -at[1] > 2 * 30 * length);
  CHECK(std::abs(at[0]) == doctest::Approx(30 * length).epsilon(1e-13));
  const V foretold = sliding_block<WithPressure<CappedCoulomb, Extrapolated>>({.mu = 0.3, .tau_max = 30}, 20, 0.02);
  CHECK(foretold[0] == doctest::Approx(at[0]).epsilon(1e-12));
}

TEST_CASE("under Stribeck's law a block of constant speed is dragged by mu(v) N at every step size") {
  const Stribeck law{.mu_static = 0.4, .mu_dynamic = 0.1, .speed = 3};
  CHECK(law.coefficient(speed) > 0.2);
  for (const Index steps : {50, 100}) {
    const V force = sliding_block<Stribeck>(law, steps, 0);
    CHECK(std::abs(force[0]) == doctest::Approx(law.coefficient(speed) * -force[1]).epsilon(1e-8));
  }
}

TEST_CASE("under slip weakening a block is dragged by mu of the slid distance times N") {
  const SlipWeakeningCoulomb law{.mu_static = 0.4, .mu_dynamic = 0.1, .length = 1};
  (void)sliding_block<Quasi<SlipWeakeningCoulomb>>(law, 100, 0, [&](const StepReport& step, const V& force) {
    CHECK(step.contact.dissipated >= 0);
    if (step.time < 0.2) return;
    const Real mu = law.bound(InterfaceState<Real>{1, step.contact.max_slip}).value;
    CHECK(std::abs(force[0]) == doctest::Approx(mu * -force[1]).epsilon(0.01));
  });
}

}  // namespace friction_bounds
