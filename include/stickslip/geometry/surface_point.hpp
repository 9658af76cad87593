// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>

namespace stickslip {

/// A point seen from a tool's surface: its signed distance, the surface coordinates of its closest point and their
/// derivatives by the point's position, all in the tool's frame (theory.md, eq. 4.1-4.3).
template <class S, int dim>
struct SurfacePoint {
  S gap = S(0);                                                           ///< negative in penetration [length]
  Vec<S, dim> normal = Vec<S, dim>::Zero();                               ///< grad gap: outward from the tool
  Mat<S, dim> hess_gap = Mat<S, dim>::Zero();                             ///< [1/length]
  Vec<S, dim - 1> place = Vec<S, dim - 1>::Zero();                        ///< arc length on the tool [length]
  Mat<S, dim, dim - 1> grad_place = Mat<S, dim, dim - 1>::Zero();         ///< one column a coordinate [-]
  std::array<Mat<S, dim>, static_cast<std::size_t>(dim - 1)> hess_place;  ///< one matrix a coordinate [1/length]

  SurfacePoint() {
    for (auto& h : hess_place) h.setZero();
  }
};

}  // namespace stickslip
