// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>
#include <stickslip/policy/stiff_relation.hpp>
#include <stickslip/tensor/dual.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <algorithm>
#include <array>
#include <cmath>

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

/// What a part with a stiff relation answers at a place and a value of the relation's variable.
template <int n>
struct RelationSample {
  Vec<Real, n> force;
  Mat<Real, n> tangent;
  StiffRelation<Real, n> relation;
};

/// What the linearisation of a stiff relation is worth where it is open (theory.md, eq. 6.7): relative errors against
/// central differences.
struct RelationReport {
  Real slope = 0;    ///< of what the displacements ask for
  Real excess = 0;   ///< of the forces that closing the defect adds
  Real tangent = 0;  ///< of the forces' derivative as the variable follows
};

/// The relation of at(x, value) -> RelationSample.
template <int n, class At>
RelationReport relation_report(const Vec<Real, n>& x, Real value, Real step, Real value_step, At&& at) {
  const RelationSample<n> now = at(x, value);
  const Mat<Real, 1, n> slope =
      differentiate<1, n>(x, step, [&](const Vec<Real, n>& y) { return Vec<Real, 1>(at(y, value).relation.defect); });
  const Vec<Real, n> by_value =
      differentiate<n, 1>(Vec<Real, 1>(value), value_step, [&](const Vec<Real, 1>& v) { return at(x, v[0]).force; });
  const Mat<Real, n> by_place = differentiate<n, n>(x, step, [&](const Vec<Real, n>& y) { return at(y, value).force; });
  return {relative_error(now.relation.slope.transpose(), slope),
          relative_error(now.relation.excess, Vec<Real, n>(by_value * now.relation.defect)),
          relative_error(now.tangent, Mat<Real, n>(by_place + by_value * slope))};
}

/// Rotation by `angle` [rad]: in the plane, or in space about (1, 2, 2) / 3.
template <class Shape>
Tensor<Real, Shape> rotation(Real angle) {
  std::array<Real, 3> axis{0, 0, 1};
  if constexpr (Shape::dim == 3) axis = {Real(1) / 3, Real(2) / 3, Real(2) / 3};
  auto Q = Tensor<Real, Shape>::identity();
  Q.v *= std::cos(angle);
  for (const auto& [i, j] : Shape::pairs) {
    Q(i, j) += (1 - std::cos(angle)) * axis[std::size_t(i)] * axis[std::size_t(j)];
    const int k = 3 - i - j;  // the third of two different ones
    if (i != j) Q(i, j) -= std::sin(angle) * axis[std::size_t(k)] * ((i + 1) % 3 == j ? 1 : -1);
  }
  return Q;
}

}  // namespace stickslip::verify
