// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>

namespace stickslip {

/// A quadrature point of a reference cell.
template <int dim>
struct QuadraturePoint {
  Vec<Real, dim> xi;
  Real weight;
};

/// Two-point Gauss rule in each direction on [-1, 1]^dim; point a lies towards corner a.
template <std::size_t dim, std::size_t points>
std::array<QuadraturePoint<static_cast<int>(dim)>, points> two_point_gauss(
    const std::array<std::array<Real, dim>, points>& corner) {
  std::array<QuadraturePoint<static_cast<int>(dim)>, points> rule;
  for (std::size_t a = 0; a < points; ++a) {
    rule[a].weight = 1;
    for (std::size_t i = 0; i < dim; ++i)
      rule[a].xi[static_cast<int>(i)] = std::numbers::inv_sqrt3_v<Real> * corner[a][i];
  }
  return rule;
}

}  // namespace stickslip
