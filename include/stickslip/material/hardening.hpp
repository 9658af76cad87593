// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/material.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// sigma(p) = yield + modulus p. A modulus of zero is perfect plasticity; a negative one softens.
struct LinearHardening {
  using Role = role::Hardening;
  Real yield = 0;    ///< initial flow stress [stress]
  Real modulus = 0;  ///< [stress]

  template <class S>
  FlowStress<S> flow(const S& p) const {
    return {S(yield) + p * modulus, S(modulus)};
  }
  /// Plastic work per reference volume up to p: the integral of the flow stress.
  Real work(Real p) const { return p * (yield + 0.5 * modulus * p); }
  void validate() const {
    if (!(yield > 0)) throw std::invalid_argument("linear hardening: the yield stress must be positive");
    if (!std::isfinite(modulus)) throw std::invalid_argument("linear hardening: the modulus must be finite");
  }
};

/// sigma(p) = strength (offset + p)^exponent (Swift form). With a small offset its start is almost vertical.
struct PowerHardening {
  using Role = role::Hardening;
  Real strength = 0;  ///< [stress]
  Real offset = 0;    ///< [-]
  Real exponent = 0;  ///< [-]

  template <class S>
  FlowStress<S> flow(const S& p) const {
    using std::pow;
    const S base = p + S(offset);
    const S value = S(strength) * pow(base, exponent);
    return {value, S(exponent) * value / base};
  }
  /// Plastic work per reference volume up to p: the integral of the flow stress.
  Real work(Real p) const {
    return strength / (exponent + 1) * (std::pow(offset + p, exponent + 1) - std::pow(offset, exponent + 1));
  }
  void validate() const {
    if (!(strength > 0)) throw std::invalid_argument("power hardening: the strength must be positive");
    if (!(offset > 0))
      throw std::invalid_argument("power hardening: the offset must be positive, or the flow stress starts at zero");
    if (!(exponent > 0 && exponent <= 1))
      throw std::invalid_argument("power hardening: the exponent must lie in (0, 1]");
  }
};

}  // namespace stickslip
