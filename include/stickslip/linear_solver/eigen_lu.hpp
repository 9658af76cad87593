// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/eigen_map.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/SparseLU>

#include <cstddef>

namespace stickslip {

/// Eigen's supernodal LU with partial pivoting and column approximate minimum degree. Accepts every system. Use it as
/// `EigenLu`; a template, so that only programs that use it compile it.
template <class Matrix>
class EigenLuOf {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;
  static constexpr bool direct = true;

  void analyze(const SparseView& pattern) { analyze_pattern(solver_, pattern); }
  Factorization factorize(const SparseView& matrix) {
    solver_.factorize(eigen_map(matrix));
    return solver_.info() == Eigen::Success ? Factorization::done : Factorization::failed;
  }
  bool solve(const Real* right_hand_side, Real* solution) {
    const auto n = solver_.rows();
    Eigen::Map<Field>(solution, n) = solver_.solve(Eigen::Map<const Field>(right_hand_side, n));
    return solver_.info() == Eigen::Success;
  }
  /// Memory of the last factor, including its indices [bytes].
  std::size_t factor_bytes() const {
    return static_cast<std::size_t>(solver_.nnzL() + solver_.nnzU()) * (sizeof(Real) + sizeof(Index));
  }

 private:
  Eigen::SparseLU<Matrix, Eigen::COLAMDOrdering<Index>> solver_;
};
using EigenLu = EigenLuOf<EigenMatrix>;

}  // namespace stickslip
