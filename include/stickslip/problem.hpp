// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/stress_recovery.hpp>
#include <stickslip/scene.hpp>
#include <stickslip/solve/newton.hpp>
#include <stickslip/solve/report.hpp>
#include <stickslip/solve/step_control.hpp>

#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace stickslip {

template <class Model>
class Problem;

/// A run in progress: an input range of converged steps. Each increment computes one step; the range ends at the end of
/// the run or at a failure, which `outcome()` tells.
template <class Model>
class March {
 public:
  class Iterator {
   public:
    using iterator_concept = std::input_iterator_tag;
    using value_type = StepReport;
    using difference_type = std::ptrdiff_t;
    const StepReport& operator*() const { return march_->now_.step; }
    const StepReport* operator->() const { return &march_->now_.step; }
    Iterator& operator++() {
      march_->advance();
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& it, std::default_sentinel_t) { return it.at_end(); }

   private:
    friend class March;
    explicit Iterator(March* march) : march_(march) {}
    bool at_end() const { return march_->ended_; }
    March* march_;
  };

  Iterator begin() {
    if (!begun_) advance();
    begun_ = true;
    return Iterator(this);
  }
  std::default_sentinel_t end() const { return {}; }

  /// Runs to the end without looking at the steps.
  const Outcome& finish() {
    for ([[maybe_unused]] const StepReport& step : *this) {
    }
    return outcome_;
  }
  /// How the run ended, or that it goes well so far.
  const Outcome& outcome() const { return outcome_; }
  const RunReport& report() const { return now_.report; }

  /// The run and its scene between two steps, for io::save and io::load; after a failure as they were before the step
  /// that failed. What a file gives to a march it continues with at its next step.
  void serialize(Archive& archive);

 private:
  friend class Problem<Model>;
  using Mechanical = MechanicsOf<Model>;
  March(Problem<Model>& problem, const MarchOptions& options);
  // What the steps to come depend on besides the scene, and what is told of those that were.
  struct Course {
    StepControl control;
    StepReport step{};
    RunReport report{};
    ForcePredictor predictor{};
    Real last_swing = 0;  // of the bounds' lag, over the bounds
    Index swings = 0;     // how often it has changed its sign and not fallen since it was last small, or probed
    WorkCounts work{};    // that of probes as well, which the report is told with the next step
  };

  void advance();
  Index pass_again(Field& u, Real time, Real dt, NewtonReport& newton);
  bool feeds_back(const Field& u, Real time, Real dt, const ContactSummary& contact);

  Scene<Mechanical>& problem_;
  MarchOptions options_;
  Course now_, before_;  // as it stands, and at the beginning of the last step
  Newton<SolverOf<Model>, has_near_tangent<Model>()> newton_;
  Outcome outcome_{};
  Field trial_, driven_, pass_start_;
  std::unique_ptr<StressRecovery<typename Scene<Mechanical>::BodyType>> stress_;  // where the mesh's error is asked for
  bool begun_ = false;
  bool ended_ = false;
};

namespace detail {
// Nothing, for a bundle whose mechanics break a rule: the rule's sentence is enough.
template <class Model>
struct SceneOf {
  struct type {};
};
template <class Model>
concept SoundMechanics = rule::HasSymmetry<Model> && rule::LinearSolver<Model> && valid_model<MechanicsOf<Model>>;
template <SoundMechanics Model>
struct SceneOf<Model> {
  using type = Scene<MechanicsOf<Model>>;
};
}  // namespace detail

/// A scene of the bundle `Model` and the means to solve it. The bundle decides what there is (docs/policies.md); the
/// parameters say how much.
template <class Model>
class Problem : public detail::SceneOf<Model>::type {
  static_assert(CheckModel<Model>::ok);

 public:
  using Base = typename detail::SceneOf<Model>::type;
  using Base::Base;

  /// Begins a run from the present state; the problem must outlive it.
  March<Model> march(const MarchOptions& options) {
    options.validate(this->time());
    return March<Model>(*this, options);
  }
};

template <class Model>
March<Model>::March(Problem<Model>& problem, const MarchOptions& options)
    : problem_(problem),
      options_(options),
      now_{.control = StepControl(options, problem.time_)},
      before_(now_),
      newton_(NewtonOptions{.tolerance = options.tolerance,
                            .max_iterations = options.max_iterations,
                            .line_search = options.line_search}) {
  if constexpr (takes_passes<Model>() || has_lag<Model>()) pass_start_ = problem.u_;
  if (options.space_every > 0) stress_ = std::make_unique<typename decltype(stress_)::element_type>(problem.body_);
  if (!problem.system_) {
    if constexpr (has_inertia<Model>)
      problem.system_ = std::make_unique<System<Mechanical>>(problem.body_, problem.pairs_, *problem.inertia_,
                                                             problem.driven_, problem.loads_);
    else
      problem.system_ = std::make_unique<System<Mechanical>>(problem.body_, problem.pairs_, problem.inertia_,
                                                             problem.driven_, problem.loads_);
    problem.reactions_.setZero(problem.u_.size());
    if constexpr (has_contact<Model>)
      if (problem.time_ == 0) {
        for_each_contact(problem.pairs_, [&](auto& pair) {
          if (const Trouble t = pair.start(problem.body_.mesh(), problem.u_, problem.time_))
            throw std::invalid_argument("contact \"" + pair.name() + "\": " +
                                        (t.cause == Cause::not_rigid
                                             ? describe(t.cause)
                                             : "the tool's position or the distance to it is not finite at the start"));
        });
        if (const Trouble t = problem.system_->measure(problem.u_))
          throw std::invalid_argument(std::string("the start is not a state: ") + describe(t.cause));
      }
    if constexpr (has_inertia<Model>)
      if (problem.time_ == 0)
        if (const Trouble t = problem.system_->start(problem.u_, problem.time_))
          throw std::invalid_argument(std::string("the start is not a state: ") + describe(t.cause));
  }
}

/// Passes over a step whose first one has converged, until another one would change nothing beyond the tolerance
/// (theory.md, section 5.8). Their iterations are added to `newton`, but step control looks at those of the first pass.
template <class Model>
Index March<Model>::pass_again([[maybe_unused]] Field& u, [[maybe_unused]] Real time, [[maybe_unused]] Real dt,
                               [[maybe_unused]] NewtonReport& newton) {
  Index passes = 1;
  if constexpr (takes_passes<Model>()) {
    System<Mechanical>& system = *problem_.system_;
    Real before = 0;
    for (Real now = system.unsettled(); now > options_.pass_tolerance; now = system.unsettled()) {
      if (passes == options_.max_passes) {
        newton.trouble = {Cause::passes_failed, {}};
        break;
      }
      // Multipliers settle by a factor that falls with the stiffness, so that no value of it need be asked for.
      if (before > 0 && now > 0.25 * before) system.stiffen(4);
      before = now;
      system.renew();
      pass_start_ = u;
      NewtonReport again = newton_.resume(system, u, time, dt);
      ++passes;
      while (again.trouble && system.hold_back()) {
        newton.iterations += again.iterations;
        u = pass_start_;
        again = newton_.solve(system, u, time, dt);
        ++passes;
      }
      newton.iterations += again.iterations;
      newton.residual = again.residual;
      newton.trouble = again.trouble;
      if (newton.trouble) break;
    }
  }
  return passes;
}

/// Whether a lagging bound feeds back on its own pressure in the converged step (theory.md, eq. 5.31). Asked where the
/// lag has swung to and fro without falling, and at the end of the run; the step is left as it was.
template <class Model>
bool March<Model>::feeds_back(const Field& u, Real time, Real dt, const ContactSummary& contact) {
  if constexpr (has_lag<Model>()) {
    if (!options_.watch_lag || takes_passes<Model>()) return false;
    constexpr Real notable = 0.01;
    const Real swing = contact.bound > 0 ? contact.swing / contact.bound : 0;
    const bool swung =
        swing * now_.last_swing < 0 && std::abs(swing) > std::max(notable, 0.7 * std::abs(now_.last_swing));
    // Where steps are cut a bound that has grown wears off over several before it swings up again.
    now_.swings = swung ? now_.swings + 1 : std::abs(swing) > notable ? now_.swings : 0;
    now_.last_swing = swing;
    if (now_.swings < 3 && !(time >= options_.end && std::abs(swing) > notable)) return false;
    System<Mechanical>& system = *problem_.system_;
    const Real before = system.bound_change();
    bool grows = true;
    // A part of the way, where the whole of it is too far for an iteration that starts at the step's solution.
    for (const Real share : {1.0, 0.25, 0.0625}) {
      system.probe(share);
      pass_start_ = u;
      const NewtonReport probed =
          share == 1 ? newton_.resume(system, pass_start_, time, dt) : newton_.solve(system, pass_start_, time, dt);
      if (probed.trouble) continue;
      grows = system.answer() >= system.stable_below() * share * before;
      break;
    }
    system.begin_passes();
    now_.swings = 0;
    return grows || system.evaluate(u, time, dt);
  }
  return false;
}

template <class Model>
void March<Model>::serialize(Archive& archive) {
  problem_.serialize(archive);
  archive.same("solver", type_name<SolverOf<Model>>());
  newton_.serialize(archive, *problem_.system_);
  now_.work = newton_.counts;
  Course course = outcome_ ? now_ : before_;
  course.control.serialize(archive);
  archive("run, last step", course.step);
  archive("run, sums", course.report);
  course.predictor.serialize(archive);
  archive("run, last swing", course.last_swing);
  archive("run, swings", course.swings);
  archive("run, work", course.work);
  if (!archive.gives()) return;
  now_ = course;
  newton_.counts = now_.work;
  problem_.system_->timings = now_.report.timings;
  outcome_ = {};
  begun_ = ended_ = false;
}

template <class Model>
void March<Model>::advance() {
  if (ended_ || now_.control.finished() || !outcome_) {
    ended_ = true;
    return;
  }
  now_.work = newton_.counts;
  before_ = now_;
  System<Mechanical>& system = *problem_.system_;
  Field& u = trial_;
  Index rejected = 0;
  const auto give_up = [&] {
    ++rejected;
    ++now_.report.rejected_steps;
    if constexpr (takes_passes<Model>() || has_lag<Model>()) system.begin_passes();
  };
  for (;;) {
    const Real time = now_.control.next();
    const Real dt = time - problem_.time_;
    // Guess: the last increment again. For lack of one, with inertia velocity and acceleration, else the tangent at the
    // converged state.
    u = problem_.u_;
    bool extrapolate = problem_.last_dt_ > 0;
    if (extrapolate) {
      const Real h = problem_.last_dt_;
      u += dt / h * problem_.last_increment_;
      // Inertia keeps the path smooth, so its bend is worth half a guess; quasi-static paths have kinks.
      if constexpr (has_inertia<Model>)
        if (const Real before = problem_.increment_before_dt_; before > 0)
          u +=
              0.5 * dt * (dt + h) / (h + before) * (problem_.last_increment_ / h - problem_.increment_before_ / before);
    }
    if constexpr (has_inertia<Model>) {
      problem_.inertia_->begin(problem_.u_, dt);
      if (!extrapolate) problem_.inertia_->predict(u);
      extrapolate = true;
    }
    Trouble trouble = system.impose(time, u);
    NewtonReport newton;
    if (trouble) {
      newton.trouble = trouble;
    } else if (extrapolate) {
      newton = newton_.solve(system, u, time, dt);
    } else {
      driven_ = u - problem_.u_;
      u = problem_.u_;
      newton = newton_.solve(system, u, time, dt, driven_.isZero(0) ? nullptr : &driven_);
    }
    Index passes = 1;
    const Index first_iterations = newton.iterations;
    if constexpr (takes_passes<Model>())
      if (!newton.trouble) passes = pass_again(u, time, dt, newton);
    if constexpr (has_contact<Model>)
      if (!newton.trouble && options_.watch_ways)
        newton.trouble = system.passed_through(problem_.u_, u, problem_.time_, time);
    now_.report.passes += passes;
    now_.report.iterations += newton.iterations;
    now_.report.work = newton_.counts;
    now_.report.timings = system.timings;
    Real local_error = 0, error = 0;
    if constexpr (has_inertia<Model>) {
      if (!newton.trouble) local_error = problem_.inertia_->local_error();
      if (options_.time_tolerance > 0) error = local_error / options_.time_tolerance;
      if (error > 2 && options_.steps == 0) {
        now_.control.reject(time, error);
        if (!now_.control.too_small()) {
          give_up();
          continue;
        }
      }
    }
    if (!newton.trouble) {
      const ContactSummary contact = system.contact_summary();
      const Real lag = contact.bound > 0 ? contact.lag / contact.bound : 0;
      const Real work = std::abs(system.internal().dot(u - problem_.u_)) + contact.dissipated;
      const auto part = [&](Real missed) { return work > 0 ? std::abs(missed) / work : 0; };
      ErrorEstimates errors = {.lag = part(contact.missed),
                               .time = now_.predictor.error(work, dt),
                               .penetration = part(contact.stored),
                               .space = now_.step.errors.space};
      now_.predictor.take(work, dt);
      Cause refusal = Cause::none;
      // Loads in balance with each other hide that nothing holds the body: the solution is one of many.
      if constexpr (!has_inertia<Model>)
        if (problem_.last_dt_ == 0) {
          driven_ = u - problem_.u_;
          if (system.moves_freely(u, &driven_)) refusal = Cause::unsupported;
        }
      if constexpr (has_lag<Model>())
        if (refusal == Cause::none && feeds_back(u, time, dt, contact)) refusal = Cause::lag_feeds_back;
      if (refusal != Cause::none) {
        outcome_ = {.trouble = {refusal, {}},
                    .step = now_.report.steps + 1,
                    .time = problem_.time_,
                    .tried_step = dt,
                    .attempts = rejected + 1};
        ended_ = true;
        return;
      }
      Real excess = 0;
      if (options_.lag_tolerance > 0) excess = errors.lag / options_.lag_tolerance;
      if (options_.step_tolerance > 0) excess = std::max(excess, errors.time / options_.step_tolerance);
      now_.control.accept(time, first_iterations, error, excess);
      system.commit();
      if constexpr (has_inertia<Model>) {
        problem_.increment_before_.swap(problem_.last_increment_);
        problem_.increment_before_dt_ = problem_.last_dt_;
      }
      problem_.last_increment_ = u - problem_.u_;
      problem_.last_dt_ = dt;
      problem_.u_ = u;
      problem_.time_ = time;
      for (Index c = 0; c < system.dofs().components(); ++c) problem_.reactions_[c] = system.reaction(c);
      if (stress_ && now_.report.steps % options_.space_every == 0) {
        const Stopwatch watch(system.timings.estimates);
        stress_->update(problem_.body_, u);
        errors.space = stress_->relative();
      }

      now_.step = {.number = ++now_.report.steps,
                   .time = time,
                   .dt = dt,
                   .iterations = newton.iterations,
                   .rejected = rejected,
                   .passes = passes,
                   .residual = newton.residual,
                   .contact = contact,
                   .lag = lag,
                   .local_error = local_error,
                   .work = work,
                   .errors = errors};
      now_.report.max_penetration = std::max(now_.report.max_penetration, now_.step.contact.max_penetration);
      now_.report.max_slip = std::max(now_.report.max_slip, now_.step.contact.max_slip);
      now_.report.max_lag = std::max(now_.report.max_lag, now_.step.lag);
      now_.report.book(work, errors);
      return;
    }
    give_up();
    now_.control.reject(time);
    if (now_.control.too_small()) {
      if constexpr (!has_inertia<Model>)
        if (!system.evaluate(problem_.u_, problem_.time_, dt) && system.moves_freely(problem_.u_))
          newton.trouble = {Cause::unsupported, {}};
      outcome_ = {.trouble = newton.trouble,
                  .step = now_.report.steps + 1,
                  .time = problem_.time_,
                  .tried_step = dt,
                  .attempts = rejected};
      ended_ = true;
      return;
    }
  }
}

}  // namespace stickslip
