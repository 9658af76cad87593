// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/friction/pressure_source.hpp>

namespace stickslip {

/// Coulomb's slip bound mu p (paper, eq. 10).
struct Coulomb {
  using Role = role::Friction;
  using Law = Coulomb;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = false;

  Real mu = 0;  ///< friction coefficient [-]

  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    return {at.pressure * mu, S(mu), S(0)};
  }
  void validate() const { require::not_negative(mu, "Coulomb friction: the coefficient mu"); }
};

/// The paper's law: Coulomb's slip bound at the last converged normal force.
using QuasiCoulomb = Quasi<Coulomb>;

/// Coulomb's slip bound at the normal force extrapolated from the last two converged ones.
using ExtrapolatedCoulomb = WithPressure<Coulomb, Extrapolated>;

}  // namespace stickslip
