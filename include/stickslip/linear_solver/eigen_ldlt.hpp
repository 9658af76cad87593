// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/SparseCholesky>

#include <vector>

namespace stickslip {

/// Eigen's simplicial L D L^T with approximate minimum degree. It does not pivot: an indefinite matrix is factorised
/// and reported as such, a zero pivot fails.
class EigenLdlt {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;

  void analyze(const SparseView& pattern) {
    const std::vector<Real> zeros(static_cast<std::size_t>(pattern.nonzeros()), 0.0);
    solver_.analyzePattern(Map(pattern.size, pattern.size, pattern.nonzeros(), pattern.column_start, pattern.row, zeros.data()));
  }
  Factorization factorize(const SparseView& matrix) {
    solver_.factorize(Map(matrix.size, matrix.size, matrix.nonzeros(), matrix.column_start, matrix.row, matrix.values));
    if (solver_.info() != Eigen::Success || !solver_.vectorD().allFinite()) return Factorization::failed;
    return solver_.vectorD().minCoeff() > 0 ? Factorization::done : Factorization::indefinite;
  }
  bool solve(const Real* right_hand_side, Real* solution) {
    const auto n = solver_.rows();
    Eigen::Map<Field>(solution, n) = solver_.solve(Eigen::Map<const Field>(right_hand_side, n));
    return solver_.info() == Eigen::Success;
  }

 private:
  using Map = Eigen::Map<const Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>>;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>, Eigen::Lower> solver_;
};

}  // namespace stickslip
