// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/contact.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stickslip {

/// The outer iterations of a step: multipliers and lagging bounds are numbers within one and change from one to the
/// next (theory.md, section 5.8).
template <class Pairs>
class OuterIteration {
 public:
  explicit OuterIteration(Pairs& pairs) : pairs_(pairs) {}

  /// How far the last one is from what another one would give [-]. With `motion`, a function of the pair that gives the
  /// largest motion of a node in the step, gaps of multipliers are measured against that [length].
  template <class Motion>
  Real residual(Motion&& motion) {
    Real largest = 0;
    for_each_outer(pairs_, [&](auto& pair) { largest = std::max(largest, pair.outer_residual(motion(pair))); });
    return largest;
  }
  /// Starts the next one from where the last one ended. Multipliers settle by a factor that falls with the stiffness,
  /// so where a residual has not fallen to a quarter the penalties are scaled: no value of theirs need be asked for.
  void next(Real residual) {
    if (before_ > 0 && residual > 0.25 * before_)
      for_each_outer(pairs_, [](auto& pair) {
        if constexpr (is_augmented<typename std::remove_cvref_t<decltype(pair)>::Enforcement>) pair.scale_penalty(4);
      });
    before_ = residual;
    for_each_outer(pairs_, [](auto& pair) { pair.next_augmentation(); });
  }
  /// Goes a smaller part of the way of the last `next`; false when there is nothing left of it, or no bound to update.
  bool backtrack() {
    bool held = false;
    for_each_outer(pairs_, [&](auto& pair) { held = pair.backtrack() || held; });
    return held;
  }

 private:
  Pairs& pairs_;
  Real before_ = 0;
};

/// A probe of lagging bounds in a converged state: how much the pressures answer to a change of the bounds by what they
/// lag behind. The bounds go back when the probe ends.
template <class Pairs>
class LagProbe {
 public:
  explicit LagProbe(Pairs& pairs)
      : pairs_(pairs), lag_(norm([](auto& pair) { return pair.lag_increment().squaredNorm(); })) {}
  LagProbe(const LagProbe&) = delete;
  LagProbe& operator=(const LagProbe&) = delete;
  ~LagProbe() {
    for_each_lagging(pairs_, [](auto& pair) { pair.end_probe(); });
  }
  /// Norm of the differences of the pressures and those that the bounds are of [force].
  Real lag() const { return lag_; }
  /// Moves the bounds by a part of that.
  void perturb_bound(Real part) {
    for_each_lagging(pairs_, [&](auto& pair) { pair.perturb_bound(part); });
  }
  /// Norm of what the pressures have changed by since the probe began [force].
  Real pressure_response() const {
    return norm([](auto& pair) { return pair.pressure_response_squared(); });
  }
  /// The least feedback at which the lag of a pair no longer settles [-].
  Real critical_feedback() const {
    Real least = std::numeric_limits<Real>::infinity();
    for_each_lagging(pairs_, [&](auto& pair) {
      least = std::min(least, std::remove_cvref_t<decltype(pair)>::Friction::Pressure::critical_feedback);
    });
    return least;
  }

 private:
  template <class Square>
  Real norm(Square&& square) const {
    Real sum = 0;
    for_each_lagging(pairs_, [&](auto& pair) { sum += square(pair); });
    return std::sqrt(sum);
  }
  Pairs& pairs_;
  Real lag_;
};

}  // namespace stickslip
