// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/symmetry.hpp>
#include <stickslip/policy/element.hpp>

namespace stickslip {

/// Gradient operator B of a quadrature point, delta F = B delta u, applied matrix-free (theory.md, eq. 2.3).

/// Displacement gradient H = B u [-] for the nodal displacements u of the element [length].
template <class Kinematics, int nodes, class S>
Tensor<S, typename Kinematics::TensorPattern> displacement_gradient(const PointGeometry<Kinematics, nodes>& point,
                                                                    const Vec<S, nodes * Kinematics::dim>& u) {
  constexpr int dim = Kinematics::dim;
  Tensor<S, typename Kinematics::TensorPattern> H;
  for (int a = 0; a < nodes; ++a) {
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J) H(i, J) += u[a * dim + i] * point.dN_dX(a, J);
    if constexpr (Kinematics::hoop) H(2, 2) += u[a * dim] * point.N_over_R[a];
  }
  return H;
}

/// F = I + B u.
template <class Kinematics, int nodes, class S>
Tensor<S, typename Kinematics::TensorPattern> deformation_gradient(const PointGeometry<Kinematics, nodes>& point,
                                                                   const Vec<S, nodes * Kinematics::dim>& u) {
  return plus_one(displacement_gradient(point, u));
}

/// Nodal forces B^T P, work-conjugate to u.
template <class Kinematics, int nodes, class S>
Vec<S, nodes * Kinematics::dim> internal_force(const PointGeometry<Kinematics, nodes>& point,
                                               const Tensor<S, typename Kinematics::TensorPattern>& P) {
  constexpr int dim = Kinematics::dim;
  Vec<S, nodes * dim> r;
  for (int a = 0; a < nodes; ++a) {
    for (int i = 0; i < dim; ++i) {
      S sum = P(i, 0) * point.dN_dX(a, 0);
      for (int J = 1; J < dim; ++J) sum += P(i, J) * point.dN_dX(a, J);
      r[a * dim + i] = sum;
    }
    if constexpr (Kinematics::hoop) r[a * dim] += P(2, 2) * point.N_over_R[a];
  }
  return r;
}

/// K += B^T M B; for a symmetric M only the lower triangle.
template <Symmetry symmetry, class Kinematics, int nodes, class S>
void add_BtMB(const PointGeometry<Kinematics, nodes>& point, const Moduli<S, typename Kinematics::TensorPattern>& M,
              Mat<S, nodes * Kinematics::dim>& K) {
  using TensorPattern = typename Kinematics::TensorPattern;
  constexpr int dim = Kinematics::dim;
  for (int b = 0; b < nodes; ++b)
    for (int k = 0; k < dim; ++k) {
      // Eigen's product, not a loop: it saves a twentieth of the element's time in three dimensions.
      Vec<S, TensorPattern::size> column = M.col(TensorPattern::at(k, 0)) * S(point.dN_dX(b, 0));
      for (int L = 1; L < dim; ++L) column += M.col(TensorPattern::at(k, L)) * S(point.dN_dX(b, L));
      if constexpr (Kinematics::hoop)
        if (k == 0) column += M.col(TensorPattern::at(2, 2)) * S(point.N_over_R[b]);
      for (int a = symmetry == Symmetry::symmetric ? b : 0; a < nodes; ++a) {
        for (int i = 0; i < dim; ++i) {
          S sum = point.dN_dX(a, 0) * column[TensorPattern::at(i, 0)];
          for (int J = 1; J < dim; ++J) sum += point.dN_dX(a, J) * column[TensorPattern::at(i, J)];
          K(a * dim + i, b * dim + k) += sum;
        }
        if constexpr (Kinematics::hoop) K(a * dim, b * dim + k) += point.N_over_R[a] * column[TensorPattern::at(2, 2)];
      }
    }
}

/// K += left right^T; for a symmetric sum only the lower triangle.
template <Symmetry symmetry, int n, class S>
void add_dyad(const Vec<S, n>& left, const Vec<S, n>& right, Mat<S, n>& K) {
  for (int j = 0; j < n; ++j)
    for (int i = symmetry == Symmetry::symmetric ? j : 0; i < n; ++i) K(i, j) += left[i] * right[j];
}

/// Copies the lower triangle of K into the upper one. Through a copy: GCC 12.2 at -O2 miscompiles the loop in place.
template <int n, class S>
void copy_lower_to_upper(Mat<S, n>& K) {
  const Mat<S, n> lower = K;
  for (int j = 1; j < n; ++j)
    for (int i = 0; i < j; ++i) K(i, j) = lower(j, i);
}

}  // namespace stickslip
