// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/friction/pressure_source.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Coulomb's slip bound with a coefficient that falls with the accumulated slip S and never recovers:
/// mu(S) = mu_dynamic + (mu_static - mu_dynamic) exp(-S / length) (theory.md, eq. 5.23).
struct SlipWeakeningCoulomb {
  using Role = role::Friction;
  using Law = SlipWeakeningCoulomb;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = true;

  Real mu_static = 0;   ///< coefficient without slip [-]
  Real mu_dynamic = 0;  ///< limit for large slip [-]
  Real length = 0;      ///< accumulated slip over which the difference falls to 1/e [length]

  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    using std::exp;
    const S fading = exp(at.accumulated_slip * (-1 / length)) * (mu_static - mu_dynamic);
    const S mu = fading + mu_dynamic;
    return {at.pressure * mu, mu, at.pressure * fading * (-1 / length)};
  }
  void validate() const {
    if (!(mu_dynamic >= 0 && mu_static >= mu_dynamic))
      throw std::invalid_argument("slip-weakening friction: needs 0 <= mu_dynamic <= mu_static");
    require::finite(mu_static, "slip-weakening friction: mu_static");
    require::positive(length, "slip-weakening friction: the length");
  }
};

}  // namespace stickslip
