// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/friction.hpp>

namespace stickslip {

/// The normal force of the iterate: exact, and the tangent of a sliding node is not symmetric.
struct CurrentPressure {
  using Role = role::PressureSource;
  static constexpr bool follows_current = true;
  template <class S>
  struct Memory {};
  template <class S>
  static S pressure(const S& current, const Memory<S>&) {
    return current;
  }
  template <class S>
  static Memory<S> advance(const S&, const Memory<S>&, Real) {
    return {};
  }
};

/// The normal force at the last converged step (paper, eq. 20 and 21): a symmetric tangent, and a bound that lags one
/// step behind. At first contact it is zero, so a node slides freely in the step that brings it into contact.
struct LastConverged {
  using Role = role::PressureSource;
  static constexpr bool follows_current = false;
  template <class S>
  struct Memory {
    S pressure = S(0);  ///< [force]
  };
  template <class S>
  static S pressure(const S&, const Memory<S>& memory) {
    return memory.pressure;
  }
  template <class S>
  static Memory<S> advance(const S& current, const Memory<S>&, Real) {
    return {current};
  }
};

/// Any friction law with its pressure taken from the last converged step.
template <class Law>
using Quasi = WithPressure<Law, LastConverged>;

}  // namespace stickslip
