// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/element.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace stickslip {

/// What AssumedStrain keeps of the reference mesh (theory.md, eq. 2.14-2.16): its mean gradient and hourglass vectors,
/// and at the points how its assumed strains, its stretches and its dilatation vary.
template <class Kinematics, class Cell>
struct AssumedStrainGeometry {
  static constexpr int dim = Cell::dim, nodes = Cell::nodes, points = Cell::points;
  static constexpr int modes = nodes - dim - 1;  ///< products of reference coordinates in the shape functions

  struct Point {
    Mat<Real, modes, dim> q;        ///< g_j . grad h_I', by mode I and direction j [-]
    Vec<Real, dim> stretch;         ///< phi_j |g_j|^2 [length^2]
    Vec<Real, dim + 1> dilatation;  ///< chi_k over the root of its mean square [-]
    [[no_unique_address]] StoredIf<Kinematics::hoop, Vec<Real, nodes>, struct HoopTag>
        N_over_R;  ///< hoop operator [1/length]
    Real weight;   ///< reference volume that the point stands for [length^3]
    Real share;    ///< of the element's volume [-]
  };

  Mat<Real, nodes, dim> gradient;     ///< <grad N_a> . g_j [-]
  Mat<Real, nodes, modes> hourglass;  ///< gamma_Ia [-]
  Mat<Real, dim> base;                ///< columns g_j: derivatives of the place at the centre [length]
  Mat<Real, dim> dual;                ///< its inverse, rows g^j [1/length]
  Real steepest = 0;                  ///< largest component of a shape function's gradient [1/length]
  std::array<Point, points> at;

  const Point& operator[](std::size_t p) const { return at[p]; }

  AssumedStrainGeometry() = default;
  /// From the nodes' reference coordinates, one row a node [length].
  AssumedStrainGeometry(const Kinematics& kinematics, const Mat<Real, nodes, dim>& X) {
    const Vec<Real, dim> centre = Vec<Real, dim>::Zero();
    base = transposed_product(X, Cell::gradient(centre));
    Real det;
    dual = inverse(base, det);
    const auto rule = Cell::quadrature();
    std::array<Mat<Real, nodes, dim>, points> along;  // grad N_a . g_j
    gradient.setZero();
    Real volume = 0;
    for (std::size_t p = 0; p < points; ++p) {
      const auto plain = point_geometry<Kinematics, Cell>(kinematics, X, rule[p].xi, rule[p].weight);
      at[p].weight = plain.weight;
      if constexpr (Kinematics::hoop) at[p].N_over_R = plain.N_over_R;
      along[p] = product(plain.dN_dX, base);
      steepest = std::max(steepest, plain.dN_dX.cwiseAbs().maxCoeff());
      volume += plain.weight;
      add(gradient, along[p], plain.weight);
    }
    gradient = scaled(gradient, 1 / volume);
    for (Point& point : at) point.share = point.weight / volume;

    Mat<Real, nodes, modes> h;
    for (int a = 0; a < nodes; ++a) h.row(a) = products(Cell::corner[static_cast<std::size_t>(a)]);
    hourglass = hourglass_vectors<nodes, dim, modes>(h, Cell::gradient(centre), dual, X);

    // The variation of h_I: grad N_a - <grad N_a> = sum_I gamma_Ia grad h_I', and h^T gamma = 1.
    for (std::size_t p = 0; p < points; ++p) at[p].q = transposed_product(h, minus(along[p], gradient));

    Vec<Real, dim> mean = Vec<Real, dim>::Zero();
    std::array<Vec<Real, dim>, points> phi;
    for (std::size_t p = 0; p < points; ++p) {
      const Mat<Real, dim> jacobian = transposed_product(X, Cell::gradient(rule[p].xi));
      Real det_here;
      inverse(jacobian, det_here);
      phi[p] = scaled(rule[p].xi, det / det_here);
      add(mean, phi[p], at[p].share);
    }
    for (std::size_t p = 0; p < points; ++p) {
      add(phi[p], mean, -1.);
      for (int j = 0; j < dim; ++j) at[p].stretch[j] = phi[p][j] * base.col(j).squaredNorm();
      at[p].dilatation[0] = 1;
      for (int j = 0; j < dim; ++j) at[p].dilatation[j + 1] = phi[p][j];
    }
    for (int k = 1; k <= dim; ++k) {
      for (int l = 0; l < k; ++l) {
        Real share = 0;
        for (const Point& point : at) share += point.share * point.dilatation[k] * point.dilatation[l];
        for (Point& point : at) point.dilatation[k] -= share * point.dilatation[l];
      }
      Real square = 0;
      for (const Point& point : at) square += point.share * point.dilatation[k] * point.dilatation[k];
      for (Point& point : at) point.dilatation[k] /= std::sqrt(square);
    }
  }

 private:
  // h_I at reference coordinates.
  static Mat<Real, 1, modes> products(const std::array<Real, dim>& xi) {
    if constexpr (dim == 2)
      return Mat<Real, 1, modes>(xi[0] * xi[1]);
    else
      return {xi[1] * xi[2], xi[2] * xi[0], xi[0] * xi[1], xi[0] * xi[1] * xi[2]};
  }
};

}  // namespace stickslip
