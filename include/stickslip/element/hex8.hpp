// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/reference_cell.hpp>

#include <array>

namespace stickslip {

/// Trilinear hexahedron on [-1, 1]^3, nodes counter-clockwise from (-1, -1, -1) viewed from +xi_3, the lower face
/// first, 2 x 2 x 2 Gauss points.
struct Hex8 {
  static constexpr int dim = 3;
  static constexpr int nodes = 8;
  static constexpr int points = 8;
  static constexpr std::array<std::array<Real, 3>, 8> corner{
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

  static Vec<Real, nodes> shape(const Vec<Real, dim>& xi) {
    Vec<Real, nodes> N;
    for (int a = 0; a < nodes; ++a) {
      const auto& c = corner[std::size_t(a)];
      N[a] = 0.125 * (1 + c[0] * xi[0]) * (1 + c[1] * xi[1]) * (1 + c[2] * xi[2]);
    }
    return N;
  }
  /// d N_a / d xi_j.
  static Mat<Real, nodes, dim> gradient(const Vec<Real, dim>& xi) {
    Mat<Real, nodes, dim> g;
    for (int a = 0; a < nodes; ++a) {
      const auto& c = corner[std::size_t(a)];
      const Real x = 1 + c[0] * xi[0], y = 1 + c[1] * xi[1], z = 1 + c[2] * xi[2];
      g(a, 0) = 0.125 * c[0] * y * z;
      g(a, 1) = 0.125 * c[1] * z * x;
      g(a, 2) = 0.125 * c[2] * x * y;
    }
    return g;
  }
  static std::array<QuadraturePoint<dim>, points> quadrature() { return two_point_gauss(corner); }
};

}  // namespace stickslip
