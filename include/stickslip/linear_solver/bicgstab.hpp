// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/iteration_limits.hpp>
#include <stickslip/linear_solver/refinement.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/IterativeLinearSolvers>

#include <vector>

namespace stickslip {

/// Eigen's stabilised biconjugate gradients with its incomplete LU. Takes every system, and refuses where it does not
/// converge: the incomplete factor does not pivot.
class Bicgstab {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;

  IterationLimits limits;

  // Looser than Eigen's defaults, whose factor costs more than it saves: it is made anew for every iterate.
  Bicgstab() {
    solver_.preconditioner().setDroptol(1e-2);
    solver_.preconditioner().setFillfactor(2);
  }

  void analyze(const SparseView& pattern) {
    refinement_.resize(pattern.size);
    const std::vector<Real> zeros(static_cast<std::size_t>(pattern.nonzeros()), 0.0);
    solver_.analyzePattern(map(pattern, zeros.data()));
  }

  /// `done` says that there is a preconditioner.
  Factorization factorize(const SparseView& matrix) {
    matrix_ = matrix;
    solver_.factorize(map(matrix, matrix.values));
    return solver_.preconditioner().info() == Eigen::Success ? Factorization::done : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    solver_.setTolerance(limits.tolerance).setMaxIterations(limits.iterations);
    iterations_ = 0;
    return refinement_.solve(
        matrix_, right_hand_side, solution, [this](const Real* b, Real* x) { return iterate(b, x); }, limits.tolerance);
  }

  /// Of the last solution.
  Index iterations() const { return iterations_; }

 private:
  using Matrix = Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>;
  static Eigen::Map<const Matrix> map(const SparseView& m, const Real* values) {
    return {m.size, m.size, m.nonzeros(), m.column_start, m.row, values};
  }

  bool iterate(const Real* right_hand_side, Real* solution) {
    Eigen::Map<Field>(solution, matrix_.size) =
        solver_.solve(Eigen::Map<const Field>(right_hand_side, matrix_.size));
    iterations_ += static_cast<Index>(solver_.iterations());
    return solver_.info() == Eigen::Success;
  }

  Eigen::BiCGSTAB<Matrix, Eigen::IncompleteLUT<Real, Index>> solver_;
  SparseView matrix_{};
  Refinement refinement_;
  Index iterations_ = 0;
};

}  // namespace stickslip
