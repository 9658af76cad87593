// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/friction/pressure_source.hpp>

namespace stickslip {

/// Tresca's slip bound tau A: a constant shear stress in contact, independent of the pressure (theory.md, eq. 5.22).
/// The tangent is symmetric, and the pressure source has no effect.
struct Tresca {
  using Role = role::Friction;
  using Law = Tresca;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = false;
  static constexpr bool depends_on_slip = false;
  static constexpr bool depends_on_area = true;

  Real tau = 0;  ///< shear stress, per reference area [force / length^2]

  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    return {S(tau * at.area), S(0), S(0)};
  }
  void validate() const { require::not_negative(tau, "Tresca friction: the shear stress tau"); }
};
static_assert(friction_symmetry<Tresca>() == Symmetry::symmetric);

}  // namespace stickslip
