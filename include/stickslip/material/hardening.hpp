// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/policy/material.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// sigma(p) = yield: no hardening.
struct PerfectPlasticity {
  using Role = role::Hardening;
  Real yield = 0;  ///< flow stress [stress]

  template <class S>
  FlowStress<S> flow(const S&) const {
    return {S(yield), S(0)};
  }
  /// Plastic work per reference volume up to p, the integral of the flow stress [stress].
  Real work(Real p) const { return yield * p; }
  void validate() const { require::positive(yield, "perfect plasticity: the yield stress"); }
};

/// sigma(p) = yield + modulus p. A negative modulus softens.
struct LinearHardening {
  using Role = role::Hardening;
  Real yield = 0;    ///< initial flow stress [stress]
  Real modulus = 0;  ///< [stress]

  template <class S>
  FlowStress<S> flow(const S& p) const {
    return {S(yield) + p * modulus, S(modulus)};
  }
  /// Plastic work per reference volume up to p, the integral of the flow stress [stress].
  Real work(Real p) const { return p * (yield + 0.5 * modulus * p); }
  void validate() const {
    require::positive(yield, "linear hardening: the yield stress");
    require::finite(modulus, "linear hardening: the modulus");
  }
};

/// Swift's power law, sigma(p) = strength (offset + p)^exponent. A small offset makes the initial slope very steep.
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
  /// Plastic work per reference volume up to p, the integral of the flow stress [stress].
  Real work(Real p) const {
    return strength / (exponent + 1) * (std::pow(offset + p, exponent + 1) - std::pow(offset, exponent + 1));
  }
  void validate() const {
    require::positive(strength, "power hardening: the strength");
    require::finite(offset, "power hardening: the offset");
    if (!(offset > 0))
      throw std::invalid_argument("power hardening: the offset must be positive, or the flow stress starts at zero");
    if (!(exponent > 0 && exponent <= 1))
      throw std::invalid_argument("power hardening: the exponent must lie in (0, 1]");
  }
};
/// The power law under the name of its author (Swift 1952).
using SwiftHardening = PowerHardening;

/// sigma(p) = saturation - (saturation - yield) exp(-rate p) + modulus p: Voce's hardening towards a saturation stress,
/// the linear part is zero by default. A saturation stress below the yield stress softens.
struct VoceHardening {
  using Role = role::Hardening;
  Real yield = 0;       ///< initial flow stress [stress]
  Real saturation = 0;  ///< limit of the flow stress without the linear part [stress]
  Real rate = 0;        ///< 1 / plastic strain over which the distance to saturation falls to 1/e [-]
  Real modulus = 0;     ///< slope of the linear part [stress]

  template <class S>
  FlowStress<S> flow(const S& p) const {
    using std::expm1;
    const S gone = expm1(S(-rate) * p);
    return {S(yield) - (saturation - yield) * gone + p * modulus,
            S((saturation - yield) * rate) * (S(1) + gone) + S(modulus)};
  }
  /// Plastic work per reference volume up to p, the integral of the flow stress [stress].
  Real work(Real p) const {
    return p * (saturation + 0.5 * modulus * p) + (saturation - yield) / rate * std::expm1(-rate * p);
  }
  void validate() const {
    require::positive(yield, "Voce hardening: the yield stress");
    require::positive(saturation, "Voce hardening: the saturation stress");
    require::positive(rate, "Voce hardening: the rate");
    require::finite(modulus, "Voce hardening: the modulus");
  }
};

}  // namespace stickslip
