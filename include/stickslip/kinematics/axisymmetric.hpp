// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/tensor/tensor.hpp>

namespace stickslip {

/// Axisymmetry without torsion: coordinate 0 is the radius, coordinate 1 the axis. The hoop stretch is r/R. Forces are
/// those of the full circumference.
struct Axisymmetric {
  using Role = role::Kinematics;
  using TensorPattern = Planar;
  static constexpr int dim = 2;
  static constexpr bool hoop = true;

  /// Circumference at reference point X: volume of the full circumference per area of the section [length].
  Real volume_factor(const Vec<Real, 2>& X) const { return 2 * pi * X[0]; }
};

}  // namespace stickslip
