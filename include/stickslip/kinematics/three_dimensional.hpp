// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/tensor/tensor.hpp>

namespace stickslip {

/// Three dimensions: the mesh fills the space, nothing is assumed of the deformation gradient.
struct ThreeDimensional {
  using Role = role::Kinematics;
  using Shape = Spatial;
  static constexpr int dim = 3;
  static constexpr bool hoop = false;

  /// Volume per volume of the mesh: one.
  Real measure(const Vec<Real, 3>&) const { return 1; }
};

}  // namespace stickslip
