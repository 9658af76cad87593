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

/// The course of a run, whatever the bundle: what its next step depends on besides the scene, and what is told of those
/// that were.
class Course {
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
    Real last_swing = 0;  // of the bounds' lag, over the bounds
    Index swings = 0;     // how often it has changed its sign and not fallen since it was last small, or probed
    WorkCounts work{};    // that of probes as well, which the report is told with the next step
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
      archive("run, last swing", last_swing);
      archive("run, swings", swings);
      archive("run, work", work);
      warnings.serialize(archive);
      archive("run, largest force", largest_force);
      archive("run, round-off of forces", floor);
      archive("run, round-off of gaps", floor_by_gaps);
      archive("run, negative pivots", negative_pivots);
    }
  };

  Course(const MarchOptions& options, Real begin)
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
  // Books an attempt at a step.
  void tally(Index passes, Index iterations, const WorkCounts& work, const Timings& timings) {
    now_.report.passes += passes;
    now_.report.iterations += iterations;
    now_.report.work = work;
    now_.report.timings = timings;
  }
  // Estimates the errors of a step that has converged (theory.md, section 6.6).
  void estimate(StepReport& step) {
    const ContactSummary& contact = step.contact;
    const auto part = [&](Real missed) { return step.work > 0 ? std::abs(missed) / step.work : 0; };
    step.lag = contact.bound > 0 ? contact.lag / contact.bound : 0;
    step.errors = {.lag = part(contact.missed),
                   .time = now_.predictor.error(step.work, step.dt),
                   .penetration = part(contact.stored),
                   .space = now_.step.errors.space};
    now_.predictor.take(step.work, step.dt);
  }
  // Whether the bounds' lag has swung to and fro without falling, or does so still at the end of the run.
  bool swings(const ContactSummary& contact, Real time) {
    constexpr Real notable = 0.01;
    const Real swing = contact.bound > 0 ? contact.swing / contact.bound : 0;
    const bool swung =
        swing * now_.last_swing < 0 && std::abs(swing) > std::max(notable, 0.7 * std::abs(now_.last_swing));
    // Where steps are cut a bound that has grown wears off over several before it swings up again.
    now_.swings = swung ? now_.swings + 1 : std::abs(swing) > notable ? now_.swings : 0;
    now_.last_swing = swing;
    return now_.swings >= 3 || (time >= options_.end && std::abs(swing) > notable);
  }
  // Lets step control choose the next step; `first_iterations` are those of the first pass, `error` is that of
  // inertia's time scheme over its tolerance.
  void accept(const StepReport& step, Index first_iterations, Real error) {
    Real excess = 0;
    if (options_.lag_tolerance > 0) excess = step.errors.lag / options_.lag_tolerance;
    if (options_.step_tolerance > 0) excess = std::max(excess, step.errors.time / options_.step_tolerance);
    // Slides are to turn by two thirds of what is allowed; a quarter of it says nothing against longer steps.
    if (step.contact.turn > 0.25) excess = std::max(excess, 1.5 * step.contact.turn);
    now_.control.accept(step.time, first_iterations, error, excess);
  }
  // Books a step that is done.
  void book(const StepReport& step) {
    RunReport& report = now_.report;
    now_.step = step;
    now_.step.number = ++report.steps;
    report.max_penetration = std::max(report.max_penetration, step.contact.max_penetration);
    report.max_slip = std::max(report.max_slip, step.contact.max_slip);
    report.max_lag = std::max(report.max_lag, step.lag);
    report.book(step.work, step.errors);
  }
  // Warns of something in the step that is being taken; `subject` says of what, where a scene has several.
  void warn(const std::string& name, const std::string& subject, const std::string& text) {
    now_.warnings.add(name, subject, text, now_.report.steps + 1);
  }
  // Books what is left of a converged state's forces, `residual` and what the gaps' round-off makes of them, and the
  // largest `scale` so far; whether that is too much in a run that ends with this step (theory.md, eq. 6.2b).
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
  // Ends the run at the converged time, for the trouble of the step that was tried last; `detail` names what of the
  // scene is concerned.
  void fail(const Trouble& trouble, Real time, Real dt, Index attempts, std::string detail = {}) {
    outcome_ = {.trouble = trouble,
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
    if (!archive.gives()) return;
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
