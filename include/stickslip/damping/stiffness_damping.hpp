// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/damping.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Stiffness-proportional damping: forces tau (G(u_{n+1}) - G(u_n)) / dt in addition to the internal forces G
/// (theory.md, eq. 7.16). The damping ratio of a vibration of angular frequency omega is tau omega / 2; in plastic flow
/// only the elastic part of the strain rate is damped. Valid if rotations are small while the body is stressed.
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
