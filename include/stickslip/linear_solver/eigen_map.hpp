// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/SparseCore>

#include <vector>

namespace stickslip {

/// Eigen's type of a system matrix.
using EigenMatrix = Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>;
using EigenMap = Eigen::Map<const EigenMatrix>;

inline EigenMap eigen_map(const SparseView& m) {
  return {m.size, m.size, m.nonzeros(), m.column_start, m.row, m.values};
}

/// Analyses the pattern for a solver or preconditioner of Eigen, with zeros for the values that Eigen requires.
template <class Solver>
void analyze_pattern(Solver& solver, SparseView pattern) {
  const std::vector<Real> zeros(static_cast<std::size_t>(pattern.nonzeros()), 0.0);
  pattern.values = zeros.data();
  solver.analyzePattern(eigen_map(pattern));
}

}  // namespace stickslip
