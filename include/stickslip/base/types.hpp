// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <numbers>

namespace stickslip {

/// Floating-point type of everything that is stored: coordinates, history, matrices.
using Real = double;
/// Numbers of nodes, elements and equations; the integer that the direct solvers take.
using Index = int;

/// Column vector of `n` components of scalar `S`.
template <class S, int n>
using Vec = Eigen::Matrix<S, n, 1>;

/// Dense matrix of fixed size.
template <class S, int rows, int columns = rows>
using Mat = Eigen::Matrix<S, rows, columns>;

/// Column of run-time length: nodal fields, in the order node * dim + component.
using Field = Eigen::VectorXd;

inline constexpr Real pi = std::numbers::pi_v<Real>;

/// The plain number inside a scalar: itself for Real; the dual number overloads it. Branches of the kernels look at it.
constexpr Real value_of(Real x) {
  return x;
}

}  // namespace stickslip
