// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/dofs.hpp>
#include <stickslip/base/types.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace stickslip {

/// The motions of a body, where its nodal displacements have brought it, as if it were rigid: shifts, then turns about
/// its centre by its extent's worth; in axisymmetry the shift along the axis alone.
template <class Kinematics>
class RigidMotions {
 public:
  static constexpr int dim = Kinematics::dim;
  static constexpr int count = Kinematics::hoop ? 1 : dim + dim * (dim - 1) / 2;

  RigidMotions(const std::vector<Vec<Real, dim>>& nodes, const Field& u) {
    Vec<Real, dim> centre = Vec<Real, dim>::Zero();
    for (const auto& X : nodes) centre += X / Real(nodes.size());
    for (const auto& X : nodes) extent_ = std::max(extent_, (X - centre).norm());
    motions_.assign(count, Field::Zero(u.size()));
    for (Index c = 0; c < u.size(); ++c) {
      const Index n = c / dim;
      const int i = c % dim;
      if constexpr (Kinematics::hoop) {
        motions_[0][c] = i == dim - 1 ? 1 : 0;
      } else {
        const auto at = [&](int k) {
          return (nodes[static_cast<std::size_t>(n)][k] + u[n * dim + k] - centre[k]) / extent_;
        };
        motion(i)[c] = 1;
        for (int k = dim; k < count; ++k) {
          const int p = dim == 2 ? 0 : (k - 2) % 3, q = dim == 2 ? 1 : (k - 1) % 3;  // the plane it turns
          motion(k)[c] = i == p ? -at(q) : i == q ? at(p) : 0;
        }
      }
    }
  }

  /// Largest distance of a node from the centre [length].
  Real extent() const { return extent_; }

  /// Those of their combinations, an orthonormal nodal field each, that neither supports nor the matrix K resist: the
  /// kernel of r.K r / `stiffness` + c.c, r their unknown and c their constrained components, to `least`.
  std::vector<Field> unresisted(const Dofs& dofs, const SparseView& matrix, Real stiffness, Real least) const {
    // Of sizes known at run time alone, and entry by entry: quick to compile, and done once in a scene.
    Eigen::MatrixXd resistance = Eigen::MatrixXd::Zero(count, count);
    const auto resist = [&](Index a, Real value, Index b) {
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) resistance(i, j) += motion(i)[a] * value * motion(j)[b];
    };
    for (Index c = 0; c < dofs.components(); ++c)
      if (dofs.equation(c) == Dofs::constrained) resist(c, 1, c);
    for (Index j = 0; j < matrix.size; ++j) {
      const Index b = dofs.component(j);
      for (Index s = matrix.column_start[j]; s < matrix.column_start[j + 1]; ++s) {
        const Index a = dofs.component(matrix.row[s]);
        resist(a, matrix.values[s] / stiffness, b);
        if (matrix.symmetry == Symmetry::symmetric && a != b) resist(b, matrix.values[s] / stiffness, a);
      }
    }
    Eigen::FullPivLU<Eigen::MatrixXd> lu(resistance);
    if (lu.maxPivot() > 0) lu.setThreshold(least / lu.maxPivot());
    std::vector<Field> free;
    if (lu.dimensionOfKernel() == 0) return free;
    const Eigen::MatrixXd kernel = lu.kernel();
    for (Index j = 0; j < kernel.cols(); ++j) {
      Field r = Field::Zero(dofs.components());
      for (int k = 0; k < count; ++k) r += kernel(k, j) * motion(k);
      for (const Field& other : free) r -= other.dot(r) * other;
      free.push_back(r.normalized());
    }
    return free;
  }

 private:
  Field& motion(int k) { return motions_[static_cast<std::size_t>(k)]; }
  const Field& motion(int k) const { return motions_[static_cast<std::size_t>(k)]; }

  std::vector<Field> motions_;
  Real extent_ = 0;
};

}  // namespace stickslip
