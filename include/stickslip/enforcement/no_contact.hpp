// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>

namespace stickslip {

/// No tools in the scene: no contact memory, no contact forces.
struct NoContact {
  using Role = role::Enforcement;
  static constexpr bool active = false;
};

}  // namespace stickslip
