// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/policy/enforcement.hpp>

namespace stickslip {

/// Augmented Lagrangian method by Uzawa's algorithm (Simo & Laursen 1992; theory.md, eq. 4.16-4.18). Each step takes
/// several outer iterations: the pressures and friction forces of one are the multipliers of the next, until the gaps
/// of pressed nodes and the elastic slips of sticking nodes are within tolerance.
///
/// Penalties are relative to the body's stiffness and grow where the outer iterations, which end by
/// MarchOptions::outer_tolerance, converge slowly: no tuning. With LagIterated friction every tangent is symmetric.
struct AugmentedLagrangian {
  using Role = role::Enforcement;
  static constexpr bool active = true;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real normal = 10;     ///< normal penalty [-], or as `per` selects
  Real tangential = 1;  ///< penalty of sticking [-], or as `per` selects
  PenaltyPer per = PenaltyPer::stiffness;

  template <class S>
  struct Memory {
    S pressure = S(0);  ///< multiplier [force]

    template <class Self, class Visit>
    static constexpr void members(Self& self, Visit&& visit) {
      visit("pressure", self.pressure);
    }
  };

  /// t_N = -pressure + normal g (theory.md, eq. 4.16).
  template <class S>
  NormalForce<S> normal_force(const S& gap, Real weight, const Memory<S>& memory) const {
    return {gap * (normal * weight) - memory.pressure, S(normal * weight)};
  }
  Real stick_stiffness(Real weight) const { return tangential * weight; }
  /// Multiplier after an augmentation at `pressure` [force].
  template <class S>
  Memory<S> augmented(const S& pressure) const {
    return {pressure};
  }
  /// Energy stored in the penetration that the outer iterations leave.
  Real energy(Real gap, Real weight) const { return 0.5 * normal * weight * gap * gap; }

  void validate() const {
    require::positive(normal, "augmented Lagrangian: the normal stiffness");
    require::not_negative(tangential, "augmented Lagrangian: the tangential stiffness");
  }
};

}  // namespace stickslip
