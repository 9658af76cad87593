// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/base/role.hpp>
#include <stickslip/tensor/tensor.hpp>

namespace stickslip {

/// Plane strain: no stretch normal to the plane. Forces are those of a slab of the given thickness.
struct PlaneStrain {
  using Role = role::Kinematics;
  using TensorPattern = Planar;
  static constexpr int dim = 2;
  static constexpr bool hoop = false;

  Real thickness = 1;  ///< [length]

  /// Extent normal to the plane at reference point X: volume per area of the section [length].
  Real volume_factor(const Vec<Real, 2>&) const { return thickness; }

  void validate() const { require::positive(thickness, "plane strain: the thickness"); }
};

}  // namespace stickslip
