// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/damping.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Damping in proportion to the stiffness: forces tau (G(u_{n+1}) - G(u_n)) / dt beside the internal ones G (theory.md,
/// eq. 7.15). A vibration of angular frequency omega is damped by tau omega / 2 of critical; in plastic flow the
/// elastic part of the strain rate alone is. For rotations that are small while the body is stressed.
struct StiffnessDamping {
  using Role = role::Damping;
  static constexpr bool active = true;

  Real tau = 0;  ///< time constant [time]

  void validate() const {
    if (!(tau > 0) || !std::isfinite(tau))
      throw std::invalid_argument("stiffness damping: the time constant tau must be positive");
  }
};

}  // namespace stickslip
