// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/policy/friction.hpp>

#include <concepts>

namespace stickslip {

/// Contact between surfaces that is there: its friction.
template <class P>
concept ActiveSurfaces = SingleFriction<typename P::Friction>;

/// Whether the bodies of a model touch each other and themselves, and with which friction. The disjunction stands
/// outside `requires`, inside which Clang 14 does not stop at the first operand. docs/policies.md, section Surface
/// contact.
template <class P>
concept SurfacesPolicy = requires {
  requires std::same_as<typename P::Role, role::Surfaces>;
  requires std::same_as<decltype(P::active), const bool>;
}
&&(!P::active || ActiveSurfaces<P>);

/// Bodies touch tools alone: what a model has that names no surfaces.
struct NoSurfaceContact {
  using Role = role::Surfaces;
  static constexpr bool active = false;
};

}  // namespace stickslip
