// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/verify/report.hpp>

namespace stickslip::verify {

/// Dense copy of a sparse matrix, with both triangles.
inline Eigen::MatrixXd dense(const SparseView& m) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(m.size, m.size);
  for (Index j = 0; j < m.size; ++j)
    for (Index k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
      full(m.row[k], j) = m.values[k];
      if (m.symmetry == Symmetry::symmetric) full(j, m.row[k]) = m.values[k];
    }
  return full;
}

/// The tangent of a whole system at the displacements u against central differences of its residual. The history of the
/// system is unchanged; its last evaluation is that at u. Systems do not take dual numbers: `by_duals` is 0.
template <class System>
TangentReport system_tangent(System& system, const Field& u, Real time, Real dt, Real step = 1e-5) {
  const Index n = system.dofs().unknowns();
  Eigen::MatrixXd by_differences(n, n);
  Field unit = Field::Zero(n), moved;
  const auto at = [&](Real h) {
    moved = u;
    system.dofs().scatter_add(h, unit, moved);
    (void)system.evaluate(moved, time, dt);
    return Field(system.forces().residual);
  };
  for (Index k = 0; k < n; ++k) {
    unit.setZero();
    unit[k] = 1;
    by_differences.col(k) = (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
  }
  (void)system.evaluate(u, time, dt);
  const Eigen::MatrixXd tangent = dense(system.tangent().view());
  return {0, relative_error(tangent, by_differences), asymmetry(tangent)};
}

}  // namespace stickslip::verify
