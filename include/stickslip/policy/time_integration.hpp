// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// Weights of the generalised-alpha family (theory.md, eq. 7.2-7.4): inertia is balanced at t_{n+1} - alpha_m dt, all
/// other forces at t_{n+1} - alpha_f dt; beta and gamma are Newmark's.
struct TimeScheme {
  Real alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;
};

/// Inertia that is there: a time scheme, and whether the mass is lumped.
template <class I>
concept ActiveTimeIntegration = requires(const I& inertia) {
  { inertia.lumped } -> std::convertible_to<bool>;
  { inertia.scheme } -> std::convertible_to<TimeScheme>;
};

/// Whether and how inertia enters the balance. docs/policies.md, section Time integration.
template <class I>
concept TimeIntegrationPolicy = requires {
  requires std::same_as<typename I::Role, role::TimeIntegration>;
  requires std::same_as<decltype(I::active), const bool>;
  requires !I::active || ActiveTimeIntegration<I>;
};

}  // namespace stickslip
