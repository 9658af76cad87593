// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/eigen_map.hpp>
#include <stickslip/linear_solver/refinement.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/SparseCholesky>

#include <cstddef>

namespace stickslip {

/// Eigen's simplicial L D L^T with approximate minimum degree. It does not pivot: for an indefinite matrix `solve`
/// refines the solution and fails if its residual stays large; a zero pivot fails. Use it as `EigenLdlt`; a template,
/// so that only programs that use it compile it.
template <class Matrix>
class EigenLdltOf {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;
  static constexpr bool direct = true;

  void analyze(const SparseView& pattern) {
    refinement_.resize(pattern.size);
    analyze_pattern(solver_, pattern);
  }
  Factorization factorize(const SparseView& matrix) {
    solver_.factorize(eigen_map(matrix));
    if (solver_.info() != Eigen::Success || !solver_.vectorD().allFinite()) return Factorization::failed;
    matrix_ = matrix;
    indefinite_ = !(solver_.vectorD().minCoeff() > 0);
    return indefinite_ ? Factorization::indefinite : Factorization::done;
  }
  bool solve(const Real* right_hand_side, Real* solution) {
    if (!indefinite_) return backsolve(right_hand_side, solution);
    return refinement_.solve(matrix_, right_hand_side, solution,
                             [this](const Real* b, Real* x) { return backsolve(b, x); });
  }
  /// Negative pivots of the last factorisation, as many as the matrix has negative eigenvalues.
  Index negative_pivots() const { return static_cast<Index>((solver_.vectorD().array() < 0).count()); }
  /// Memory of the last factor, including its indices [bytes].
  std::size_t factor_bytes() const {
    const auto entries = static_cast<std::size_t>(solver_.matrixL().nestedExpression().nonZeros());
    return entries * (sizeof(Real) + sizeof(Index)) + static_cast<std::size_t>(solver_.rows()) * sizeof(Real);
  }

 private:
  bool backsolve(const Real* right_hand_side, Real* solution) {
    const auto n = solver_.rows();
    Eigen::Map<Field>(solution, n) = solver_.solve(Eigen::Map<const Field>(right_hand_side, n));
    return solver_.info() == Eigen::Success;
  }

  Eigen::SimplicialLDLT<Matrix, Eigen::Lower> solver_;
  SparseView matrix_{};
  bool indefinite_ = false;
  Refinement refinement_;
};
using EigenLdlt = EigenLdltOf<EigenMatrix>;

}  // namespace stickslip
