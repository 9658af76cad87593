// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/friction/pressure_source.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Coulomb friction on a tool machined in one direction: an elliptic slip bound with one coefficient along that
/// direction and another across it, and slip along the normal of the ellipse, which dissipates the most (Michalowski &
/// Mroz 1978; theory.md, eq. 5.28). On a surface normal to the direction the slip bound is that of mu_across.
struct AnisotropicCoulomb {
  using Role = role::Friction;
  using Law = AnisotropicCoulomb;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = false;

  Real mu_along = 0;                               ///< coefficient along the direction [-]
  Real mu_across = 0;                              ///< coefficient across it [-]
  Vec<Real, 3> direction = Vec<Real, 3>::UnitX();  ///< in the tool's frame, of any length

  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    return {at.pressure * mu_across, S(mu_across), S(0)};
  }
  /// M [-] of the slip bound sqrt(t . M t) = mu_across p.
  Mat<Real, 3> metric() const {
    const Vec<Real, 3> a = direction.normalized();
    const Real ratio = mu_across / mu_along;
    Mat<Real, 3> M;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) M(i, j) = (i == j ? 1 : 0) + (ratio * ratio - 1) * a[i] * a[j];
    return M;
  }
  void validate() const {
    if (!(mu_along > 0 && mu_across > 0))
      throw std::invalid_argument("anisotropic Coulomb friction: both coefficients must be positive");
    require::finite(mu_along, "anisotropic Coulomb friction: mu_along");
    require::finite(mu_across, "anisotropic Coulomb friction: mu_across");
    if (!(direction.norm() > 0) || !direction.allFinite())
      throw std::invalid_argument("anisotropic Coulomb friction: the direction must be a finite vector, not zero");
  }
};

}  // namespace stickslip
