// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/solve/report.hpp>
#include <stickslip/solve/step_control.hpp>
#include <stickslip/solve/warnings.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// The course of a run, whatever the model: what its next step depends on besides the scene, and what is told of those
/// that were.
class RunState {
 public:
  /// How the run ended, or that it goes well so far.
  const Outcome& outcome() const { return outcome_; }
  const RunReport& report() const { return now_.report; }
  /// What the run should be looked at for, although it goes on.
  const std::vector<Warning>& warnings() const { return now_.warnings.list(); }

 protected:
  struct State {
    StepControl control;
    StepReport step{};
    RunReport report{};
    ForcePredictor predictor{};
    Real last_lag_oscillation = 0;  // of the bounds' lag, over the bounds
    Index oscillation_count = 0;  // how often it has changed its sign and not fallen since it was last small, or probed
    WorkCounts work{};            // that of probes as well, which the report is told with the next step
    Warnings warnings{};
    Real largest_force = 0;  // scale of a converged state
    Real floor = 0;          // force that was left of a converged state, at most
    Index floor_by_gaps = 0;
    Index negative_pivots = 0;  // as last told; a body free of load has none

    void serialize(Archive& archive) {
      control.serialize(archive);
      archive("run, last step", step);
      archive("run, sums", report);
      predictor.serialize(archive);
      archive("run, last lag oscillation", last_lag_oscillation);
      archive("run, lag oscillations", oscillation_count);
      archive("run, work", work);
      warnings.serialize(archive);
      archive("run, largest force", largest_force);
      archive("run, round-off of forces", floor);
      archive("run, round-off of gaps", floor_by_gaps);
      archive("run, negative pivots", negative_pivots);
    }
  };

  RunState(const MarchOptions& options, Real begin)
      : options_(options), now_{.control = StepControl(options, begin)}, before_(now_) {}

  // False at the end of the run.
  bool begin_step(const WorkCounts& work) {
    if (ended_ || now_.control.finished() || !outcome_) {
      ended_ = true;
      return false;
    }
    now_.work = work;
    before_ = now_;
    return true;
  }
  // Counts an attempt at a step.
  void count_attempt(Index outer_iterations, Index iterations, const WorkCounts& work, const Timings& timings) {
    now_.report.outer_iterations += outer_iterations;
    now_.report.iterations += iterations;
    now_.report.work = work;
    now_.report.timings = timings;
  }
  // Whether the bounds' lag oscillates without falling, or does so still at the end of the run.
  bool lag_oscillates(const ContactSummary& contact, Real time) {
    constexpr Real notable = 0.01;
    const Real lag_oscillation =
        contact.friction_capacity > 0 ? contact.lag_oscillation / contact.friction_capacity : 0;
    const bool swung = lag_oscillation * now_.last_lag_oscillation < 0 &&
                       std::abs(lag_oscillation) > std::max(notable, 0.7 * std::abs(now_.last_lag_oscillation));
    // Where steps are cut a bound that has grown wears off over several before it swings up again.
    now_.oscillation_count = swung                                 ? now_.oscillation_count + 1
                             : std::abs(lag_oscillation) > notable ? now_.oscillation_count
                                                                   : 0;
    now_.last_lag_oscillation = lag_oscillation;
    return now_.oscillation_count >= 3 || (time >= options_.end && std::abs(lag_oscillation) > notable);
  }
  // Completes a step that is accepted: estimates its errors (theory.md, section 6.6), watches its negative pivots, lets
  // step control choose the next step and adds it to the report. `first_iterations` are those of the first outer
  // iteration, `error` is that of the time integration over its tolerance, `space` the mesh's error.
  void complete_step(StepReport step, Index first_iterations, Real error, Real space) {
    const ContactSummary& contact = step.contact;
    const auto part = [&](Real work) { return step.work > 0 ? std::abs(work) / step.work : 0; };
    step.lag = contact.friction_capacity > 0 ? contact.lag / contact.friction_capacity : 0;
    step.errors = {.lag = part(contact.lag_work),
                   .time = now_.predictor.error(step.work, step.dt),
                   .penetration = part(contact.penalty_work),
                   .space = space};
    now_.predictor.take(step.work, step.dt);
    watch_pivots(step.negative_pivots);

    Real excess = 0;
    if (options_.lag_tolerance > 0) excess = step.errors.lag / options_.lag_tolerance;
    if (options_.step_tolerance > 0) excess = std::max(excess, step.errors.time / options_.step_tolerance);
    // Slips are to turn by two thirds of what is allowed; a quarter of it says nothing against longer steps.
    if (contact.turn > 0.25) excess = std::max(excess, 1.5 * contact.turn);
    now_.control.accept(step.time, first_iterations, error, excess);

    RunReport& report = now_.report;
    step.number = ++report.steps;
    now_.step = step;
    report.max_penetration = std::max(report.max_penetration, contact.max_penetration);
    report.max_slip = std::max(report.max_slip, contact.max_slip);
    report.max_lag = std::max(report.max_lag, step.lag);
    report.add(step.work, step.errors);
  }
  // Warns of something in the step that is being taken; `subject` says of what, where a scene has several.
  void warn(const std::string& name, const std::string& subject, const std::string& text) {
    now_.warnings.add(name, subject, text, now_.report.steps + 1);
  }
  // Notes what is left of a converged state's forces, `residual` and what the gaps' round-off makes of them, and the
  // largest `scale` so far; whether that is too much in a run that ends with this step (theory.md, eq. 6.4).
  bool digits_lost(Real scale, Real residual, Real of_gaps, bool ends) {
    now_.largest_force = scale;
    if (!(scale > 0)) return false;  // no forces, no digits of them
    const Real left = std::max(residual, of_gaps);
    if (left > now_.floor) {
      now_.floor = left;
      now_.floor_by_gaps = of_gaps > residual ? 1 : 0;
    }
    // Not before the end: the forces of a first touch are small beside those to come. Less than a digit is no matter.
    if (ends && now_.floor > 10 * options_.tolerance * scale) warn("digits_lost", "", digits_left({}));
    return ends && drowned();
  }
  // Whether of some converged state's forces more is left than the tolerance of the largest. Below 1e-7 the tolerance
  // is an aim: sticking a million times stiffer than the body takes as much.
  bool drowned() const {
    return now_.floor > std::max(options_.tolerance, NewtonOptions::promised) * now_.largest_force;
  }
  // In words; `reason` may be empty.
  std::string digits_left(const std::string& reason) const {
    const auto digits = [](Real part) { return brief(std::max(0.0, -std::log10(part)), 2); };
    return digits(now_.floor / now_.largest_force) + " digits of the forces are left, the tolerance asks for " +
           digits(options_.tolerance) + (reason.empty() ? "" : "; " + reason);
  }
  // Watches the number of negative pivots.
  void watch_pivots(Index now) {
    if (now < 0) return;
    if (now != now_.negative_pivots)
      warn("pivots_changed", "",
           "the negative pivots of the tangent went from " + std::to_string(now_.negative_pivots) + " to " +
               std::to_string(now) + ": balance has become unstable or stable, a limit point or a bifurcation lies " +
               "behind (docs/stability.md)");
    now_.negative_pivots = now;
  }
  // Ends the run at the converged time, for the failure of the step that was tried last; `detail` names what of the
  // scene is concerned.
  void fail(const Failure& failure, Real time, Real dt, Index attempts, std::string detail = {}) {
    outcome_ = {.failure = failure,
                .step = now_.report.steps + 1,
                .time = time,
                .tried_step = dt,
                .attempts = attempts,
                .detail = std::move(detail)};
    ended_ = true;
  }
  // The run between two steps; after a failure as it was before the step that failed.
  void serialize(Archive& archive) {
    State state = outcome_ ? now_ : before_;
    state.serialize(archive);
    if (!archive.loading()) return;
    now_ = state;
    outcome_ = {};
    begun_ = ended_ = false;
  }

  MarchOptions options_;
  State now_, before_;  // as it stands, and at the beginning of the last step
  Outcome outcome_{};
  bool begun_ = false;
  bool ended_ = false;
};

}  // namespace stickslip
