// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/dofs.hpp>
#include <stickslip/base/null_space.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
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

  RigidMotions(const std::vector<Vec<Real, dim>>& nodes, const Field& u) : nodes_(nodes), u_(u) {
    for (const auto& X : nodes) add(centre_, X, 1 / Real(nodes.size()));
    for (const auto& X : nodes) extent_ = std::max(extent_, minus(X, centre_).norm());
  }

  /// Largest distance of a node from the centre [length].
  Real extent() const { return extent_; }

  /// Those of their combinations, an orthonormal nodal field each, that neither supports nor the matrix K resist: the
  /// kernel of r.K r / `stiffness` + c.c, r their unknown and c their constrained components, to `least`.
  std::vector<Field> unresisted(const Dofs& dofs, const SparseView& matrix, Real stiffness, Real least) const {
    Mat<Real, count> resistance = Mat<Real, count>::Zero();
    const auto resist = [&](const Components& a, Real value, const Components& b) {
      for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
          resistance(static_cast<Index>(i), static_cast<Index>(j)) += a[i] * value * b[j];
    };
    for (Index c = 0; c < dofs.components(); ++c)
      if (dofs.equation(c) == Dofs::constrained) resist(at(c), 1, at(c));
    for (Index j = 0; j < matrix.size; ++j) {
      const Index b = dofs.component(j);
      const Components there = at(b);
      for (Index s = matrix.column_start[j]; s < matrix.column_start[j + 1]; ++s) {
        const Index a = dofs.component(matrix.row[s]);
        const Components here = at(a);
        resist(here, matrix.values[s] / stiffness, there);
        if (matrix.symmetry == Symmetry::symmetric && a != b) resist(there, matrix.values[s] / stiffness, here);
      }
    }
    std::vector<Field> free;
    for (const Components& combination : null_space<count>(resistance, least)) {
      Field r = Field::Zero(dofs.components());
      for (Index c = 0; c < r.size(); ++c) {
        const Components motions = at(c);
        for (std::size_t k = 0; k < motions.size(); ++k) r[c] += combination[k] * motions[k];
      }
      for (const Field& other : free) r -= other.dot(r) * other;
      free.push_back(r.normalized());
    }
    return free;
  }

 private:
  // What each motion makes of a nodal component. Entry by entry, for it is the quickest to compile.
  using Components = std::array<Real, static_cast<std::size_t>(count)>;
  Components at(Index c) const {
    const Index n = c / dim;
    const int i = c % dim;
    Components motions{};
    if constexpr (Kinematics::hoop) {
      motions[0] = i == dim - 1 ? 1 : 0;
    } else {
      const auto x = [&](int k) {
        return (nodes_[static_cast<std::size_t>(n)][k] + u_[n * dim + k] - centre_[k]) / extent_;
      };
      motions[static_cast<std::size_t>(i)] = 1;
      for (int k = dim; k < count; ++k) {
        const int p = dim == 2 ? 0 : (k - 2) % 3, q = dim == 2 ? 1 : (k - 1) % 3;  // the plane it turns
        motions[static_cast<std::size_t>(k)] = i == p ? -x(q) : i == q ? x(p) : 0;
      }
    }
    return motions;
  }

  const std::vector<Vec<Real, dim>>& nodes_;
  const Field& u_;
  Vec<Real, dim> centre_ = Vec<Real, dim>::Zero();
  Real extent_ = 0;
};

}  // namespace stickslip
