// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>
#include <stickslip/policy/condensed_unknown.hpp>
#include <stickslip/tensor/dual.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace stickslip::verify {

/// Errors of a tangent, relative: the largest component of the difference over the largest component of the tangent.
struct TangentReport {
  Real by_duals = 0;        ///< against dual numbers: round-off where the function is smooth
  Real by_differences = 0;  ///< against central differences of fourth order
  Real asymmetry = 0;       ///< largest |K_ij - K_ji|, relative; exactly 0 if one triangle is a copy of the other
};

/// Largest component of a - b over the largest of b; the largest of a if b is zero.
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

/// Jacobian of f(x) by the five-point rule with the interval `step`; column k is df/dx_k.
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

/// The vector x as independent variables: direction k belongs to component k.
template <int n>
Vec<Dual<n>, n> seeded(const Vec<Real, n>& x) {
  Vec<Dual<n>, n> y;
  for (int k = 0; k < n; ++k) y[k] = Dual<n>::variable(x[k], k);
  return y;
}

/// The vector x as constants.
template <int n, int size>
Vec<Dual<n>, size> constant(const Vec<Real, size>& x) {
  Vec<Dual<n>, size> y;
  for (int k = 0; k < size; ++k) y[k] = Dual<n>(x[k]);
  return y;
}

/// Jacobian of a vector of dual numbers: one row per component.
template <int n, int rows>
Mat<Real, rows, n> slopes(const Vec<Dual<n>, rows>& y) {
  Mat<Real, rows, n> jacobian;
  for (int i = 0; i < rows; ++i) jacobian.row(i) = y[i].slope.matrix().transpose();
  return jacobian;
}

/// Forces, tangent and condensed unknowns of a kernel at a position and a value of the unknowns.
template <int n, int m = 1>
struct RelationSample {
  Vec<Real, n> force;
  Mat<Real, n> tangent;
  CondensedUnknown<Real, n, m> relation;
};

/// Errors of the linearisation of open condensed unknowns (theory.md, eq. 6.11), relative to central differences.
struct RelationReport {
  Real gradient = 0;  ///< error of the gradient of the constraint residual, 0 where that is no function of the place
  Real force = 0;     ///< error of the constraint force
  Real tangent = 0;   ///< error of the tangent with the unknowns condensed
};

/// Checks the condensed unknowns of at(x, value) -> RelationSample. Where their relation is no explicit function of the
/// place, `residual` and `gradient` being those of its linearisation, `gradient` of the report is 0.
template <int n, int m = 1, class At>
RelationReport relation_report(const Vec<Real, n>& x, const typename CondensedUnknown<Real, n, m>::Value& value,
                               Real step, Real value_step, At&& at, bool explicit_relation = true) {
  using Value = typename CondensedUnknown<Real, n, m>::Value;
  const auto vector = [](const Value& v) {
    Vec<Real, m> r;
    if constexpr (m == 1)
      r[0] = v;
    else
      r = v;
    return r;
  };
  const auto of_vector = [](const Vec<Real, m>& v) {
    if constexpr (m == 1)
      return v[0];
    else
      return v;
  };
  const RelationSample<n, m> now = at(x, value);
  const Mat<Real, n, m> by_value =
      differentiate<n, m>(vector(value), value_step, [&](const Vec<Real, m>& v) { return at(x, of_vector(v)).force; });
  const Mat<Real, n> by_place = differentiate<n, n>(x, step, [&](const Vec<Real, n>& y) { return at(y, value).force; });
  RelationReport report;
  if (explicit_relation) {
    const Mat<Real, m, n> slope =
        differentiate<m, n>(x, step, [&](const Vec<Real, n>& y) { return vector(at(y, value).relation.residual); });
    report.gradient = relative_error(now.relation.gradient.transpose(), slope);
  }
  const Mat<Real, m, n> gradient = now.relation.gradient.transpose();
  report.force = relative_error(now.relation.force, Vec<Real, n>(by_value * vector(now.relation.residual)));
  report.tangent = relative_error(now.tangent, Mat<Real, n>(by_place + by_value * gradient));
  return report;
}

/// Rotation by `angle` [rad]: in the plane, or in three dimensions about (1, 2, 2) / 3.
template <class TensorPattern>
Tensor<Real, TensorPattern> rotation(Real angle) {
  std::array<Real, 3> axis{0, 0, 1};
  if constexpr (TensorPattern::dim == 3) axis = {Real(1) / 3, Real(2) / 3, Real(2) / 3};
  auto Q = Tensor<Real, TensorPattern>::identity();
  Q.v *= std::cos(angle);
  for (const auto& [i, j] : TensorPattern::pairs) {
    Q(i, j) += (1 - std::cos(angle)) * axis[std::size_t(i)] * axis[std::size_t(j)];
    const int k = 3 - i - j;  // the third index if i != j
    if (i != j) Q(i, j) -= std::sin(angle) * axis[std::size_t(k)] * ((i + 1) % 3 == j ? 1 : -1);
  }
  return Q;
}

}  // namespace stickslip::verify
