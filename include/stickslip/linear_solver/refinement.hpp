// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stickslip {

/// Iterative refinement of solutions of uncertain accuracy: from the factor of an indefinite matrix made without
/// pivoting, or from iterations that update their residual by recurrence. Computes the true residual, improves the
/// solution, and fails if the residual stays large.
class Refinement {
 public:
  void resize(Index size) {
    residual_.setZero(size);
    correction_.setZero(size);
  }

  /// Solves A x = b to the relative residual `aim` if possible, else to 1e-8 or round-off, by `backsolve(b, x)`; false
  /// if that fails or the residual stays larger. `matrix` holds A, or its lower triangle.
  template <class Backsolve>
  bool solve(const SparseView& matrix, const Real* right_hand_side, Real* solution, Backsolve&& backsolve,
             Real aim = 1e-12) {
    const Eigen::Map<const Field> b(right_hand_side, matrix.size);
    Eigen::Map<Field> x(solution, matrix.size);
    if (!backsolve(right_hand_side, solution)) return false;
    for (int sweep = 0; sweep < 4; ++sweep) {
      if (relative_residual(matrix, b, x) <= aim) return true;
      if (!backsolve(residual_.data(), correction_.data())) return false;
      x += correction_;
    }
    if (relative_residual(matrix, b, x) <= 1e-8) return true;
    // A solution that is large for its right-hand side leaves a larger residual by round-off of the products alone.
    // This is a property of the matrix, which other checks judge, and not of the factor.
    Real largest = 0;
    for (Index k = 0; k < matrix.nonzeros(); ++k) largest = std::max(largest, std::abs(matrix.values[k]));
    return residual_.norm() <= 64 * std::numeric_limits<Real>::epsilon() * largest * x.norm();
  }

 private:
  Real relative_residual(const SparseView& m, const Eigen::Map<const Field>& b, const Eigen::Map<Field>& x) {
    residual_ = b;
    for (Index j = 0; j < m.size; ++j)
      for (Index k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
        const Index i = m.row[k];
        residual_[i] -= m.values[k] * x[j];
        if (m.symmetry == Symmetry::symmetric && i != j) residual_[j] -= m.values[k] * x[i];
      }
    const Real size = b.norm();
    return size > 0 ? residual_.norm() / size : 0;
  }

  Field residual_, correction_;
};

}  // namespace stickslip
