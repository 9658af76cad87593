// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>

namespace stickslip {

/// Dual number with `n` directions: a value and its exact derivatives along them. The tangent checks run the kernels of
/// the solver with it in place of Real. Comparisons use the value.
template <int n>
struct Dual {
  Real value = 0;
  Eigen::Array<Real, n, 1> slope = Eigen::Array<Real, n, 1>::Zero();

  Dual() = default;
  Dual(Real v) : value(v) {}  // NOLINT(google-explicit-constructor): constants enter formulas as they are
  Dual(Real v, const Eigen::Array<Real, n, 1>& s) : value(v), slope(s) {}

  /// The independent variable of direction `k` at `v`.
  static Dual variable(Real v, int k) {
    Dual x(v);
    x.slope[k] = 1;
    return x;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator+(const Dual& a) { return a; }
  friend Dual operator-(const Dual& a) { return {-a.value, -a.slope}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    return {a.value / b.value, (a.slope - a.value / b.value * b.slope) / b.value};
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.value > b.value; }
  friend bool operator<=(const Dual& a, const Dual& b) { return a.value <= b.value; }
  friend bool operator>=(const Dual& a, const Dual& b) { return a.value >= b.value; }
  friend bool operator==(const Dual& a, const Dual& b) { return a.value == b.value; }
  friend bool operator!=(const Dual& a, const Dual& b) { return a.value != b.value; }

  /// Chain rule: f(x) from the value and the derivative of f.
  Dual chain(Real f, Real df) const { return {f, df * slope}; }

  friend Dual sqrt(const Dual& x) {
    const Real r = std::sqrt(x.value);
    return x.chain(r, Real(0.5) / r);
  }
  friend Dual exp(const Dual& x) { return x.chain(std::exp(x.value), std::exp(x.value)); }
  friend Dual expm1(const Dual& x) { return x.chain(std::expm1(x.value), std::exp(x.value)); }
  friend Dual log(const Dual& x) { return x.chain(std::log(x.value), 1 / x.value); }
  friend Dual log1p(const Dual& x) { return x.chain(std::log1p(x.value), 1 / (1 + x.value)); }
  friend Dual pow(const Dual& x, Real p) { return x.chain(std::pow(x.value, p), p * std::pow(x.value, p - 1)); }
  friend Dual sin(const Dual& x) { return x.chain(std::sin(x.value), std::cos(x.value)); }
  friend Dual cos(const Dual& x) { return x.chain(std::cos(x.value), -std::sin(x.value)); }
  friend Dual tanh(const Dual& x) {
    const Real t = std::tanh(x.value);
    return x.chain(t, 1 - t * t);
  }
  friend Dual abs(const Dual& x) { return x.value < 0 ? -x : x; }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const Real square = x.value * x.value + y.value * y.value;
    return {std::atan2(y.value, x.value), (x.value * y.slope - y.value * x.slope) / square};
  }
};

template <int n>
Real value_of(const Dual<n>& x) {
  return x.value;
}

}  // namespace stickslip

template <int n>
struct Eigen::NumTraits<stickslip::Dual<n>> : Eigen::NumTraits<double> {
  using Real = stickslip::Dual<n>;
  using NonInteger = stickslip::Dual<n>;
  using Nested = stickslip::Dual<n>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = n,
    AddCost = n,
    MulCost = 2 * n
  };
};
