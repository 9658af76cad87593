// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/friction.hpp>

namespace stickslip {

/// Normal force of the current iterate: the slip bound is exact, the tangent of a slipping node not symmetric.
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

/// Normal force of the current iterate in the residual, but the symmetric tangent of a constant normal force: exact
/// results by symmetric systems, with the missing coupling from differences of the residual (theory.md, section 5.9).
struct Symmetrised : CurrentPressure {
  static constexpr bool symmetrised = true;
};

/// Normal force at the last converged step (paper, eq. 20 and 21): the tangent is symmetric, and the slip bound lags by
/// one step. First contacts take that of the current step (theory.md, eq. 5.11).
struct LastConverged {
  using Role = role::PressureSource;
  static constexpr bool follows_current = false;
  static constexpr Real critical_feedback = 1;  ///< kappa of theory.md, eq. 5.15
  template <class S>
  struct Memory {
    S pressure = S(0);  ///< [force]

    template <class Self, class Visit>
    static constexpr void members(Self& self, Visit&& visit) {
      visit("pressure", self.pressure);
    }
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
  static Memory<S> from_pressure(const S& pressure) {
    return {pressure};
  }
};

/// Normal force extrapolated linearly in time from the last two converged steps, between zero and twice the last value
/// (theory.md, eq. 5.26): the tangent is symmetric, and the lag of the slip bound is of second order in the step size.
/// In the step after a first contact there is no trend yet: the last converged force is taken.
struct Extrapolated {
  using Role = role::PressureSource;
  static constexpr bool follows_current = false;
  static constexpr Real critical_feedback = 1.0 / 3;  ///< kappa of theory.md, eq. 5.17
  static constexpr int lag_order = 2;                 ///< order of the slip bound's error in the step size
  template <class S>
  struct Memory {
    S pressure = S(0);  ///< [force]
    S trend = S(0);     ///< (p_n - p_{n-1}) / dt_n [force / time]

    template <class Self, class Visit>
    static constexpr void members(Self& self, Visit&& visit) {
      visit("pressure", self.pressure);
      visit("trend", self.trend);
    }
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
  static Memory<S> from_pressure(const S& pressure) {
    return {pressure, S(0)};
  }
};

/// Normal force of the last outer iteration: the tangent is symmetric in each of them, and the converged solution is
/// that of the current pressure (theory.md, section 5.8). With AugmentedLagrangian it is the multiplier of the current
/// augmentation: the symmetric method of Simo & Laursen (1992).
struct LagIterated : LastConverged {
  static constexpr bool iterated = true;
};

/// Any friction law at the pressure of the last converged step.
template <class Law>
using Quasi = WithPressure<Law, LastConverged>;

}  // namespace stickslip
