// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>
#include <type_traits>

namespace stickslip {

/// A relation so stiff that a small error of the displacements makes a large force: the pressure of a penalty and the
/// dilatation of an element. An iteration carries the quantity as a variable of its own, which follows its linear
/// solutions, and closes the relation only as it converges (theory.md, section 6.4). `n` components of displacement
/// enter. With `m` of them at one place the value is a vector, and the gradient has a column for each.
template <class S, int n, int m = 1>
struct CondensedUnknown {
  using Value = std::conditional_t<m == 1, S, Vec<S, m>>;
  Value value = zero();                          ///< of the variable
  Value residual = zero();                       ///< what the displacements ask for, less the value
  Mat<S, n, m> gradient = Mat<S, n, m>::Zero();  ///< derivative of what the displacements ask for
  Vec<S, n> force = Vec<S, n>::Zero();           ///< that closing the constraint adds, to first order [force]

  /// Drops a constraint residual no larger than the round-off of what the displacements ask for: the value has more
  /// digits then (theory.md, section 6.4).
  void forget(Real roundoff) requires(m == 1) {
    if (!(std::abs(value_of(residual)) <= roundoff)) return;
    residual = S(0);
    force.setZero();
  }

  static Value zero() {
    if constexpr (m == 1)
      return S(0);
    else
      return Value::Zero();
  }
};

/// Whether the relation of condensed unknowns is closed, their values being those of the displacements, or open, their
/// values being given. A closed relation may need a start for its solution: the value that it finds, and replaces.
enum class Relation : bool { closed, open };

}  // namespace stickslip
