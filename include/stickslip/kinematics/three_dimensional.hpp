// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/tensor/tensor.hpp>

namespace stickslip {

/// Three dimensions: the deformation gradient has all nine components.
struct ThreeDimensional {
  using Role = role::Kinematics;
  using TensorPattern = Spatial;
  static constexpr int dim = 3;
  static constexpr bool hoop = false;

  /// Volume per volume of the mesh: one [-].
  Real volume_factor(const Vec<Real, 3>&) const { return 1; }
};

}  // namespace stickslip
