// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

/// Vectors of space for the tools: products that take Real beside a dual number, and checked directions.
namespace stickslip::rigid::detail {

template <class A, class S>
S dot(const Vec<A, 3>& a, const Vec<S, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class S>
Vec<S, 3> cross(const Vec<S, 3>& a, const Vec<S, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class S>
Vec<Real, 3> plain(const Vec<S, 3>& v) {
  return {value_of(v[0]), value_of(v[1]), value_of(v[2])};
}

/// The unit vector along v; `name` begins the complaint about one without a direction.
inline Vec<Real, 3> unit(const Vec<Real, 3>& v, const std::string& name) {
  const Real length = v.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) throw std::invalid_argument(name + " must be finite and not zero");
  return v / length;
}

/// Some unit vector at a right angle to the unit vector `a`.
inline Vec<Real, 3> perpendicular(const Vec<Real, 3>& a) {
  int least = 0;
  a.cwiseAbs().minCoeff(&least);
  Vec<Real, 3> e = -a[least] * a;
  e[least] += 1;
  return e.normalized();
}

/// The answer to a point that is not a number: its gap is not one either.
template <class S>
Distance<S, 3> nowhere() {
  Distance<S, 3> at;
  at.gap = S(std::numeric_limits<Real>::quiet_NaN());
  return at;
}

}  // namespace stickslip::rigid::detail
