// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/orthodir.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/base/stored_if.hpp>
#include <stickslip/base/vector_space.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/solve/factor_digits.hpp>
#include <stickslip/solve/system.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace stickslip {

/// Parameters of Newton's method.
struct NewtonOptions {
  /// What round-off may leave of the forces of any run, however tight its tolerance (theory.md, eq. 6.4).
  static constexpr Real promised = 1e-7;

  Real tolerance = 1e-5;  ///< on the residual's norm over the force scale (theory.md, eq. 6.2)
  Index max_iterations = 20;
  bool line_search = true;  ///< shorten steps that do not lower the merit (theory.md, eq. 6.13)
  Index max_cuts = 5;       ///< of one step by the line search
};

/// What one solution of a step took.
struct NewtonReport {
  Failure failure{};
  Index iterations = 0;  ///< linear solutions
  Index line_search_cuts = 0;
  Index indefinite_factorizations = 0;
  Real residual = 0;           ///< last residual over force scale [-]
  Index negative_pivots = -1;  ///< of the last factorisation; -1: none was made, or the solver does not tell
};

/// Counts of work that outlive a step.
struct WorkCounts {
  std::size_t factor_bytes = 0;  ///< memory of the largest factor; 0 of a solver that does not tell
  Index factorizations = 0;
  Index indefinite_factorizations = 0;
  Index line_search_cuts = 0;
  Index corrections = 0;           ///< back-substitutions that correct a symmetric factor
  Index evaluations = 0;           ///< of the system
  Index tangents_unused = 0;       ///< evaluations of a tangent that was not factorised
  Index evaluations_repeated = 0;  ///< for a tangent that was left out at first

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("factor_bytes", self.factor_bytes);
    visit("factorizations", self.factorizations);
    visit("indefinite_factorizations", self.indefinite_factorizations);
    visit("line_search_cuts", self.line_search_cuts);
    visit("corrections", self.corrections);
    visit("evaluations", self.evaluations);
    visit("tangents_unused", self.tangents_unused);
    visit("evaluations_repeated", self.evaluations_repeated);
  }
};

/// Newton's method on the displacements and the condensed unknowns, with a line search. Work space and the solver's
/// analysis outlast the calls; nothing is allocated in the loop. With an inexact tangent, what it lacks is found out
/// where its step does not do (theory.md, section 5.9).
template <class Solver, bool inexact_tangent = false, VectorSpace Space = SerialSpace>
class Newton {
 public:
  explicit Newton(const NewtonOptions& chosen = {}, const SolverParameters<Solver>& solver = {})
      : options(chosen), solver_(make_solver<Solver>(solver)) {}

  /// Whether the solver counts negative pivots.
  static constexpr bool tells_pivots = requires(const Solver& solver) { solver.negative_pivots(); };

  NewtonOptions options;
  WorkCounts counts;
  Real known_scale = 0;  ///< the largest force scale that the run has had [force]

  /// Makes the next factorisation be asked for its digits, as the first of each attempt is.
  void judge_anew() { judged_ = false; }

  /// Solves for the displacements u at `time`, from the guess that u holds and the condensed unknowns of the iterate.
  /// With `driven`, the first linear system carries those increments of the constrained components as well (a tangent
  /// predictor). On failure u is spoilt.
  template <class Iterate>
  NewtonReport solve(Iterate& iterate, Field& u, Real time, Real dt, const Field* driven = nullptr) {
    auto& system = iterate.system();
    const Space& space = system.space();
    NewtonReport report;
    prepare(system);
    last_residual_ = 0;
    if ((report.failure = evaluate(iterate, u, time, dt, Want::tangent, driven))) return report;
    Index stalls = 0;
    Real least = std::numeric_limits<Real>::infinity();  // residual that may be round-off
    Index idle = 0;                                      // iterations that have not halved it
    for (;;) {
      const Real norm = system.forces().norm;
      const Real scale = system.forces().scale(space);
      report.residual = scale > 0 ? norm / scale : 0;
      if (!driven) {
        if (norm <= options.tolerance * scale) {
          if (const Real c = contraction(report.residual); c > 0) contraction_ = c;
          return report;
        }
        if (norm <= 64 * std::numeric_limits<Real>::epsilon() * known_scale) {  // nothing beside what has been
          report.residual = norm / known_scale;
          return report;
        }
        const Real bound = system.roundoff(u);
        if (norm <= bound) {
          if (only_moves(system, bound)) {
            report.residual = 0;  // of forces that are none
            return report;
          }
          const Real largest = std::max(scale, known_scale);
          // What round-off may leave is only a bound of what it does: the residual has to have stopped falling, unless
          // it is small in view of what the run has seen.
          const bool small = norm <= std::max(options.tolerance, NewtonOptions::promised) * largest;
          if (small) report.residual = norm / largest;
          idle = norm > 0.5 * least ? idle + 1 : 0;
          least = std::min(least, norm);
          if (small || idle > (norm <= 10 * NewtonOptions::promised * largest ? 0 : 1)) return report;
        }
      }
      if (report.iterations == options.max_iterations) {
        report.failure.cause = FailureCause::not_converged;
        return report;
      }
      if (!system.tangent().current) {  // convergence was predicted, and did not come
        ++counts.evaluations;
        ++counts.evaluations_repeated;
        ++counts.tangents_unused;
        if ((report.failure = iterate.add_tangent(u, time, dt))) return report;
      }
      const Want want = converges_next(report.residual) ? Want::residual : Want::tangent;
      last_residual_ = report.residual;
      if ((report.failure = direction(system, report))) return report;
      ++report.iterations;
      change_.setZero();
      system.dofs().scatter_add(-1, step_, change_);
      // A pivot of round-off alone throws the body out of sight, where round-off outweighs every load.
      if (system.space().max(nodal_max(system, change_)) > 1e6 * system.bodies().extent()) {
        report.failure = {FailureCause::singular_matrix, {}};
        return report;
      }
      if (driven) change_ += *driven;
      iterate.predict(change_);

      if (driven) {  // the guess was not on the constraints yet: there is no residual to compare with
        u += change_;
        iterate.set_step(1);
        driven = nullptr;
        if ((report.failure = evaluate(iterate, u, time, dt, Want::tangent))) return report;
        continue;
      }
      start_ = u;
      const Real merit = iterate.merit();
      Real length = 1;
      Failure failure;
      const auto go = [&](Want wanted) {
        u = start_ + length * change_;
        iterate.set_step(length);
        failure = evaluate(iterate, u, time, dt, wanted);
      };
      go(want);
      if constexpr (inexact_tangent)
        if (failure || !(iterate.merit() < 0.25 * merit)) {
          if ((report.failure = correct(iterate, u, time, dt))) return report;
          go(Want::tangent);
        }
      for (Index cut = 0;; ++cut) {
        const bool better = !failure && iterate.merit() < merit;
        if (better || (!failure && !options.line_search)) {
          stalls = 0;
          break;
        }
        if (cut == options.max_cuts) {
          if (failure) break;
          ++stalls;
          break;
        }
        ++report.line_search_cuts;
        ++counts.line_search_cuts;
        const Real ratio = failure ? 4.0 : iterate.merit() / merit;
        length *= std::clamp(0.5 / ratio, 0.25, 0.5);
        go(Want::tangent);
      }
      if (failure || stalls > 1) {
        const Real left = system.forces().norm;
        if (!failure && left <= system.roundoff(u)) {  // it has come to its floor
          if (const Real now = system.forces().scale(space); now > 0) report.residual = left / now;
          return report;
        }
        report.failure = failure ? failure : Failure{FailureCause::stalled, {}};
        return report;
      }
    }
  }

  /// What outlives a step and later solutions depend on: the memory of the solver, where it has one.
  template <class System>
  void serialize(Archive& archive, [[maybe_unused]] System& system) {
    archive("Newton's method, contraction", contraction_);
    if constexpr (requires { solver_.serialize(archive); }) {
      prepare(system);  // so that the analysis does not take it back
      solver_.serialize(archive);
    }
  }

 private:
  template <class System>
  void prepare(System& system) {
    if (analyzed_ == system.tangent().revision) return;
    const Stopwatch watch(system.timings.factorization);
    solver_.analyze(system.tangent().stored);
    step_.setZero(system.dofs().unknowns());
    start_.setZero(system.dofs().components());
    change_ = start_;
    if constexpr (inexact_tangent) probes_.krylov.resize(system.dofs().unknowns(), system.space());
    if constexpr (is_direct<Solver>) digits_.resize(system.dofs().unknowns());
    analyzed_ = system.tangent().revision;
  }

  // Evaluates the iterate, and counts.
  template <class Iterate>
  Failure evaluate(Iterate& iterate, const Field& u, Real time, Real dt, Want want, const Field* driven = nullptr) {
    ++counts.evaluations;
    if (want != Want::residual) ++counts.tangents_unused;  // until it is factorised
    return iterate.evaluate(u, time, dt, want, driven);
  }
  // Whether the next full step is likely to converge, so that its tangent would not be factorised: where Newton's
  // method converges, the residual falls to a constant times the square of the one before. That is the larger of the
  // ones that the last two iterates and the end of the last solution show.
  bool converges_next(Real residual) const {
    const Real constant = std::max(contraction_, contraction(residual));
    return constant > 0 && constant * residual * residual <= options.tolerance;
  }
  // That of the last two iterates; 0 where there is one, or the first is out of the reach of such a law.
  Real contraction(Real residual) const {
    return last_residual_ > 0 && last_residual_ < 1 ? residual / (last_residual_ * last_residual_) : 0;
  }
  // Whether the forces of the last evaluation are round-off, and supports alone act on the body: it only moves, free of
  // stress, and would never be in balance but for its round-off.
  template <class System>
  static bool only_moves(const System& system, Real roundoff) {
    const Space& space = system.space();
    return space.sum(contact_summary(system.pairs()).touching) == 0 && space.max(system.forces().external) == 0 &&
           space.norm(system.forces().internal) <= roundoff;
  }

  // Largest magnitude of the nodal components of a field: unknowns of terms, behind them, have units of their own.
  template <class System>
  static Real nodal_max(System& system, const Field& field) {
    return field.head(system.bodies().node_count() * System::dim).template lpNorm<Eigen::Infinity>();
  }

  // step_ = K^-1 R.
  template <class System>
  Failure direction(System& system, NewtonReport& report) {
    if (step_.size() == 0) return {};  // nothing to solve for; the condensed unknowns close all the same
    {
      const Stopwatch watch(system.timings.factorization);
      const Factorization f = solver_.factorize(system.tangent().view());
      ++counts.factorizations;
      --counts.tangents_unused;
      if (f == Factorization::indefinite) ++counts.indefinite_factorizations;
      if (f == Factorization::failed) return {FailureCause::singular_matrix, {}};
      if constexpr (requires { solver_.factor_bytes(); })
        counts.factor_bytes = std::max(counts.factor_bytes, std::size_t(solver_.factor_bytes()));
      if constexpr (tells_pivots) report.negative_pivots = Index(solver_.negative_pivots());
    }
    if constexpr (is_direct<Solver>)
      if (!std::exchange(judged_, true)) {
        const Stopwatch watch(system.timings.solve);
        const Real condition =
            digits_.condition(system.tangent().view(), system.space(),
                              [this](const Field& b, Field& x) { return probe(b.data(), x.data()); });
        if (condition > FactorDigits::limit) return {FailureCause::singular_matrix, {}};
      }
    const Index corrections = corrections_so_far();
    const bool solved = substitute(system, system.right_hand_side(), step_);
    counts.corrections += corrections_so_far() - corrections;
    const Space& space = system.space();
    if (!solved || !std::isfinite(space.norm(step_))) return {FailureCause::singular_matrix, {}};
    return {};
  }

  bool probe(const Real* right_hand_side, Real* solution) {
    if constexpr (requires { solver_.probe(right_hand_side, solution); })
      return solver_.probe(right_hand_side, solution);
    else
      return solver_.solve(right_hand_side, solution);
  }

  template <class System>
  bool substitute(System& system, const Field& right_hand_side, Field& solution) {
    const Stopwatch watch(system.timings.solve);
    return solver_.solve(right_hand_side.data(), solution.data());
  }

  // Makes step_, which the inexact tangent gave, the step of the tangent itself, whose products are differences of the
  // residual along steps short enough for round-off and curvature to be alike. From start_, and back to it.
  template <class Iterate>
  Failure correct(Iterate& iterate, Field& u, Real time, Real dt) requires inexact_tangent {
    constexpr Real tolerance = 1e-3, length = 1e-8;
    constexpr Index most = 30;
    auto& system = iterate.system();
    const Space& space = system.space();
    Orthodir<Space>& krylov = probes_.krylov;
    u = start_;
    iterate.set_step(0);
    change_.setZero();
    iterate.predict(change_, 0);  // what the system notes of an iteration goes back there as well
    iterate.set_step(0);
    // With the tangent, which the search has overwritten: solvers iterate on it, or refine their solutions.
    if (const Failure f = evaluate(iterate, u, time, dt, Want::tangent)) return f;
    probes_.residual = system.right_hand_side();
    krylov.begin(probes_.residual);
    while (krylov.count() < most && space.norm(krylov.residual()) > tolerance * space.norm(probes_.residual)) {
      Field& z = krylov.step();
      if (krylov.count() == 0)
        z = step_;
      else if (!substitute(system, krylov.next(), z))
        return {FailureCause::singular_matrix, {}};
      change_.setZero();
      system.dofs().scatter_add(-1, z, change_);  // the way the step goes: there may be a kink
      const Real part = length * system.bodies().extent() / space.max(nodal_max(system, change_));
      change_ *= part;
      iterate.predict(change_, 0);
      u = start_ + change_;
      iterate.set_step(1);
      const Failure failure = evaluate(iterate, u, time, dt, Want::residual);
      iterate.set_step(0);
      if (failure) break;
      ++counts.corrections;
      krylov.response() = (probes_.residual - system.right_hand_side()) / part;
      if (!krylov.add()) break;
    }
    u = start_;
    if (const Failure f = evaluate(iterate, u, time, dt, Want::residual)) return f;
    step_ = krylov.solution();
    change_.setZero();
    system.dofs().scatter_add(-1, step_, change_);
    iterate.predict(change_);
    return {};
  }

  Index corrections_so_far() const {
    if constexpr (requires { solver_.inner_iterations(); }) return solver_.inner_iterations();
    return 0;
  }

  Solver solver_;
  Field step_, start_, change_;
  struct Probes {
    Orthodir<Space> krylov;
    Field residual;
  };
  [[no_unique_address]] StoredIf<inexact_tangent, Probes, Solver> probes_;
  [[no_unique_address]] StoredIf<is_direct<Solver>, FactorDigits, Newton> digits_;
  bool judged_ = false;     // whether the matrix of this attempt has been
  Real last_residual_ = 0;  // over the force scale
  Real contraction_ = 0;    // at the end of the last solution: a residual over the square of the one before
  Index analyzed_ = 0;
};

}  // namespace stickslip
