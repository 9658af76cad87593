// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/SparseLU>

#include <vector>

namespace stickslip {

/// Eigen's supernodal LU with partial pivoting and column approximate minimum degree. Takes every system.
class EigenLu {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;

  void analyze(const SparseView& pattern) {
    const std::vector<Real> zeros(static_cast<std::size_t>(pattern.nonzeros()), 0.0);
    solver_.analyzePattern(
        Map(pattern.size, pattern.size, pattern.nonzeros(), pattern.column_start, pattern.row, zeros.data()));
  }
  Factorization factorize(const SparseView& matrix) {
    solver_.factorize(Map(matrix.size, matrix.size, matrix.nonzeros(), matrix.column_start, matrix.row, matrix.values));
    return solver_.info() == Eigen::Success ? Factorization::done : Factorization::failed;
  }
  bool solve(const Real* right_hand_side, Real* solution) {
    const auto n = solver_.rows();
    Eigen::Map<Field>(solution, n) = solver_.solve(Eigen::Map<const Field>(right_hand_side, n));
    return solver_.info() == Eigen::Success;
  }

 private:
  using Map = Eigen::Map<const Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>>;
  Eigen::SparseLU<Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>, Eigen::COLAMDOrdering<Index>> solver_;
};

}  // namespace stickslip
