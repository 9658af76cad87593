// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/policy/enforcement.hpp>

namespace stickslip {

/// Penalty method: t_N = eps_C g in penetration (paper, eq. 5), eps_F is the tangential penalty in stick (eq. 12).
struct Penalty {
  using Role = role::Enforcement;
  static constexpr bool active = true;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real normal = 0;      ///< eps_C [force / length, per `per`]
  Real tangential = 0;  ///< eps_F [force / length, per `per`]
  PenaltyPer per = PenaltyPer::unit_depth;

  template <class S>
  struct Memory {};

  /// Normal force t_N [force] (theory.md, eq. 4.4), continued smoothly to the positive gaps of iterates.
  template <class S>
  NormalForce<S> normal_force(const S& gap, Real weight, const Memory<S>&) const {
    return {gap * (normal * weight), S(normal * weight)};
  }
  Real stick_stiffness(Real weight) const { return tangential * weight; }
  /// Energy stored in a penetration (theory.md, eq. 4.5).
  Real energy(Real gap, Real weight) const { return 0.5 * normal * weight * gap * gap; }

  void validate() const {
    require::positive(normal, "penalty: the normal stiffness");
    require::not_negative(tangential, "penalty: the tangential stiffness");
  }
};

}  // namespace stickslip
