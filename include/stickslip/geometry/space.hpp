// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/tensor/products.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

/// Three-dimensional vectors for the tools: products of Real and dual vectors, and checked directions.
namespace stickslip::rigid::detail {

template <class A, class S>
S dot(const Vec<A, 3>& a, const Vec<S, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// v with the scalar type S.
template <class S>
Vec<S, 3> promote(const Vec<Real, 3>& v) {
  return {S(v[0]), S(v[1]), S(v[2])};
}

/// ee e e^T + ff f f^T + ef (e f^T + f e^T).
template <class S>
Mat<S, 3> dyads(const Vec<S, 3>& e, const Vec<S, 3>& f, const S& ee, const S& ff, const S& ef) {
  Mat<S, 3> sum;
  for (int i = 0; i < 3; ++i) {
    const S by_e = ee * e[i] + ef * f[i], by_f = ff * f[i] + ef * e[i];
    for (int j = 0; j <= i; ++j) sum(i, j) = sum(j, i) = by_e * e[j] + by_f * f[j];
  }
  return sum;
}

template <class S>
Vec<Real, 3> values(const Vec<S, 3>& v) {
  return {value_of(v[0]), value_of(v[1]), value_of(v[2])};
}

/// Unit vector along v. Throws std::invalid_argument, beginning with `name`, if v is zero or not finite.
inline Vec<Real, 3> unit(const Vec<Real, 3>& v, const std::string& name) {
  const Real length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument(name + " must be finite and not zero");
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// A unit vector orthogonal to the unit vector `a`.
inline Vec<Real, 3> perpendicular(const Vec<Real, 3>& a) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(a[i]) < std::abs(a[least])) least = i;
  Vec<Real, 3> e = scaled(a, -a[least]);
  e[least] += 1;
  return e.normalized();
}

/// Distance of a point that is not finite: the gap is NaN.
template <class S>
Distance<S, 3> nowhere() {
  Distance<S, 3> at;
  at.gap = S(std::numeric_limits<Real>::quiet_NaN());
  return at;
}

}  // namespace stickslip::rigid::detail
