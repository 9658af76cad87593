// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>

namespace stickslip {

/// No inertia: no mass, velocity or acceleration is stored.
struct Quasistatic {
  using Role = role::TimeIntegration;
  static constexpr bool active = false;
};

}  // namespace stickslip
