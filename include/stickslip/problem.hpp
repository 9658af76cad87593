// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/body/stress_recovery.hpp>
#include <stickslip/body/thin_cells.hpp>
#include <stickslip/body/varied_strain.hpp>
#include <stickslip/mesh/coincident_nodes.hpp>
#include <stickslip/scene.hpp>
#include <stickslip/solve/energy_gain.hpp>
#include <stickslip/solve/newton.hpp>
#include <stickslip/solve/outer_iteration.hpp>
#include <stickslip/solve/run_state.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace stickslip {

template <class Model>
class Problem;

/// A run in progress: an input range of converged steps. Each increment computes one step; the range ends at the end of
/// the run or at a failure, which `outcome()` tells.
template <class Model>
class March : public RunState {
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
  using Iterate = typename System<Mechanical>::Iterate;
  March(Problem<Model>& problem, const MarchOptions& options, const SolverParametersOf<Model>& solver);
  struct Attempt {
    NewtonReport newton{};
    Index outer_iterations = 1, first_iterations = 0;
  };
  struct Reason {
    Failure failure{};
    std::string detail{};
  };
  void advance();
  Attempt attempt(Iterate& iterate, Field& u, Real time, Real dt, bool extrapolated, Failure unsound);
  Reason doubt(Iterate& iterate, Field& u, const StepReport& step, const NewtonReport& newton);
  Reason explain(Failure failure, Real time, Real dt);
  Index iterate_outer(Iterate& iterate, Field& u, Real time, Real dt, NewtonReport& newton);
  bool lag_is_unstable(Iterate& iterate, Field& u, Real time, Real dt, const ContactSummary& contact);
  void watch_energy(const StepReport& step);
  void watch_bending(const Field& u);
  void retry(Iterate& iterate, Field& u, Real time, Real dt, NewtonReport& newton) requires has_friction<Model>;

  // Whether Newton's method went astray, at forces that could all be evaluated.
  static bool finds_no_balance(FailureCause cause) {
    return cause == FailureCause::singular_matrix || cause == FailureCause::stalled ||
           cause == FailureCause::not_converged;
  }
  // Whether a step along a solution without digits may have ended so.
  static bool may_be_roundoff(FailureCause cause) {
    return finds_no_balance(cause) || cause == FailureCause::element_inverted || cause == FailureCause::not_finite ||
           cause == FailureCause::material_failed || cause == FailureCause::friction_failed ||
           cause == FailureCause::tunnelled;
  }
  // Whether what is not finite is so at the converged displacements already, with tools, supports and loads at `time`.
  bool fails_without_iterating(FailureCause cause, Real time, Real dt) {
    if (cause != FailureCause::not_finite) return false;
    trial_ = problem_.u_;
    return problem_.system_->prescribed().apply_constraints(time, trial_) ||
           problem_.system_->evaluate(problem_.u_, time, dt).cause == cause;
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
  Newton<SolverOf<Model>, has_inexact_tangent<Model>(), typename System<Mechanical>::Space> newton_;
  Field trial_, driven_, outer_guess_;
  std::unique_ptr<StressRecoveries<Bodies<Mechanical>>> stress_;  // where the mesh's error is asked for
  static constexpr bool watches_bending = !std::is_empty_v<ThinCellsOf<Mechanical>>;
  [[no_unique_address]] ThinCellsOf<Mechanical> thin_;
  static constexpr const char* thin_cells_bend = "thin_cells_bend";
  static constexpr bool watches_strain = !std::is_empty_v<VariedStrainOf<Mechanical>>;
  [[no_unique_address]] VariedStrainOf<Mechanical> varied_;
  static constexpr const char* varied_strain = "varied_strain";
  static constexpr bool keeps_energy = has_inertia<Model> && TellsEnergies<Mechanical>;
  using Gain = std::optional<EnergyGain<Mechanical, Scene<Mechanical>>>;
  [[no_unique_address]] StoredIf<keeps_energy, Gain, March> gain_;  // to see what the time scheme gains
  [[no_unique_address]] StoredIf<keeps_energy, std::string, Gain> gained_;
};

namespace detail {
// Nothing, for a model whose mechanics break a rule: the rule's sentence is enough.
template <class Model>
struct SceneOf {
  struct type {};
  using Solver = NoSolverParameters;
};
template <class Model>
concept SoundMechanics = rule::HasSymmetry<Model> && rule::LinearSolver<Model> && valid_model<MechanicsOf<Model>>;
template <SoundMechanics Model>
struct SceneOf<Model> {
  using type = Scene<MechanicsOf<Model>>;
  using Solver = SolverParametersOf<Model>;
};
}  // namespace detail

/// A scene of the model `Model` and the means to solve it. The model decides what there is (docs/policies.md); the
/// parameters say how much.
template <class Model>
class Problem : public detail::SceneOf<Model>::type {
  static_assert(CheckModel<Model>::ok);

 public:
  using Base = typename detail::SceneOf<Model>::type;
  using Base::Base;

  /// Begins a run from the present state; the problem must outlive it. Throws std::invalid_argument for options or
  /// parameters of the solver that cannot be taken.
  March<Model> march(const MarchOptions& options, const typename detail::SceneOf<Model>::Solver& solver = {}) {
    options.validate(this->time());
    return March<Model>(*this, options, solver);
  }
};

template <class Model>
[[gnu::cold]] March<Model>::March(Problem<Model>& problem, const MarchOptions& options,
                                  const SolverParametersOf<Model>& solver)
    : RunState(options, problem.time_),
      problem_(problem),
      state_(problem.revision_),
      newton_(NewtonOptions{.tolerance = options.tolerance,
                            .max_iterations = options.max_iterations,
                            .line_search = options.line_search},
              solver) {
  if constexpr (has_outer_iterations<Model>() || has_lag<Model>()) outer_guess_ = problem.u_;
  if constexpr (watches_bending)
    problem.bodies_.for_each([&](const auto& body) {
      using Element = typename std::remove_cvref_t<decltype(body)>::Element;
      if constexpr (locks_in_bending<Element> &&
                    std::same_as<ThinCells<typename Element::Cell>, ThinCellsOf<Mechanical>>)
        thin_.add_mesh(body.mesh(), body.first_node(), body.first_cell());
    });
  if constexpr (watches_strain)
    problem.bodies_.for_each([&](const auto& body) {
      using Element = typename std::remove_cvref_t<decltype(body)>::Element;
      if constexpr (locks_in_varied_strain<Element> &&
                    std::same_as<VariedStrain<typename Element::Cell>, VariedStrainOf<Mechanical>>)
        varied_.add_mesh(body.mesh(), body.first_node(), body.first_cell());
    });
  if (options.mesh_error_interval > 0)
    stress_ = std::make_unique<StressRecoveries<Bodies<Mechanical>>>(problem.bodies_);
  problem_.prepare();
  problem_.bodies_.for_each([&](const auto& body) {
    if (const auto apart = mesh::coincident_nodes(body.mesh()); apart.nodes > 0)
      now_.warnings.add("coincident_nodes", body.name(), mesh::in_words(apart, body.name()), 0);
  });
  problem_.require_agreement(problem_.system_->prescribed(), options.end);
  if constexpr (has_contact<Model>)
    problem_.visit_contacts([&](const auto& pair) {
      if (const std::string text = pair.warning_of_size(); !text.empty())
        now_.warnings.add("tool_smaller_than_mesh", pair.name(), text, 0);
    });
  if constexpr (keeps_energy)
    if (options.energy_gain > 0) gain_.emplace(problem_);
}

/// Outer iterations over a step whose first one has converged, until another one would change nothing beyond the
/// tolerance (theory.md, section 5.8). Their iterations are added to `newton`, but step control looks at the first's.
template <class Model>
Index March<Model>::iterate_outer([[maybe_unused]] Iterate& iterate, [[maybe_unused]] Field& u,
                                  [[maybe_unused]] Real time, [[maybe_unused]] Real dt,
                                  [[maybe_unused]] NewtonReport& newton) {
  Index outer_iterations = 1;
  if constexpr (has_outer_iterations<Model>()) {
    OuterIteration outer(problem_.pairs_);
    const auto residual = [&] {
      return outer.residual([&](const auto& pair) {
        return has_inertia<Model> && is_augmented<typename Model::Enforcement>
                   ? pair.largest_motion(problem_.u_, u, problem_.time_, time)
                   : std::numeric_limits<Real>::infinity();
      });
    };
    for (Real now = residual(); now > options_.outer_tolerance; now = residual()) {
      if (outer_iterations == options_.max_outer) {
        newton.failure = {FailureCause::outer_failed, {}};
        break;
      }
      outer.next(now);
      outer_guess_ = u;
      NewtonReport again = newton_.solve(iterate, u, time, dt);
      ++outer_iterations;
      while (again.failure && outer.backtrack()) {
        newton.iterations += again.iterations;
        u = outer_guess_;
        iterate.restart();
        newton_.judge_anew();
        again = newton_.solve(iterate, u, time, dt);
        ++outer_iterations;
      }
      newton.iterations += again.iterations;
      newton.residual = again.residual;
      newton.negative_pivots = again.negative_pivots >= 0 ? again.negative_pivots : newton.negative_pivots;
      newton.failure = again.failure;
      if (newton.failure) break;
    }
  }
  return outer_iterations;
}

/// Whether a lagging bound feeds back on its own pressure in the converged step (theory.md, eq. 5.16). Asked where the
/// lag oscillates without falling, and at the end of the run; the step is left as it was.
template <class Model>
bool March<Model>::lag_is_unstable(Iterate& iterate, Field& u, Real time, Real dt, const ContactSummary& contact) {
  if constexpr (has_lag<Model>()) {
    if (!options_.detect_lag_instability || has_outer_iterations<Model>()) return false;
    if (!lag_oscillates(contact, time)) return false;
    // Back at the step's solution, stiff contact has the digits of its pressures from an iterate, not from the gaps.
    const bool stiff = problem_.system_->closes_stiff_contact();
    bool grows = true;
    {
      LagProbe probe(problem_.pairs_);
      // A part of the way, where the whole of it is too far for an iteration that starts at the step's solution.
      for (const Real part : {1.0, 0.25, 0.0625}) {
        probe.perturb_bound(part);
        outer_guess_ = u;
        if (part < 1) {
          iterate.restart();
          newton_.judge_anew();
        }
        if (newton_.solve(iterate, outer_guess_, time, dt).failure) continue;
        grows = probe.pressure_response() >= probe.critical_feedback() * part * probe.lag();
        break;
      }
    }
    now_.oscillation_count = 0;
    if (grows) return true;
    return bool(stiff ? newton_.solve(iterate, u, time, dt).failure : problem_.system_->evaluate(u, time, dt));
  }
  return false;
}

/// Tries a step again that has not converged, from the converged state, before it is cut: nodes that lose their
/// pressure on the way stick at first, and all do where friction alone holds the body, which nothing does at an iterate
/// at which they slide (theory.md, section 6.4).
template <class Model>
void March<Model>::retry(Iterate& iterate, Field& u, Real time, Real dt,
                         NewtonReport& newton) requires has_friction<Model> {
  if (!finds_no_balance(newton.failure.cause)) return;
  if (!problem_.diagnosis_->roundoff_source(problem_.u_, false, 1e13).empty())
    return;  // what fails for lack of digits is not to be talked round
  u = problem_.u_;
  NewtonReport again{.failure = problem_.system_->prescribed().apply_constraints(time, u)};
  iterate.retry(problem_.diagnosis_->held_by_friction(problem_.u_, problem_.time_));
  newton_.judge_anew();
  if (!again.failure) again = newton_.solve(iterate, u, time, dt);
  again.iterations += newton.iterations;
  newton = again;
}

/// Warns once of a thin cell that bends although its element locks in bending, and of a cell whose strain varies more
/// than its element can bear. Looks for the former at every eighth step.
template <class Model>
void March<Model>::watch_bending([[maybe_unused]] const Field& u) {
  if constexpr (watches_strain)
    if (!varied_.told) {
      const std::string text = varied_.lost(u);
      varied_.told = !text.empty();
      if (varied_.told) warn(varied_strain, "", text);
    }
  if constexpr (watches_bending) {
    if (thin_.told || thin_.none() || now_.report.steps % 8 != 0) return;
    const std::string text = thin_.bending(u);
    thin_.told = !text.empty();
    if (thin_.told) warn(thin_cells_bend, "", text);
  }
}

/// Warns where the time scheme has gained energy (theory.md, eq. 7.17).
template <class Model>
void March<Model>::watch_energy([[maybe_unused]] const StepReport& step) {
  if constexpr (keeps_energy) {
    if (!gain_) return;
    gain_->update(step);
    const Real gain = gain_->gain();
    if (!(gain > options_.energy_gain)) return;
    gained_ = joined({"the time scheme has gained ", brief(gain, 2),
                      " of the largest of the work done and the energy at the start; take smaller steps, or a spectral "
                      "radius below 1"});
    warn("energy_gained", "", gained_);
  }
}

template <class Model>
[[gnu::cold]] void March<Model>::serialize(Archive& archive) {
  problem_.prepare();
  problem_.serialize(archive);
  if (archive.loading()) state_ = problem_.revision_;
  archive.check_equal("solver", type_name<SolverOf<Model>>());
  newton_.serialize(archive, *problem_.system_);
  now_.work = newton_.counts;
  RunState::serialize(archive);
  if constexpr (keeps_energy)
    if (gain_) {
      gain_->serialize(archive, "run, energy balance");
      if (archive.loading()) gained_.clear();
    }
  if (!archive.loading()) return;
  [[maybe_unused]] const auto told = [this](const char* name) {
    const auto& list = now_.warnings.list();
    return std::any_of(list.begin(), list.end(), [&](const Warning& w) { return w.name == name; });
  };
  if constexpr (watches_bending) thin_.told = told(thin_cells_bend);
  if constexpr (watches_strain) varied_.told = told(varied_strain);
  newton_.counts = now_.work;
  problem_.system_->timings = now_.report.timings;
}

/// Solves for the step that ends at `time` from the guess u, and checks its path and its friction.
template <class Model>
typename March<Model>::Attempt March<Model>::attempt(Iterate& iterate, Field& u, Real time, Real dt, bool extrapolated,
                                                     Failure unsound) {
  System<Mechanical>& system = *problem_.system_;
  Attempt a;
  NewtonReport& newton = a.newton;
  newton_.known_scale = now_.largest_force;
  newton_.judge_anew();
  newton.failure = unsound;
  if (!newton.failure) {
    const Stopwatch watch(system.timings.contact);
    newton.failure =
        first_failure(problem_.pairs_, [&](auto& pair) { return pair.begin_step(problem_.u_, problem_.time_, time); });
  }
  if (newton.failure) return a;
  if (extrapolated) {
    if (problem_.last_dt_ > 0) iterate.extrapolate(dt / problem_.last_dt_);
    newton = newton_.solve(iterate, u, time, dt);
  } else {
    driven_ = u - problem_.u_;
    u = problem_.u_;
    newton = newton_.solve(iterate, u, time, dt, system.space().max(driven_) == 0 ? nullptr : &driven_);
  }
  if constexpr (has_friction<Model> && !has_inertia<Model>)
    if (newton.failure) retry(iterate, u, time, dt, newton);
  if constexpr (Model::Kinematics::dim == 3) {
    bool must = false;
    if (!newton.failure)
      for_each_friction(problem_.pairs_, [&](auto& pair) { must = pair.must_follow(problem_.u_, u) || must; });
    if (must) {
      const Index unfollowed = newton.iterations;
      newton = newton_.solve(iterate, u, time, dt);
      newton.iterations += unfollowed;
    }
  }
  a.first_iterations = newton.iterations;
  if (!newton.failure) a.outer_iterations = iterate_outer(iterate, u, time, dt, newton);
  if (!newton.failure) newton.failure = first_failure(problem_.pairs_, [](auto& pair) { return pair.slip_turned(); });
  if (!newton.failure && options_.detect_tunnelling)
    for_each_contact(problem_.pairs_, [&](auto& pair) {
      if (!newton.failure) newton.failure = pair.check_tunnelling(problem_.u_, u, problem_.time_, time);
    });
  return a;
}

/// Whether a step that has converged is no answer; then why.
template <class Model>
typename March<Model>::Reason March<Model>::doubt(Iterate& iterate, Field& u, const StepReport& step,
                                                  const NewtonReport& newton) {
  System<Mechanical>& system = *problem_.system_;
  Diagnosis<Mechanical>& diagnosis = *problem_.diagnosis_;
  // Of the solution, for the next evaluations may be of other states.
  const Real scale = std::max(system.forces().scale(system.space()), now_.largest_force);
  const Real left = newton.residual > 0 ? system.forces().norm : 0;  // not of a body that only moves
  // Loads in balance with each other hide that nothing holds the body: the solution is one of many.
  if constexpr (!has_inertia<Model>) {
    driven_ = u - problem_.u_;
    if (!problem_.proven_ || system.space().max(driven_) > system.bodies().extent() ||
        diagnosis.loose_part(false) >= 0) {
      if (!system.tangent().current) {
        ++newton_.counts.evaluations;
        ++newton_.counts.evaluations_repeated;
        if (const Failure f = iterate.add_tangent(u, step.time, step.dt)) return {f, {}};
      }
      if (const Index part = diagnosis.free_part(u, &driven_); part >= 0)
        return {{FailureCause::unsupported, {}}, diagnosis.part_name(part)};
    }
  }
  if (lag_is_unstable(iterate, u, step.time, step.dt, step.contact)) return {{FailureCause::lag_unstable, {}}, {}};
  if (digits_lost(scale, left, diagnosis.gap_roundoff(), step.time >= options_.end)) {
    const bool by_gaps = now_.floor_by_gaps != 0;
    return {{FailureCause::digits_lost, {}}, digits_left(diagnosis.roundoff_source(u, by_gaps, by_gaps ? 1e8 : 1e3))};
  }
  return {};
}

/// The reason why no step is small enough, by name where the scene tells it. Spoils the last evaluation.
template <class Model>
[[gnu::cold]] typename March<Model>::Reason March<Model>::explain(Failure failure, Real time,
                                                                  [[maybe_unused]] Real dt) {
  System<Mechanical>& system = *problem_.system_;
  Diagnosis<Mechanical>& diagnosis = *problem_.diagnosis_;
  if (failure.cause == FailureCause::contradicting_supports) return {failure, system.prescribed().contradiction(time)};
  if (failure.cause == FailureCause::slide_turns) return {failure, turning_contacts(problem_.pairs_)};
  if constexpr (!has_inertia<Model>) {
    std::string sliding = sliding_contacts(problem_.pairs_);
    if (!system.evaluate(problem_.u_, problem_.time_, dt))
      if (const Index part = diagnosis.free_part(problem_.u_); part >= 0)
        return {{FailureCause::unsupported, {}}, diagnosis.part_name(part)};
    if (has_friction<Model> && finds_no_balance(failure.cause) &&
        diagnosis.held_by_friction(problem_.u_, problem_.time_))
      return {{FailureCause::slides, {}}, sliding.empty() ? sliding_contacts(problem_.pairs_) : sliding};
  }
  if (may_be_roundoff(failure.cause) && !fails_without_iterating(failure.cause, time, dt)) {
    const bool singular = failure.cause == FailureCause::singular_matrix;
    const std::string source = diagnosis.roundoff_source(problem_.u_, false, singular ? 1e8 : drowned() ? 1e3 : 1e12);
    if (drowned()) return {{FailureCause::digits_lost, {}}, digits_left(source)};
    if (!source.empty()) return {{FailureCause::digits_lost, {}}, source};
  }
  return {failure, {}};
}

template <class Model>
void March<Model>::advance() {
  if constexpr (keeps_energy)
    if (options_.refuse_energy_gain && outcome_ && !gained_.empty()) {
      before_ = now_;
      return fail({FailureCause::energy_gained, {}}, problem_.time_, now_.step.dt, 0, gained_);
    }
  if (!begin_step(newton_.counts)) return;
  require_own();
  problem_.prepare();  // supports and loads may have changed since the last step
  System<Mechanical>& system = *problem_.system_;
  Field& u = trial_;
  Index rejected = 0;
  const auto end = [&](Reason reason, Real dt, Index attempts) {
    fail(reason.failure, problem_.time_, dt, attempts, std::move(reason.detail));
  };
  if constexpr (!has_inertia<Model>)
    if (!problem_.proven_)
      if (const Index part = problem_.diagnosis_->loose_part(true); part >= 0)
        return end({{FailureCause::unsupported, {}}, problem_.diagnosis_->part_name(part)},
                   now_.control.next() - problem_.time_, 0);
  for (;;) {
    const Real time = now_.control.next();
    const Real dt = time - problem_.time_;
    Failure failure;
    const bool extrapolated = problem_.extrapolate(dt, u);
    Failure unsound = system.prescribed().apply_constraints(time, u);
    system.update(problem_.u_, problem_.time_, unsound ? problem_.u_ : u);
    {
      Iterate iterate(system);
      const Attempt tried = attempt(iterate, u, time, dt, extrapolated, unsound);
      const NewtonReport& newton = tried.newton;
      failure = newton.failure;
      count_attempt(tried.outer_iterations, newton.iterations, newton_.counts, system.timings);
      Real local_error = 0, error = 0;
      bool too_coarse = false;
      if constexpr (has_inertia<Model>) {
        if (!failure) local_error = problem_.inertia_->local_error(system.dofs(), system.forces().contact);
        if (options_.time_tolerance > 0) error = local_error / options_.time_tolerance;
        if (error > 2 && options_.steps == 0) {
          now_.control.reject(time, error);
          too_coarse = !now_.control.too_small();
        }
      }
      if (!failure && !too_coarse) {
        const ContactSummary contact = contact_summary(problem_.pairs_);
        driven_ = u - problem_.u_;
        StepReport step{.time = time,
                        .dt = dt,
                        .iterations = newton.iterations,
                        .rejected = rejected,
                        .outer_iterations = tried.outer_iterations,
                        .negative_pivots = newton.negative_pivots,
                        .residual = newton.residual,
                        .contact = contact,
                        .local_error = local_error,
                        .work = std::abs(system.space().dot(system.forces().internal, driven_)) + contact.dissipated};
        if (Reason reason = doubt(iterate, u, step, newton); reason.failure)
          return end(std::move(reason), dt, rejected + 1);
        if (newton_.tells_pivots && newton.iterations == 0) step.negative_pivots = now_.negative_pivots;
        iterate.accept();
        problem_.accept(u, time, dt);
        state_ = problem_.revision_;
        watch_energy(step);
        watch_bending(u);
        Real mesh_error = now_.step.errors.space;
        if (stress_ && now_.report.steps % options_.mesh_error_interval == 0) {
          const Stopwatch watch(system.timings.estimates);
          stress_->update(problem_.bodies_, u);
          mesh_error = stress_->relative();
        }
        complete_step(step, tried.first_iterations, error, mesh_error);
        return;
      }
      ++rejected;
      ++now_.report.rejected_steps;
      if (too_coarse) continue;
    }
    now_.control.reject(time);
    if (now_.control.too_small()) return end(explain(failure, time, dt), dt, rejected);
  }
}

}  // namespace stickslip
