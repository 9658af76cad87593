// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/stress_recovery.hpp>
#include <stickslip/base/brief.hpp>
#include <stickslip/mesh/coincident_nodes.hpp>
#include <stickslip/scene.hpp>
#include <stickslip/solve/course.hpp>
#include <stickslip/solve/energy_books.hpp>
#include <stickslip/solve/newton.hpp>

#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace stickslip {

template <class Model>
class Problem;

/// A run in progress: an input range of converged steps. Each increment computes one step; the range ends at the end of
/// the run or at a failure, which `outcome()` tells.
template <class Model>
class March : public Course {
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

  March(const March&) = delete;
  March& operator=(const March&) = delete;

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
  /// The run and its scene between two steps, for io::save and io::load; after a failure as they were before the step
  /// that failed. What a file gives to a march it continues with at its next step.
  void serialize(Archive& archive);

 private:
  friend class Problem<Model>;
  using Mechanical = MechanicsOf<Model>;
  March(Problem<Model>& problem, const MarchOptions& options);
  struct Attempt {
    NewtonReport newton{};
    Index passes = 1, first_iterations = 0;
  };
  struct Reason {
    Trouble trouble{};
    std::string detail{};
  };
  void advance();
  Attempt attempt(Field& u, Real time, Real dt);
  Reason doubt(const Field& u, const StepReport& step, const NewtonReport& newton);
  Reason explain(Trouble trouble, Real time, Real dt);
  Index pass_again(Field& u, Real time, Real dt, NewtonReport& newton);
  bool feeds_back(const Field& u, Real time, Real dt, const ContactSummary& contact);
  void watch_energy(const StepReport& step);
  void retry(Field& u, Real time, Real dt, NewtonReport& newton) requires has_friction<Model>;

  // Whether Newton's method went astray, at forces that could all be evaluated.
  static bool finds_no_balance(Cause cause) {
    return cause == Cause::singular_matrix || cause == Cause::stalled || cause == Cause::not_converged;
  }
  void require_own() const {
    if (state_ != problem_.revision_)
      throw std::invalid_argument(
          "march: the problem is no longer in the state that this march goes on from: another march has moved it; "
          "begin "
          "a new one");
  }

  Scene<Mechanical>& problem_;
  Index state_;  // revision of the converged state that the next step starts from
  Newton<SolverOf<Model>, has_near_tangent<Model>()> newton_;
  Field trial_, driven_, pass_start_;
  std::unique_ptr<StressRecovery<typename Scene<Mechanical>::BodyType>> stress_;  // where the mesh's error is asked for
  static constexpr bool keeps_books = has_inertia<Model> && TellsEnergies<Mechanical>;
  using Books = std::optional<EnergyBooks<Mechanical, Scene<Mechanical>>>;
  [[no_unique_address]] Only<keeps_books, Books, March> books_;  // to see what the time scheme gains
  [[no_unique_address]] Only<keeps_books, std::string, Books> gained_;
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
    : Course(options, problem.time_),
      problem_(problem),
      state_(problem.revision_),
      newton_(NewtonOptions{.tolerance = options.tolerance,
                            .max_iterations = options.max_iterations,
                            .line_search = options.line_search}) {
  if constexpr (takes_passes<Model>() || has_lag<Model>()) pass_start_ = problem.u_;
  if (options.space_every > 0) stress_ = std::make_unique<typename decltype(stress_)::element_type>(problem.body_);
  problem_.prepare();
  if (const auto apart = mesh::coincident_nodes(problem_.body_.mesh()); apart.nodes > 0)
    now_.warnings.add("coincident_nodes", "",
                      std::to_string(apart.nodes) + " nodes of the mesh lie where another one does, nodes " +
                          std::to_string(apart.first[0]) + " and " + std::to_string(apart.first[1]) +
                          " (from 0) among them: what was meshed in blocks that were not joined comes apart there",
                      0);
  problem_.require_agreement(options.end);
  if constexpr (has_contact<Model>)
    problem_.visit_contacts([&](const auto& pair) {
      if (const std::string text = pair.warning_of_size(); !text.empty())
        now_.warnings.add("tool_smaller_than_mesh", pair.name(), text, 0);
    });
  if constexpr (keeps_books)
    if (options.energy_gain > 0) books_.emplace(problem_);
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
    const auto unsettled = [&] { return system.unsettled(problem_.u_, u, problem_.time_, time); };
    for (Real now = unsettled(); now > options_.pass_tolerance; now = unsettled()) {
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
      newton.negative_pivots = again.negative_pivots >= 0 ? again.negative_pivots : newton.negative_pivots;
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
    if (!swings(contact, time)) return false;
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
    system.end_probe();
    now_.swings = 0;
    return grows || system.evaluate(u, time, dt);
  }
  return false;
}

/// Tries a step again that has not converged, from the converged state, before it is cut: nodes that lose their
/// pressure on the way stick at first, and all do where friction alone holds the body, which nothing does at an iterate
/// at which they slide (theory.md, section 6.4).
template <class Model>
void March<Model>::retry(Field& u, Real time, Real dt, NewtonReport& newton) requires has_friction<Model> {
  if (!finds_no_balance(newton.trouble.cause)) return;
  System<Mechanical>& system = *problem_.system_;
  if (!system.blame(problem_.u_, false, 1e13).empty())
    return;  // what fails for lack of digits is not to be talked round
  u = problem_.u_;
  NewtonReport again{.trouble = system.impose(time, u)};
  const bool sticking = system.held_by_friction(problem_.u_, problem_.time_);
  system.begin_retry(sticking);
  newton_.judge_anew();
  if (!again.trouble) again = newton_.resume(system, u, time, dt);
  again.iterations += newton.iterations;
  newton = again;
}

/// Warns where the time scheme has gained energy (theory.md, eq. 7.16).
template <class Model>
void March<Model>::watch_energy([[maybe_unused]] const StepReport& step) {
  if constexpr (keeps_books) {
    if (!books_) return;
    books_->update(step);
    const Real gain = books_->gain();
    if (!(gain > options_.energy_gain)) return;
    gained_ = "the time scheme has gained " + brief(gain, 2) +
              " of the largest of the work done and the energy at the start; take smaller steps, or a spectral radius "
              "below 1";
    warn("energy_gained", "", gained_);
  }
}

template <class Model>
void March<Model>::serialize(Archive& archive) {
  problem_.prepare();
  problem_.serialize(archive);
  if (archive.gives()) state_ = problem_.revision_;
  archive.same("solver", type_name<SolverOf<Model>>());
  newton_.serialize(archive, *problem_.system_);
  now_.work = newton_.counts;
  Course::serialize(archive);
  if constexpr (keeps_books)
    if (books_) {
      books_->serialize(archive, "run, books");
      if (archive.gives()) gained_.clear();
    }
  if (!archive.gives()) return;
  newton_.counts = now_.work;
  problem_.system_->timings = now_.report.timings;
}

/// Solves for the step that ends at `time`, and looks whether its way and its friction can be what they seem.
template <class Model>
typename March<Model>::Attempt March<Model>::attempt(Field& u, Real time, Real dt) {
  System<Mechanical>& system = *problem_.system_;
  Attempt a;
  NewtonReport& newton = a.newton;
  newton_.known_scale = now_.largest_force;
  const bool guessed = problem_.guess(dt, u);
  newton.trouble = system.impose(time, u);
  if constexpr (has_friction<Model>)
    if (!newton.trouble) newton.trouble = system.set_out(problem_.u_, problem_.time_, time);
  if (newton.trouble) return a;
  if (guessed) {
    newton = newton_.solve(system, u, time, dt);
  } else {
    driven_ = u - problem_.u_;
    u = problem_.u_;
    newton = newton_.solve(system, u, time, dt, driven_.isZero(0) ? nullptr : &driven_);
  }
  if constexpr (has_friction<Model> && !has_inertia<Model>)
    if (newton.trouble) retry(u, time, dt, newton);
  if constexpr (has_friction<Model>)
    if (!newton.trouble && system.must_follow(problem_.u_, u)) {
      const Index unfollowed = newton.iterations;
      newton = newton_.resume(system, u, time, dt);
      newton.iterations += unfollowed;
    }
  a.first_iterations = newton.iterations;
  if constexpr (has_lag<Model>() && !takes_passes<Model>())
    if (!newton.trouble && system.see_first_contacts()) {
      pass_start_ = u;
      const NewtonReport first = newton;
      newton = newton_.resume(system, u, time, dt);
      newton.iterations += first.iterations;
      ++a.passes;
      if (newton.trouble && newton.trouble.cause != Cause::not_converged) {  // no balance with these bounds
        system.begin_passes();
        u = pass_start_;
        const Index lost = newton.iterations;
        newton = newton_.solve(system, u, time, dt);
        newton.iterations += lost;
      }
    }
  if constexpr (takes_passes<Model>())
    if (!newton.trouble) a.passes = pass_again(u, time, dt, newton);
  if constexpr (has_friction<Model>)
    if (!newton.trouble) newton.trouble = system.slide_turned();
  if constexpr (has_contact<Model>)
    if (!newton.trouble && options_.watch_ways)
      newton.trouble = system.passed_through(problem_.u_, u, problem_.time_, time);
  return a;
}

/// Whether a step that has converged is no answer; then why.
template <class Model>
typename March<Model>::Reason March<Model>::doubt(const Field& u, const StepReport& step, const NewtonReport& newton) {
  System<Mechanical>& system = *problem_.system_;
  // Loads in balance with each other hide that nothing holds the body: the solution is one of many.
  if constexpr (!has_inertia<Model>) {
    driven_ = u - problem_.u_;
    if (!problem_.proven_ || driven_.lpNorm<Eigen::Infinity>() > system.extent() || system.loose_part(false) >= 0)
      if (const Index part = system.free_part(u, &driven_); part >= 0)
        return {{Cause::unsupported, {}}, system.part_name(part)};
  }
  if constexpr (has_lag<Model>())
    if (feeds_back(u, step.time, step.dt, step.contact)) return {{Cause::lag_feeds_back, {}}, {}};
  const Real scale = std::max(system.force_scale(), now_.largest_force);
  const Real left = newton.residual > 0 ? system.residual_norm() : 0;  // not of a body that only moves
  if (digits_lost(scale, left, system.blurred(), step.time >= options_.end)) {
    const bool by_gaps = now_.floor_by_gaps != 0;
    return {{Cause::digits_lost, {}}, digits_left(system.blame(u, by_gaps, by_gaps ? 1e8 : 1e3))};
  }
  return {};
}

/// The reason why no step is small enough, by name where the scene tells it. Spoils the last evaluation.
template <class Model>
typename March<Model>::Reason March<Model>::explain(Trouble trouble, Real time, [[maybe_unused]] Real dt) {
  System<Mechanical>& system = *problem_.system_;
  if (trouble.cause == Cause::contradicting_supports) return {trouble, system.contradiction(time)};
  [[maybe_unused]] std::string sliding;
  if constexpr (has_friction<Model>) {
    if (trouble.cause == Cause::slide_turns) return {trouble, system.turned_too_far()};
    sliding = system.sliding_contacts();
  }
  if constexpr (!has_inertia<Model>) {
    if (!system.evaluate(problem_.u_, problem_.time_, dt))
      if (const Index part = system.free_part(problem_.u_); part >= 0)
        return {{Cause::unsupported, {}}, system.part_name(part)};
    if constexpr (has_friction<Model>)
      if (finds_no_balance(trouble.cause) && system.held_by_friction(problem_.u_, problem_.time_))
        return {{Cause::slides, {}}, sliding.empty() ? system.sliding_contacts() : sliding};
  }
  if (finds_no_balance(trouble.cause) || trouble.cause == Cause::element_inverted) {
    const bool singular = trouble.cause == Cause::singular_matrix;
    const std::string blamed = system.blame(problem_.u_, false, singular ? 1e8 : drowned() ? 1e3 : 1e13);
    if (drowned()) return {{Cause::digits_lost, {}}, digits_left(blamed)};
    if (!blamed.empty()) return {{Cause::digits_lost, {}}, blamed};
  }
  return {trouble, {}};
}

template <class Model>
void March<Model>::advance() {
  if constexpr (keeps_books)
    if (options_.refuse_energy_gain && outcome_ && !gained_.empty()) {
      before_ = now_;
      return fail({Cause::energy_gained, {}}, problem_.time_, now_.step.dt, 0, gained_);
    }
  if (!begin_step(newton_.counts)) return;
  require_own();
  problem_.prepare();  // supports and loads may have changed since the last step
  System<Mechanical>& system = *problem_.system_;
  Field& u = trial_;
  Index rejected = 0;
  const auto end = [&](Reason reason, Real dt, Index attempts) {
    if constexpr (takes_passes<Model>() || has_lag<Model>()) system.begin_passes();
    fail(reason.trouble, problem_.time_, dt, attempts, std::move(reason.detail));
  };
  if constexpr (!has_inertia<Model>)
    if (!problem_.proven_)
      if (const Index part = system.loose_part(true); part >= 0)
        return end({{Cause::unsupported, {}}, system.part_name(part)}, now_.control.next() - problem_.time_, 0);
  for (;;) {
    const Real time = now_.control.next();
    const Real dt = time - problem_.time_;
    const Attempt tried = attempt(u, time, dt);
    const NewtonReport& newton = tried.newton;
    tally(tried.passes, newton.iterations, newton_.counts, system.timings);
    Real local_error = 0, error = 0;
    bool too_coarse = false;
    if constexpr (has_inertia<Model>) {
      if (!newton.trouble) local_error = system.local_error();
      if (options_.time_tolerance > 0) error = local_error / options_.time_tolerance;
      if (error > 2 && options_.steps == 0) {
        now_.control.reject(time, error);
        too_coarse = !now_.control.too_small();
      }
    }
    if (!newton.trouble && !too_coarse) {
      const ContactSummary contact = system.contact_summary();
      StepReport step{.time = time,
                      .dt = dt,
                      .iterations = newton.iterations,
                      .rejected = rejected,
                      .passes = tried.passes,
                      .negative_pivots = newton.negative_pivots,
                      .residual = newton.residual,
                      .contact = contact,
                      .local_error = local_error,
                      .work = std::abs(system.internal().dot(u - problem_.u_)) + contact.dissipated};
      estimate(step);
      if (Reason reason = doubt(u, step, newton); reason.trouble) return end(std::move(reason), dt, rejected + 1);
      if constexpr (decltype(newton_)::tells_pivots)
        if (newton.iterations == 0) step.negative_pivots = now_.negative_pivots;
      watch_pivots(step.negative_pivots);
      accept(step, tried.first_iterations, error);
      problem_.accept(u, time, dt);
      state_ = problem_.revision_;
      if (stress_ && now_.report.steps % options_.space_every == 0) {
        const Stopwatch watch(system.timings.estimates);
        stress_->update(problem_.body_, u);
        step.errors.space = stress_->relative();
      }
      watch_energy(step);
      return book(step);
    }
    ++rejected;
    ++now_.report.rejected_steps;
    if constexpr (takes_passes<Model>() || has_lag<Model>()) system.begin_passes();
    if (too_coarse) continue;
    now_.control.reject(time);
    if (now_.control.too_small()) return end(explain(newton.trouble, time, dt), dt, rejected);
  }
}

}  // namespace stickslip
