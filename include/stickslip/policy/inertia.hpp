// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// Whether and how inertia enters the balance. docs/policies.md, section Inertia.
template <class I>
concept InertiaPolicy = requires {
  requires std::same_as<typename I::Role, role::Inertia>;
  requires std::same_as<decltype(I::active), const bool>;
};

}  // namespace stickslip
