// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>

namespace stickslip {

/// ln(1 + x), with a relative error of a few roundings for every x. As fast as a logarithm, unlike `log1p`.
template <class S>
S log_one_plus(const S& x) {
  using std::log;
  if (std::abs(value_of(x)) > 0.1) return log(S(1) + x);  // 1 + x loses few digits of x
  // Series of 2 artanh t, in pairs of terms that the processor evaluates in parallel.
  const S t = x / (S(2) + x), s = t * t, s2 = s * s;
  return S(2) * t * ((S(1) + s * S(1. / 3)) + s2 * ((S(1. / 5) + s * S(1. / 7)) + s2 * (S(1. / 9) + s * S(1. / 11))));
}

/// e^x - 1, likewise.
template <class S>
S exp_less_one(const S& x) {
  using std::exp;
  if (std::abs(value_of(x)) > 0.02) return exp(x) - S(1);
  const S x2 = x * x;
  return x * ((S(1) + x * S(1. / 2)) +
              x2 * ((S(1. / 6) + x * S(1. / 24)) +
                    x2 * ((S(1. / 120) + x * S(1. / 720)) + x2 * (S(1. / 5040) + x * S(1. / 40320)))));
}

}  // namespace stickslip
