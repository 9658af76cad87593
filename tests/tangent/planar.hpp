// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/verify/material.hpp>

using F2 = stickslip::Tensor<stickslip::Real, stickslip::Planar>;

/// A deformation gradient of the plane by its components.
inline F2 gradient(stickslip::Real f11, stickslip::Real f12, stickslip::Real f21, stickslip::Real f22,
                   stickslip::Real f33) {
  F2 F;
  F.v << f11, f12, f21, f22, f33;
  return F;
}
