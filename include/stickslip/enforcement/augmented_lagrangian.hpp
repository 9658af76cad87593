// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/policy/enforcement.hpp>

namespace stickslip {

/// Augmented Lagrangian method, by Uzawa's algorithm (Simo & Laursen 1992; theory.md, eq. 4.16-4.18): each step is
/// passed over several times, the pressures and friction forces of a pass being the multipliers of the next, until
/// neither a pressed node's gap nor a sticking one's reversible slide is left to speak of.
///
/// Nothing needs tuning: the stiffnesses are in parts of the body's own and grow where the passes settle slowly, and
/// the passes stop by MarchOptions::pass_tolerance. With LagIterated friction every pass has a symmetric tangent.
struct AugmentedLagrangian {
  using Role = role::Enforcement;
  static constexpr bool active = true;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real normal = 10;     ///< [-], or as `per` says
  Real tangential = 1;  ///< of sticking [-], or as `per` says
  PenaltyPer per = PenaltyPer::stiffness;

  template <class S>
  struct Memory {
    S pressure = S(0);  ///< multiplier [force]
  };

  /// t_N = -pressure + normal g (theory.md, eq. 4.16).
  template <class S>
  NormalForce<S> normal_force(const S& gap, Real weight, const Memory<S>& memory) const {
    return {gap * (normal * weight) - memory.pressure, S(normal * weight)};
  }
  Real stick_stiffness(Real weight) const { return tangential * weight; }
  /// The multiplier that a pressure leaves.
  template <class S>
  Memory<S> augmented(const S& pressure) const {
    return {pressure};
  }
  /// Energy stored in a penetration that the passes have left.
  Real energy(Real gap, Real weight) const { return 0.5 * normal * weight * gap * gap; }

  void validate() const {
    require::positive(normal, "augmented Lagrangian: the normal stiffness");
    require::not_negative(tangential, "augmented Lagrangian: the tangential stiffness");
  }
};

}  // namespace stickslip
