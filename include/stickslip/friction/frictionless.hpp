// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>

namespace stickslip {

/// No friction: no slip bound, no memory, no tangential forces.
struct Frictionless {
  using Role = role::Friction;
  static constexpr bool active = false;
  using Law = Frictionless;
};

}  // namespace stickslip
