// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/reference_cell.hpp>

#include <array>

namespace stickslip {

/// Bilinear quadrilateral on [-1, 1]^2, nodes counter-clockwise from (-1, -1), 2 x 2 Gauss points.
struct Quad4 {
  static constexpr int dim = 2;
  static constexpr int nodes = 4;
  static constexpr int points = 4;
  static constexpr std::array<std::array<Real, 2>, 4> corner{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

  static Vec<Real, nodes> shape(const Vec<Real, dim>& xi) {
    Vec<Real, nodes> N;
    for (int a = 0; a < nodes; ++a)
      N[a] = 0.25 * (1 + corner[std::size_t(a)][0] * xi[0]) * (1 + corner[std::size_t(a)][1] * xi[1]);
    return N;
  }
  /// d N_a / d xi_j.
  static Mat<Real, nodes, dim> gradient(const Vec<Real, dim>& xi) {
    Mat<Real, nodes, dim> g;
    for (int a = 0; a < nodes; ++a) {
      const auto& c = corner[std::size_t(a)];
      g(a, 0) = 0.25 * c[0] * (1 + c[1] * xi[1]);
      g(a, 1) = 0.25 * c[1] * (1 + c[0] * xi[0]);
    }
    return g;
  }
  static std::array<QuadraturePoint<dim>, points> quadrature() { return two_point_gauss(corner); }
};

}  // namespace stickslip
