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
  static S pressure(const S& current, const Memory<S>&, Real) {
    return current;
  }
  template <class S>
  static Memory<S> advance(const S&, const Memory<S>&, Real) {
    return {};
  }
};

/// The normal force of the iterate in the residual, and the symmetric tangent of one that stays as it is: the exact
/// answer by symmetric systems, with what they lack found out by differences of the residual (theory.md, section 5.9).
struct Symmetrised : CurrentPressure {
  static constexpr bool symmetrised = true;
};

/// The normal force at the last converged step (paper, eq. 20 and 21): a symmetric tangent, and a bound that lags one
/// step behind. First contacts that bear much take the step's own pressure (theory.md, eq. 5.33).
struct LastConverged {
  using Role = role::PressureSource;
  static constexpr bool follows_current = false;
  static constexpr Real stable_below = 1;  ///< kappa of theory.md, eq. 5.14
  template <class S>
  struct Memory {
    S pressure = S(0);  ///< [force]
  };
  template <class S>
  static S pressure(const S&, const Memory<S>& memory, Real) {
    return memory.pressure;
  }
  template <class S>
  static Memory<S> advance(const S& current, const Memory<S>&, Real) {
    return {current};
  }
  template <class S>
  static Memory<S> seeing(const S& pressure) {
    return {pressure};
  }
};

/// The normal force that the last two converged steps foretell, linear in time and between zero and twice the last one
/// (theory.md, eq. 5.24): a symmetric tangent, and a bound that lags at second order in the step. A node that one step
/// alone knows of has no trend: after its first contact the last converged force is taken.
struct Extrapolated {
  using Role = role::PressureSource;
  static constexpr bool follows_current = false;
  static constexpr Real stable_below = 1.0 / 3;  ///< kappa of theory.md, eq. 5.15
  static constexpr int lag_order = 2;            ///< of the bound's error in the step
  template <class S>
  struct Memory {
    S pressure = S(0);  ///< [force]
    S trend = S(0);     ///< (p_n - p_{n-1}) / dt_n [force / time]
  };
  template <class S>
  static S pressure(const S&, const Memory<S>& memory, Real dt) {
    const S ahead = memory.pressure + memory.trend * dt, most = memory.pressure * 2;
    return value_of(ahead) < 0 ? S(0) : value_of(ahead) < value_of(most) ? ahead : most;
  }
  template <class S>
  static Memory<S> advance(const S& current, const Memory<S>& memory, Real dt) {
    const bool known = value_of(memory.pressure) > 0 && dt > 0;
    return {current, known ? S((current - memory.pressure) / dt) : S(0)};
  }
  template <class S>
  static Memory<S> seeing(const S& pressure) {
    return {pressure, S(0)};
  }
};

/// The normal force of the last pass over the step: a symmetric tangent in each pass, and the current pressure's answer
/// when the passes have converged (theory.md, section 5.8). With multipliers (AugmentedLagrangian) it is the multiplier
/// of the current augmentation: the symmetric method of Simo & Laursen (1992).
struct LagIterated : LastConverged {
  static constexpr bool iterated = true;
};

/// Any friction law with its pressure taken from the last converged step.
template <class Law>
using Quasi = WithPressure<Law, LastConverged>;

}  // namespace stickslip
