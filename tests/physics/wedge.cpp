// SPDX-License-Identifier: BSL-1.0
// A block that a given horizontal force drives up a wedge: the scene in which a bound that lags feeds back on itself.
#include "scene.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

#include <doctest/doctest.h>

namespace {

using namespace scene;

constexpr Real slope = 0.115, force = 100;

struct Slide {
  stickslip::Outcome outcome;
  Real ratio = 0;  // of the horizontal force to the vertical one that the block carries
  Real lag = 0;    // of the last step
  RunReport report{};
};

// The force is brought up while the block, whose front edge stands on the wedge, is held at its height. Then it rises.
template <class F, class S>
Slide climb(Real mu, Index steps = 40, Real tolerance = 1e-9) {
  using M = Model<S, F>;
  Problem<M> block{{.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}),
                    .material = {.young = 2e5, .poisson = 0.3},
                    .contacts = {{.side = "bottom",
                                  .tool = rigid::line({0, 0}, {1, slope}),
                                  .motion = [](Real) { return V(4, 0); },
                                  .friction = {.mu = mu},
                                  .enforcement = {.normal = 1e5, .tangential = 1e4, .per = PenaltyPer::area},
                                  .name = "wedge"}}}};
  block.drive("top", 1, [](Real t) { return 0.5 * std::max(0.0, t - 1); });
  block.load("left", 0, [](Real t) { return force * std::min(1.0, t); });
  auto march =
      block.march({.end = 2, .steps = steps, .tolerance = tolerance, .outer_tolerance = 1e-8, .max_outer = 60});
  Slide slide;
  for (const StepReport& step : march) slide.lag = step.lag;
  slide.outcome = march.outcome();
  slide.report = march.report();
  slide.ratio = force / -block.reaction("top", 1);
  return slide;
}

Real exact(Real mu) {
  return (slope + mu) / (1 - mu * slope);
}

TEST_CASE("on a wedge the current pressure and all sources that converge to it are exact at every friction") {
  for (const Real mu : {0.1, 0.2, 0.5}) {  // kappa of 0.87, 1.7 and 4.3
    const auto check = [mu](const char* name, const Slide& slide) {
      CAPTURE(mu);
      CAPTURE(name);
      REQUIRE_MESSAGE(slide.outcome, slide.outcome.message());
      CHECK(std::abs(slide.ratio / exact(mu) - 1) < 1e-6);
    };
    check("Coulomb", climb<Coulomb, EigenLu>(mu));
    check("on a symmetric factor", climb<Coulomb, Corrected<EigenLdlt>>(mu));
    check("lag iterated", climb<WithPressure<Coulomb, LagIterated>, EigenLdlt>(mu));
    for (const Index steps : {4, 10, 160})
      check("symmetrised", climb<WithPressure<Coulomb, Symmetrised>, EigenLdlt>(mu, steps));
    check("symmetrised, pivoted band", climb<WithPressure<Coulomb, Symmetrised>, Banded>(mu));
  }
}

TEST_CASE("on a wedge a lagged bound is right or refused as lag_unstable, at every number of steps") {
  for (const Index steps : {4, 10, 40, 160, 640}) {
    CAPTURE(steps);
    const Slide mild = climb<QuasiCoulomb, EigenLdlt>(0.1, steps);
    if (mild.outcome)
      CHECK(std::abs(mild.ratio / exact(0.1) - 1) < std::max(steps < 40 ? mild.lag : 0.0, 0.01));
    else
      CHECK(mild.outcome.failure.cause == FailureCause::lag_unstable);
    if (steps >= 40) CHECK(mild.outcome);  // it settles by 0.87 a step
    for (const Real mu : {0.2, 0.5}) {
      CAPTURE(mu);
      const Slide strong = climb<QuasiCoulomb, EigenLdlt>(mu, steps);
      CHECK_FALSE(strong.outcome);
      CHECK(strong.outcome.failure.cause == FailureCause::lag_unstable);
      CHECK(strong.outcome.message().find("lag") != std::string::npos);
    }
    // The extrapolated bound is out of its range from the start: 0.87 is above a third.
    for (const Real mu : {0.1, 0.2, 0.5}) {
      const Slide ahead = climb<ExtrapolatedCoulomb, EigenLdlt>(mu, steps);
      CHECK_FALSE(ahead.outcome);
      CHECK(ahead.outcome.failure.cause == FailureCause::lag_unstable);
    }
  }
  // Below a third it settles.
  const Slide ahead = climb<ExtrapolatedCoulomb, EigenLdlt>(0.03, 160);
  REQUIRE_MESSAGE(ahead.outcome, ahead.outcome.message());
  CHECK(std::abs(ahead.ratio / exact(0.03) - 1) < 1e-4);
}

// A block that has lost its wedge has no support along it. A pivoted factorisation goes through on a pivot of round-off
// and throws the block so far that round-off outweighs the load.
TEST_CASE("on a wedge a pivoting solver finds no equilibrium where there is none") {
  for (const Real mu : {0.2, 0.5})
    for (const Index steps : {10, 40, 160}) {
      CAPTURE(mu);
      CAPTURE(steps);
      CHECK(climb<QuasiCoulomb, Banded>(mu, steps).outcome.failure.cause == FailureCause::lag_unstable);
      CHECK(climb<ExtrapolatedCoulomb, Banded>(mu, steps).outcome.failure.cause == FailureCause::lag_unstable);
      const Slide iterated = climb<WithPressure<Coulomb, LagIterated>, Banded>(mu, steps);
      REQUIRE_MESSAGE(iterated.outcome, iterated.outcome.message());
      CHECK(std::abs(iterated.ratio / exact(mu) - 1) < 1e-6);
      // Every iteration factorises once, those of passes that are held back as well, in which a factor or two may fail.
      const RunReport& report = iterated.report;
      CHECK(report.iterations <= report.work.factorizations);
      CHECK(report.iterations >= report.work.factorizations - 2);
    }
}

}  // namespace
