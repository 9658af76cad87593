// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>

namespace stickslip {

/// A relation so stiff that a small error of the displacements makes a large force: the pressure of a penalty and the
/// dilatation of an element. An iteration carries the quantity as a variable of its own, which follows its linear
/// solutions, and closes the relation only as it converges (theory.md, section 6.4). `n` components of displacement
/// enter.
template <class S, int n>
struct CondensedUnknown {
  S value = S(0);                          ///< of the variable
  S residual = S(0);                       ///< what the displacements ask for, less the value
  Vec<S, n> gradient = Vec<S, n>::Zero();  ///< derivative of what the displacements ask for
  Vec<S, n> force = Vec<S, n>::Zero();     ///< that closing the constraint adds, to first order [force]

  /// Drops a constraint residual no larger than the round-off of what the displacements ask for: the value has more
  /// digits then (theory.md, section 6.4).
  void forget(Real roundoff) {
    if (!(std::abs(value_of(residual)) <= roundoff)) return;
    residual = S(0);
    force.setZero();
  }
};

}  // namespace stickslip
