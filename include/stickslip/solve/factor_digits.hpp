// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/vector_space.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <cmath>
#include <limits>

namespace stickslip {

/// Estimates from one back-substitution what the entries of a matrix lose of the digits of its solutions: the condition
/// of the matrix scaled to a diagonal of ones (theory.md, eq. 6.6). It looks at the matrix and its solution, not at
/// the factor, so that all solvers are told alike.
class FactorDigits {
 public:
  /// No digit of a solution is left beyond it.
  static constexpr Real limit = 0.1 / std::numeric_limits<Real>::epsilon();

  void resize(Index size) {
    scale_.setZero(size);
    right_hand_side_.setZero(size);
    solution_.setZero(size);
  }

  /// Estimate of the condition; infinite where the solution fails. `solve(b, x)` returns false if it does.
  template <VectorSpace Space, class Solve>
  Real condition(const SparseView& matrix, const Space& space, Solve&& solve) {
    scale_.setZero();
    for (Index j = 0; j < matrix.size; ++j)
      for (Index k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k)
        if (matrix.row[k] == j) scale_[j] = std::sqrt(std::abs(matrix.values[k]));
    // Signs without a pattern, the same in every run.
    unsigned random = 1;
    for (Index i = 0; i < matrix.size; ++i) {
      random = random * 1664525u + 1013904223u;
      right_hand_side_[i] = random >> 31 ? scale_[i] : -scale_[i];
    }
    if (!solve(right_hand_side_, solution_)) return std::numeric_limits<Real>::infinity();
    scale_.array() *= solution_.array();
    const Real size = space.norm(scale_);
    return std::isfinite(size) ? size : std::numeric_limits<Real>::infinity();
  }

 private:
  Field scale_, right_hand_side_, solution_;
};

}  // namespace stickslip
