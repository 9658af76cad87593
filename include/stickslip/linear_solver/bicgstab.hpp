// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/linear_solver/eigen_map.hpp>
#include <stickslip/linear_solver/iteration_limits.hpp>
#include <stickslip/linear_solver/refinement.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/IterativeLinearSolvers>

#include <algorithm>

namespace stickslip {

/// Eigen's BiCGSTAB with its incomplete LU factor; if that does not converge with a loose factor, a tighter one is used
/// until the next `analyze`. Accepts every system; `solve` fails if the tight factor does not converge either, which
/// may happen because the incomplete factor does not pivot.
class Bicgstab {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;
  using Parameters = IterationLimits;

  Bicgstab() : Bicgstab(Parameters{}) {}
  explicit Bicgstab(const Parameters& limits) : limits_(limits) { limits.validate("Bicgstab"); }

  void analyze(const SparseView& pattern) {
    refinement_.resize(pattern.size);
    analyze_pattern(solver_, pattern);
    tighten(false);
  }

  /// `done` means that a preconditioner exists.
  Factorization factorize(const SparseView& matrix) {
    matrix_ = matrix;
    return precondition() ? Factorization::done : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    iterations_ = 0;
    if (converge(right_hand_side, solution)) return true;
    if (tight_) return false;
    tighten(true);
    return precondition() && converge(right_hand_side, solution);
  }

  void serialize(Archive& archive) {
    bool tight = tight_;
    archive("tight incomplete factor", tight);
    if (archive.loading()) tighten(tight);
  }

  /// Iterations of the last `solve`.
  Index iterations() const { return iterations_; }

 private:
  // Nearly incompressible and indefinite systems need the tight factor, which is not much smaller than a complete one;
  // the loose factor takes a fraction of its time.
  void tighten(bool tight) {
    tight_ = tight;
    solver_.preconditioner().setDroptol(tight ? 1e-4 : 1e-2);
    solver_.preconditioner().setFillfactor(tight ? 10 : 2);
  }
  bool precondition() {
    solver_.factorize(eigen_map(matrix_));
    return solver_.preconditioner().info() == Eigen::Success;
  }

  bool converge(const Real* right_hand_side, Real* solution) {
    solver_.setTolerance(limits_.tolerance);
    solver_.setMaxIterations(tight_ ? limits_.iterations : std::min<Index>(limits_.iterations, 300));
    return refinement_.solve(
        matrix_, right_hand_side, solution, [this](const Real* b, Real* x) { return iterate(b, x); },
        limits_.tolerance);
  }
  bool iterate(const Real* right_hand_side, Real* solution) {
    Eigen::Map<Field>(solution, matrix_.size) = solver_.solve(Eigen::Map<const Field>(right_hand_side, matrix_.size));
    iterations_ += static_cast<Index>(solver_.iterations());
    return solver_.info() == Eigen::Success;
  }

  // Eigen reads the status before the first factorisation.
  struct IncompleteLu : Eigen::IncompleteLUT<Real, Index> {
    IncompleteLu() { m_info = Eigen::Success; }
  };

  Eigen::BiCGSTAB<EigenMatrix, IncompleteLu> solver_;
  IterationLimits limits_;
  SparseView matrix_{};
  Refinement refinement_;
  Index iterations_ = 0;
  bool tight_ = false;
};

}  // namespace stickslip
