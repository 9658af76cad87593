// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/solve/error_estimates.hpp>
#include <stickslip/solve/newton.hpp>
#include <stickslip/solve/system.hpp>

namespace stickslip {

/// A converged step.
struct StepReport {
  Index number = 0;  ///< from 1
  Real time = 0;
  Real dt = 0;
  Index iterations = 0;        ///< Newton iterations of this step, those of rejected attempts not counted
  Index rejected = 0;          ///< attempts that were thrown away before it
  Index outer_iterations = 1;  ///< over the step; more than one with multipliers or a bound that is brought up to date
  Index negative_pivots = -1;  ///< of the tangent, its negative eigenvalues; -1 where the solver does not tell
  Real residual = 0;           ///< over the force scale
  ContactSummary contact{};
  /// Part of the friction bounds that the law has not seen yet: their changes, summed over the nodes, over their sum
  /// (theory.md, eq. 5.12); zero for laws that follow the current pressure.
  Real lag = 0;
  Real local_error = 0;  ///< of the time scheme in this step (theory.md, eq. 7.8) [length]; 0 without inertia
  Real work = 0;         ///< done on the body in the step: by deforming it and by friction [energy]
  ErrorEstimates errors{};

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("number", self.number);
    visit("time", self.time);
    visit("dt", self.dt);
    visit("iterations", self.iterations);
    visit("rejected", self.rejected);
    visit("outer_iterations", self.outer_iterations);
    visit("negative_pivots", self.negative_pivots);
    visit("residual", self.residual);
    visit("contact", self.contact);
    visit("lag", self.lag);
    visit("local_error", self.local_error);
    visit("work", self.work);
    visit("errors", self.errors);
  }
};

/// Sums over a run.
struct RunReport {
  Index steps = 0;
  Index iterations = 0;  ///< of accepted and rejected attempts
  Index rejected_steps = 0;
  Index outer_iterations = 0;  ///< of accepted and rejected attempts
  WorkCounts work{};
  Timings timings{};
  Real max_penetration = 0;  ///< [length]
  Real max_slip = 0;         ///< [length]
  Real max_lag = 0;          ///< [-]
  Real total_work = 0;       ///< sum of the magnitudes of the steps' work [energy]
  ErrorEstimates errors{};   ///< the steps' means, weighted with their work

  void add(Real step_work, const ErrorEstimates& step) {
    total_work += step_work;
    if (!(total_work > 0)) return;
    const Real share = step_work / total_work;
    errors.lag += share * (step.lag - errors.lag);
    errors.time += share * (step.time - errors.time);
    errors.penetration += share * (step.penetration - errors.penetration);
    errors.space += share * (step.space - errors.space);
  }

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("steps", self.steps);
    visit("iterations", self.iterations);
    visit("rejected_steps", self.rejected_steps);
    visit("outer_iterations", self.outer_iterations);
    visit("work", self.work);
    visit("timings", self.timings);
    visit("max_penetration", self.max_penetration);
    visit("max_slip", self.max_slip);
    visit("max_lag", self.max_lag);
    visit("total_work", self.total_work);
    visit("errors", self.errors);
  }
};

}  // namespace stickslip
