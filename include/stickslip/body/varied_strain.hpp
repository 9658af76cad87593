// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/types.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace stickslip {

/// Whether an element adds a linear strain to the mean deformation as it is: where volumes are kept it locks once this
/// strain is large (theory.md, eq. 2.23).
template <class E>
inline constexpr bool locks_in_varied_strain = requires {
  requires E::locks_in_varied_strain;
};

/// The cells of meshes whose element locks where the strain varies much in a cell.
template <class Cell>
class VariedStrain {
 public:
  static constexpr int dim = Cell::dim, nodes = Cell::nodes;
  /// Part of the volume at a point that a cell may lose before it is named.
  static constexpr Real notable = 0.1;

  bool told = false;  ///< whether the run has warned of one

  /// Adds the cells of a mesh, which has to outlive this, and whose first node and cell have these numbers.
  void add_mesh(const Mesh<dim, nodes>& mesh, Index first_node, Index first_cell) {
    meshes_.push_back({&mesh, first_node, first_cell});
  }

  /// One sentence about the cell that loses most of its volume; empty where none loses much.
  std::string lost(const Field& u) const {
    Real worst = notable;
    Index cell = -1;
    for (const Part& part : meshes_)
      for (Index e = 0; e < part.mesh->cell_count(); ++e)
        if (const Real now = volume_lost(part, e, u); now > worst) worst = now, cell = part.first_cell + e;
    if (cell < 0) return {};
    return "the strain of cell " + std::to_string(cell) + " varies by so much that AssumedStrain takes up to " +
           brief(100 * worst, 2) +
           " % from its volume at a point: where the material keeps its volume the element is too stiff; take finer "
           "cells, or MeanDilatation";
  }

 private:
  struct Part {
    const Mesh<dim, nodes>* mesh;
    Index first_node, first_cell;
  };

  // Theory.md, eq. 2.23: of the worst pair of directions at the worst point.
  static Real volume_lost(const Part& part, Index e, const Field& u) {
    const auto& cell = part.mesh->cells[static_cast<std::size_t>(e)];
    Mat<Real, nodes, dim> X, moved;
    for (int a = 0; a < nodes; ++a) {
      const Index node = cell[static_cast<std::size_t>(a)];
      for (int i = 0; i < dim; ++i) {
        X(a, i) = part.mesh->nodes[static_cast<std::size_t>(node)][i];
        moved(a, i) = u[(part.first_node + node) * dim + i];
      }
    }
    const Mat<Real, nodes, dim> slope = Cell::gradient(Vec<Real, dim>::Zero());
    const Mat<Real, dim> base = transposed_product(X, slope);
    Real det;
    const Mat<Real, nodes, dim> b = product(slope, inverse(base, det));
    const Mat<Real, dim> now = transposed_product(Mat<Real, nodes, dim>(X + moved), slope);
    Real worst = 0;
    for (int j = 0; j < dim; ++j)
      for (int k = 0; k < j; ++k) {
        Vec<Real, nodes> hourglass;
        for (int a = 0; a < nodes; ++a) {
          const auto& xi = Cell::corner[static_cast<std::size_t>(a)];
          hourglass[a] = xi[static_cast<std::size_t>(j)] * xi[static_cast<std::size_t>(k)] / nodes;
        }
        add(hourglass, Vec<Real, nodes>(product(b, Vec<Real, dim>(transposed_product(X, hourglass)))), Real(-1));
        const Vec<Real, dim> y = transposed_product(moved, hourglass);
        const Real jj = dot(now, j, now.col(j)), kk = dot(now, k, now.col(k)), jk = dot(now, j, now.col(k));
        const Real strained = std::abs(dot(now, j, y)) * kk + std::abs(dot(now, k, y)) * jj;
        worst = std::max(worst, strained * strained / (3 * (jj * kk - jk * jk) * jj * kk));
      }
    return worst;
  }
  template <class V>
  static Real dot(const Mat<Real, dim>& base, int j, const V& v) {
    Real sum = 0;
    for (int i = 0; i < dim; ++i) sum += base(i, j) * v[i];
    return sum;
  }

  std::vector<Part> meshes_;
};

namespace detail {
struct NoVariedStrain {};
template <class... Types>
struct VariedStrainOf {
  using type = NoVariedStrain;
};
template <class Type, class... Others>
struct VariedStrainOf<Type, Others...> {
  using Element = typename Type::Element;
  using type = typename std::conditional_t<locks_in_varied_strain<Element>,
                                           std::type_identity<VariedStrain<typename Element::Cell>>,
                                           VariedStrainOf<Others...>>::type;
};
template <class... Types>
typename VariedStrainOf<Types...>::type varied_strain_of(BodyTypes<Types...>);
}  // namespace detail

/// Those of a model's bodies; empty where no element of theirs locks so.
template <class Model>
using VariedStrainOf = decltype(detail::varied_strain_of(BodyTypesOf<Model>{}));

}  // namespace stickslip
