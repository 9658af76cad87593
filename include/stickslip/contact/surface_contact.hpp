// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/surface_pair.hpp>
#include <stickslip/policy/surfaces.hpp>

namespace stickslip {

/// Contact between surfaces of bodies, and of a body with itself: `using Surfaces = SurfaceContact<QuasiCoulomb>;` in
/// the model, and a list `.surfaces` in the problem. The model's Enforcement is theirs as well. In the plane and in
/// axisymmetry. docs/policies.md, section Surface contact.
template <class Friction_>
struct SurfaceContact {
  using Role = role::Surfaces;
  using Friction = Friction_;
  static constexpr bool active = true;
  template <class Model>
  using Pair = SurfacePair<Model, Friction>;
};

}  // namespace stickslip
