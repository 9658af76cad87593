// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/base/null_space.hpp>
#include <stickslip/body/parts.hpp>
#include <stickslip/dofs/index_map.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip {

/// The motions of the parts of a body, where its nodal displacements have brought them, as if they were rigid: shifts,
/// then turns about a part's centre by its extent's worth; in axisymmetry the shift along the axis alone.
template <class Kinematics>
class RigidBodyModes {
 public:
  static constexpr int dim = Kinematics::dim;
  static constexpr int count = Kinematics::hoop ? 1 : dim + dim * (dim - 1) / 2;

  RigidBodyModes(const std::vector<Vec<Real, dim>>& nodes, const Parts& parts)
      : nodes_(nodes), parts_(parts), of_(static_cast<std::size_t>(parts.count())) {
    u_.setZero(static_cast<Index>(nodes.size()) * dim);  // room for them
    for (Index n = 0; n < static_cast<Index>(nodes.size()); ++n) ++part(n).nodes;
    for (Index n = 0; n < static_cast<Index>(nodes.size()); ++n) add(part(n).centre, X(n), 1 / Real(part(n).nodes));
    for (Index n = 0; n < static_cast<Index>(nodes.size()); ++n)
      part(n).extent = std::max(part(n).extent, minus(X(n), part(n).centre).norm());
  }

  /// Largest distance of a node from the centre of its part [length].
  Real extent() const {
    Real largest = 0;
    for (const OfPart& of : of_) largest = std::max(largest, of.extent);
    return largest;
  }

  /// Takes what resists them at the displacements u: the supports, and the matrix K.
  void take(const Field& u, const IndexMap& dofs, const SparseView& matrix) {
    u_ = u;
    for (OfPart& of : of_) {
      of.shift.setZero();
      of.resistance.setZero();
      of.stiffness = 0;
    }
    for (Index n = 0; n < static_cast<Index>(nodes_.size()); ++n)
      add(part(n).shift, at_node<dim>(u, n), 1 / Real(part(n).nodes));
    for (Index j = 0; j < matrix.size; ++j)
      for (Index s = matrix.column_start[j]; s < matrix.column_start[j + 1]; ++s) {
        if (!is_nodal(dofs.component(j))) continue;
        Real& stiffness = part(dofs.component(j) / dim).stiffness;
        stiffness = std::max(stiffness, std::abs(matrix.values[s]));
      }
    for (Index c = 0; c < dofs.components(); ++c)
      if (is_nodal(c) && dofs.supported(c)) resist(part(c / dim), at(c), 1, at(c));
    for (Index j = 0; j < matrix.size; ++j) {
      const Index b = dofs.component(j);
      if (!is_nodal(b)) continue;
      const Components there = at(b);
      OfPart& of = part(b / dim);
      if (!(of.stiffness > 0)) continue;
      for (Index s = matrix.column_start[j]; s < matrix.column_start[j + 1]; ++s) {
        const Index a = dofs.component(matrix.row[s]);
        if (!is_nodal(a) || parts_.at(a / dim) != parts_.at(b / dim)) continue;  // the other part rests
        const Components here = at(a);
        resist(of, here, matrix.values[s] / of.stiffness, there);
        if (matrix.symmetry == Symmetry::symmetric && a != b) resist(of, there, matrix.values[s] / of.stiffness, here);
      }
    }
  }

  /// Those of their combinations, an orthonormal nodal field each, that nothing resists in a part: the kernel of
  /// r.K r / k + c.c, r their unknown and c their constrained components, k the largest stiffness of the part; to
  /// 1e-11, or what a force resists by that is `imbalance`: out of balance by R, a stressed body that turns resists by
  /// |R| / extent.
  std::vector<Field> zero_energy_modes(Index number, Real imbalance) const {
    const OfPart& of = of_[static_cast<std::size_t>(number)];
    const Real stiffness = of.stiffness * of.extent;
    const Real least = std::max(1e-11, stiffness > 0 ? imbalance / stiffness : 0);
    std::vector<Field> free;
    for (const Components& combination : null_space<count>(of.resistance, least)) {
      Field r = Field::Zero(u_.size());
      for (Index c = 0; c < r.size(); ++c) {
        if (!is_nodal(c) || parts_.at(c / dim) != number) continue;
        const Components motions = at(c);
        for (std::size_t k = 0; k < motions.size(); ++k) r[c] += combination[k] * motions[k];
      }
      for (const Field& other : free) r -= other.dot(r) * other;
      free.push_back(r.normalized());
    }
    return free;
  }

 private:
  // Components behind the nodes' are unknowns of terms, which no rigid motion moves.
  bool is_nodal(Index c) const { return c < parts_.nodes() * dim; }
  // What each motion makes of a nodal component. Entry by entry, for it is the quickest to compile.
  using Components = std::array<Real, static_cast<std::size_t>(count)>;
  Components at(Index c) const {
    const Index n = c / dim;
    const int i = c % dim;
    Components motions{};
    if constexpr (Kinematics::hoop) {
      motions[0] = i == dim - 1 ? 1 : 0;
    } else {
      const OfPart& of = of_[static_cast<std::size_t>(parts_.at(n))];
      const auto x = [&](int k) { return ((X(n)[k] - of.centre[k]) + (u_[n * dim + k] - of.shift[k])) / of.extent; };
      motions[static_cast<std::size_t>(i)] = 1;
      for (int k = dim; k < count; ++k) {
        const int p = dim == 2 ? 0 : (k - 2) % 3, q = dim == 2 ? 1 : (k - 1) % 3;  // the plane it turns
        motions[static_cast<std::size_t>(k)] = i == p ? -x(q) : i == q ? x(p) : 0;
      }
    }
    return motions;
  }

  struct OfPart {
    Mat<Real, count> resistance = Mat<Real, count>::Zero();
    Vec<Real, dim> centre = Vec<Real, dim>::Zero();
    Vec<Real, dim> shift = Vec<Real, dim>::Zero();  // of the centre: turns are about where it is
    Real extent = 0;                                // largest distance of a node from the centre [length]
    Real stiffness = 0;                             // largest entry of the matrix
    Index nodes = 0;
  };
  OfPart& part(Index node) { return of_[static_cast<std::size_t>(parts_.at(node))]; }
  const Vec<Real, dim>& X(Index node) const { return nodes_[static_cast<std::size_t>(node)]; }
  static void resist(OfPart& of, const Components& a, Real value, const Components& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j)
        of.resistance(static_cast<Index>(i), static_cast<Index>(j)) += a[i] * value * b[j];
  }

  const std::vector<Vec<Real, dim>>& nodes_;
  Field u_;
  const Parts& parts_;
  std::vector<OfPart> of_;
};

}  // namespace stickslip
