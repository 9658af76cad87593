// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/system.hpp>
#include <stickslip/base/minimal_residual.hpp>
#include <stickslip/base/nothing.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/solve/factor_digits.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace stickslip {

/// Parameters of Newton's method.
struct NewtonOptions {
  /// What round-off may leave of the forces of any run, however tight its tolerance (theory.md, eq. 6.2b).
  static constexpr Real promised = 1e-7;

  Real tolerance = 1e-5;  ///< on the residual's norm over the force scale (theory.md, eq. 6.2)
  Index max_iterations = 20;
  bool line_search = true;  ///< shorten steps that do not lower the merit (theory.md, eq. 6.9)
  Index max_cuts = 5;       ///< of one step by the line search
};

/// What one solution of a step took.
struct NewtonReport {
  Trouble trouble{};
  Index iterations = 0;  ///< linear solutions
  Index line_search_cuts = 0;
  Index indefinite_factorizations = 0;
  Real residual = 0;           ///< last residual over force scale [-]
  Index negative_pivots = -1;  ///< of the last factorisation; -1: none was made, or the solver does not tell
};

/// Counts of work that outlive a step. Without padding: it stands in restart files as it is.
struct WorkCounts {
  std::size_t factor_bytes = 0;  ///< memory of the largest factor; 0 of a solver that does not tell
  Index factorizations = 0;
  Index indefinite_factorizations = 0;
  Index line_search_cuts = 0;
  Index corrections = 0;  ///< back-substitutions that correct a symmetric factor
};

/// Newton's method on the displacements and the stiff relations' variables, with a line search. Work space and the
/// solver's analysis outlast the calls; nothing is allocated in the loop. With a tangent that is only near the
/// residual's derivative, what it lacks is found out where its step does not do (theory.md, section 5.9).
template <class Solver, bool near_tangent = false>
class Newton {
 public:
  explicit Newton(const NewtonOptions& chosen = {}) : options(chosen) {}

  /// Whether the solver counts negative pivots.
  static constexpr bool tells_pivots = requires(const Solver& solver) { solver.negative_pivots(); };

  NewtonOptions options;
  WorkCounts counts;
  Real known_scale = 0;  ///< the largest force scale that the run has had [force]

  /// Solves for the displacements u at `time`, from the guess that u holds. With `driven`, the first linear system
  /// carries those increments of the constrained components as well (a tangent predictor). On failure u is spoilt.
  template <class System>
  NewtonReport solve(System& system, Field& u, Real time, Real dt, const Field* driven = nullptr) {
    system.begin_iteration();
    judge_anew();
    return resume(system, u, time, dt, driven);
  }

  /// Makes the next factorisation be asked for its digits, as the first of each attempt is.
  void judge_anew() { measured_ = false; }

  /// The same from the stiff relations' variables as they are: another pass over a step.
  template <class System>
  NewtonReport resume(System& system, Field& u, Real time, Real dt, const Field* driven = nullptr) {
    NewtonReport report;
    prepare(system);
    if ((report.trouble = system.iterate(u, time, dt, driven))) return report;
    Index stalls = 0;
    Real least = std::numeric_limits<Real>::infinity();  // residual that may be round-off
    Index idle = 0;                                      // iterations that have not halved it
    for (;;) {
      const Real norm = system.residual_norm();
      const Real scale = system.force_scale();
      report.residual = scale > 0 ? norm / scale : 0;
      if (!driven) {
        if (norm <= options.tolerance * scale) return report;
        if (norm <= 64 * std::numeric_limits<Real>::epsilon() * known_scale) {  // nothing beside what has been
          report.residual = norm / known_scale;
          return report;
        }
        const Real bound = system.roundoff(u);
        if (norm <= bound) {
          if (system.only_moves(bound)) {
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
        report.trouble.cause = Cause::not_converged;
        return report;
      }
      if ((report.trouble = direction(system, report))) return report;
      ++report.iterations;
      change_.setZero();
      system.dofs().scatter_add(-1, step_, change_);
      if (driven) change_ += *driven;
      system.follow(change_);

      if (driven) {  // the guess was not on the constraints yet: there is no residual to compare with
        u += change_;
        system.move(1);
        driven = nullptr;
        if ((report.trouble = system.iterate(u, time, dt))) return report;
        continue;
      }
      start_ = u;
      const Real merit = system.merit();
      Real length = 1;
      Trouble trouble;
      const auto go = [&] {
        u = start_ + length * change_;
        system.move(length);
        trouble = system.iterate(u, time, dt);
      };
      go();
      if constexpr (near_tangent)
        if (trouble || !(system.merit() < 0.25 * merit)) {
          if ((report.trouble = correct(system, u, time, dt))) return report;
          go();
        }
      for (Index cut = 0;; ++cut) {
        const bool better = !trouble && system.merit() < merit;
        if (better || (!trouble && !options.line_search)) {
          stalls = 0;
          break;
        }
        if (cut == options.max_cuts) {
          if (trouble) break;
          ++stalls;
          break;
        }
        ++report.line_search_cuts;
        ++counts.line_search_cuts;
        const Real ratio = trouble ? 4.0 : system.merit() / merit;
        length *= std::clamp(0.5 / ratio, 0.25, 0.5);
        go();
      }
      if (trouble || stalls > 1) {
        const Real left = system.residual_norm();
        if (!trouble && left <= system.roundoff(u)) {  // it has come to its floor
          if (system.force_scale() > 0) report.residual = left / system.force_scale();
          return report;
        }
        report.trouble = trouble ? trouble : Trouble{Cause::stalled, {}};
        return report;
      }
    }
  }

  /// What the solver remembers from one system to the next and its solutions depend on, where it says so.
  template <class System>
  void serialize([[maybe_unused]] Archive& archive, [[maybe_unused]] System& system) {
    if constexpr (requires { solver_.serialize(archive); }) {
      prepare(system);  // so that the analysis does not take it back
      solver_.serialize(archive);
    }
  }

 private:
  template <class System>
  void prepare(System& system) {
    if (analyzed_ == system.pattern_revision()) return;
    const Stopwatch watch(system.timings.factorization);
    solver_.analyze(system.matrix());
    step_.setZero(system.dofs().unknowns());
    start_.setZero(system.dofs().components());
    change_ = start_;
    if constexpr (near_tangent) probes_.krylov.resize(system.dofs().unknowns());
    if constexpr (is_direct<Solver>) digits_.resize(system.dofs().unknowns());
    analyzed_ = system.pattern_revision();
  }

  // step_ = K^-1 R.
  template <class System>
  Trouble direction(System& system, NewtonReport& report) {
    if (step_.size() == 0) return {};  // nothing to solve for; the stiff relations close all the same
    {
      const Stopwatch watch(system.timings.factorization);
      const Factorization f = solver_.factorize(system.matrix());
      ++counts.factorizations;
      if (f == Factorization::indefinite) ++counts.indefinite_factorizations;
      if (f == Factorization::failed) return {Cause::singular_matrix, {}};
      if constexpr (requires { solver_.factor_bytes(); })
        counts.factor_bytes = std::max(counts.factor_bytes, std::size_t(solver_.factor_bytes()));
      if constexpr (tells_pivots) report.negative_pivots = Index(solver_.negative_pivots());
    }
    if constexpr (is_direct<Solver>)
      if (!std::exchange(measured_, true)) {
        const Stopwatch watch(system.timings.solve);
        const Real condition =
            digits_.condition(system.matrix(), [this](const Field& b, Field& x) { return probe(b.data(), x.data()); });
        if (condition > FactorDigits::limit) return {Cause::singular_matrix, {}};
      }
    const Index corrections = corrections_so_far();
    const bool solved = substitute(system, system.residual(), step_);
    counts.corrections += corrections_so_far() - corrections;
    if (!solved || !step_.allFinite()) return {Cause::singular_matrix, {}};
    // A pivot of round-off alone throws the body out of sight, where round-off outweighs every load.
    if (step_.lpNorm<Eigen::Infinity>() > 1e6 * system.extent()) return {Cause::singular_matrix, {}};
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

  // Makes step_, which the near tangent gave, the step of the tangent itself, whose products are differences of the
  // residual along steps short enough for round-off and curvature to be alike. From start_, and back to it.
  template <class System>
  Trouble correct(System& system, Field& u, Real time, Real dt) requires near_tangent {
    constexpr Real tolerance = 1e-3, length = 1e-8;
    constexpr Index most = 30;
    MinimalResidual& krylov = probes_.krylov;
    u = start_;
    system.move(0);
    change_.setZero();
    system.follow(change_, 0);  // what the system notes of an iteration goes back there as well
    system.move(0);
    if (const Trouble t = system.iterate(u, time, dt)) return t;
    probes_.residual = system.residual();
    krylov.begin(probes_.residual);
    while (krylov.count() < most && krylov.residual().norm() > tolerance * probes_.residual.norm()) {
      Field& z = krylov.step();
      if (krylov.count() == 0)
        z = step_;
      else if (!substitute(system, krylov.next(), z))
        return {Cause::singular_matrix, {}};
      const Real part = length * system.extent() / z.template lpNorm<Eigen::Infinity>();
      change_.setZero();
      system.dofs().scatter_add(-part, z, change_);  // the way the step goes: there may be a kink
      system.follow(change_, 0);
      u = start_ + change_;
      system.move(1);
      const Trouble trouble = system.iterate(u, time, dt);
      system.move(0);
      if (trouble) break;
      ++counts.corrections;
      krylov.response() = (probes_.residual - system.residual()) / part;
      if (!krylov.add()) break;
    }
    u = start_;
    if (const Trouble t = system.iterate(u, time, dt)) return t;
    step_ = krylov.solution();
    change_.setZero();
    system.dofs().scatter_add(-1, step_, change_);
    system.follow(change_);
    return {};
  }

  Index corrections_so_far() const {
    if constexpr (requires { solver_.inner_iterations(); }) return solver_.inner_iterations();
    return 0;
  }

  Solver solver_;
  Field step_, start_, change_;
  struct Probes {
    MinimalResidual krylov;
    Field residual;
  };
  [[no_unique_address]] Only<near_tangent, Probes, Solver> probes_;
  [[no_unique_address]] Only<is_direct<Solver>, FactorDigits, Newton> digits_;
  bool measured_ = false;  // whether the matrix of this attempt has been
  Index analyzed_ = 0;
};

}  // namespace stickslip
