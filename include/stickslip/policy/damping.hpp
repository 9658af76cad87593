// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// Damping that is there: its time constant.
template <class D>
concept ActiveDamping = requires(const D& damping) {
  { damping.tau } -> std::convertible_to<Real>;
};

/// Whether the body of a model with inertia damps its own vibrations. docs/policies.md, section Damping.
template <class D>
concept DampingPolicy = requires {
  requires std::same_as<typename D::Role, role::Damping>;
  requires std::same_as<decltype(D::active), const bool>;
  requires !D::active || ActiveDamping<D>;
};

/// No damping: what a model has that names none.
struct Undamped {
  using Role = role::Damping;
  static constexpr bool active = false;
};

}  // namespace stickslip
