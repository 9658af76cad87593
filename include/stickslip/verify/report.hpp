// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>
#include <stickslip/tensor/dual.hpp>

#include <algorithm>

namespace stickslip::verify {

/// What a tangent is worth. Errors are relative: the largest component of the difference over the largest component of
/// the tangent.
struct TangentReport {
  Real by_duals = 0;        ///< against dual numbers: round-off where the function is smooth
  Real by_differences = 0;  ///< against central differences of fourth order
  Real asymmetry = 0;       ///< largest |K_ij - K_ji|, relative; exactly 0 for a matrix that is mirrored
};

/// Largest component of a - b over the largest of b; of a itself where b is zero.
template <class A, class B>
Real relative_error(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  const Real difference = (a - b).cwiseAbs().maxCoeff();
  const Real scale = b.cwiseAbs().maxCoeff();
  return scale > 0 ? difference / scale : difference;
}

/// Largest |K_ij - K_ji| over the largest component of K.
template <class K>
Real asymmetry(const Eigen::MatrixBase<K>& k) {
  const Real scale = k.cwiseAbs().maxCoeff();
  return scale > 0 ? (k - k.transpose()).cwiseAbs().maxCoeff() / scale : 0;
}

/// df/dx_k of a function of a column x, by the five-point rule: columns of the Jacobian.
template <int rows, int columns, class F>
Mat<Real, rows, columns> differentiate(const Vec<Real, columns>& x, Real step, F&& f) {
  Mat<Real, rows, columns> jacobian;
  for (int k = 0; k < columns; ++k) {
    const auto at = [&](Real h) {
      Vec<Real, columns> moved = x;
      moved[k] += h;
      return Vec<Real, rows>(f(moved));
    };
    const Vec<Real, rows> near = at(step) - at(-step), far = at(2 * step) - at(-2 * step);
    jacobian.col(k) = (8 * near - far) / (12 * step);
  }
  return jacobian;
}

/// The column x as independent variables: direction k belongs to component k.
template <int n>
Vec<Dual<n>, n> seeded(const Vec<Real, n>& x) {
  Vec<Dual<n>, n> y;
  for (int k = 0; k < n; ++k) y[k] = Dual<n>::variable(x[k], k);
  return y;
}

/// The column x as constants.
template <int n, int size>
Vec<Dual<n>, size> constant(const Vec<Real, size>& x) {
  Vec<Dual<n>, size> y;
  for (int k = 0; k < size; ++k) y[k] = Dual<n>(x[k]);
  return y;
}

/// The derivatives that a column of dual numbers carries: one row a component.
template <int n, int rows>
Mat<Real, rows, n> slopes(const Vec<Dual<n>, rows>& y) {
  Mat<Real, rows, n> jacobian;
  for (int i = 0; i < rows; ++i) jacobian.row(i) = y[i].slope.matrix().transpose();
  return jacobian;
}

}  // namespace stickslip::verify
