// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/friction/pressure_source.hpp>

#include <stdexcept>

namespace stickslip {

/// Coulomb's slip bound, capped by the largest shear stress of the interface, such as the softer body's shear yield
/// stress: min(mu p, tau_max A) (Orowan; theory.md, eq. 5.21).
struct CappedCoulomb {
  using Role = role::Friction;
  using Law = CappedCoulomb;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = false;
  static constexpr bool depends_on_area = true;

  Real mu = 0;       ///< friction coefficient [-]
  Real tau_max = 0;  ///< largest shear stress, per reference area [force / length^2]

  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    const S sliding = at.pressure * mu;
    const Real cap = tau_max * at.area;
    const bool capped = value_of(sliding) > cap;
    return {capped ? S(cap) : sliding, S(capped ? 0 : mu), S(0)};
  }
  void validate() const {
    require::not_negative(mu, "capped Coulomb friction: the coefficient mu");
    if (!(tau_max > 0))
      throw std::invalid_argument("capped Coulomb friction: the shear stress tau_max must be positive");
  }
};

}  // namespace stickslip
