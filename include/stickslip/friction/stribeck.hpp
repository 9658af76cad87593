// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/friction/pressure_source.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Coulomb's slip bound with a coefficient that falls with the slip rate v and recovers at rest,
/// mu(v) = mu_dynamic + (mu_static - mu_dynamic) exp(-w / speed), w = sqrt(v^2 + v_0^2) - v_0, v_0 = rounding * speed:
/// w follows v except near rest, where it makes mu smooth with slope zero (theory.md, eq. 5.24).
struct Stribeck {
  using Role = role::Friction;
  using Law = Stribeck;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = false;
  static constexpr bool depends_on_rate = true;

  Real mu_static = 0;    ///< coefficient at rest [-]
  Real mu_dynamic = 0;   ///< limit for large slip rates [-]
  Real speed = 0;        ///< Stribeck's slip rate, over which the difference falls to 1/e [length / time]
  Real rounding = 0.01;  ///< v_0 / speed [-]

  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    using std::exp;
    using std::sqrt;
    const S v = at.rate * (1 / speed), root = sqrt(v * v + rounding * rounding);
    const S fading = exp(rounding - root) * (mu_static - mu_dynamic);
    const S mu = fading + mu_dynamic;
    return {at.pressure * mu, mu, S(0), at.pressure * fading * v / root * (-1 / speed)};
  }
  /// mu(v) [-] at the slip rate v [length / time].
  Real coefficient(Real v) const { return bound(InterfaceState<Real>{1, 0, 0, v}).value; }

  void validate() const {
    if (!(mu_dynamic >= 0 && mu_static >= mu_dynamic))
      throw std::invalid_argument("Stribeck friction: needs 0 <= mu_dynamic <= mu_static");
    require::finite(mu_static, "Stribeck friction: mu_static");
    require::positive(speed, "Stribeck friction: the speed");
    require::positive(rounding, "Stribeck friction: the rounding");
  }
};

}  // namespace stickslip
