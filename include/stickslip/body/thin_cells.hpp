// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/types.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/policy/element.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

namespace stickslip {

/// Whether an element answers bending with a parasitic shear: it is then too stiff by about 1 + (1 - nu) / 2 (l / t)^2,
/// l the length of its cell and t the thickness (theory.md, section 2.4).
template <class E>
inline constexpr bool locks_in_bending = requires {
  requires E::locks_in_bending;
};

/// The cells of a mesh that are thin for an element that locks in bending, and whether they bend.
template <class Cell>
class ThinCells {
 public:
  static constexpr int dim = Cell::dim, nodes = Cell::nodes;
  /// A cell is thin beyond this ratio of its length to its thickness.
  static constexpr Real thin = 3;
  /// It bends where the largest strain of bending is more than this part of the mean strain.
  static constexpr Real notable = 0.5;

  bool told = false;  ///< whether the run has warned of them

  bool none() const { return cells_.empty(); }
  /// Adds the cells of a mesh whose first node and cell have these numbers.
  [[gnu::cold]] void add_mesh(const Mesh<dim, nodes>& mesh, Index first_node, Index first_cell) {
    const Mat<Real, nodes, dim> slope = Cell::gradient(Vec<Real, dim>::Zero());
    for (Index e = 0; e < mesh.cell_count(); ++e) {
      const auto& cell = mesh.cells[static_cast<std::size_t>(e)];
      Mat<Real, nodes, dim> X;
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < dim; ++i)
          X(a, i) = mesh.nodes[static_cast<std::size_t>(cell[static_cast<std::size_t>(a)])][i];
      const Mat<Real, dim> base = transposed_product(X, slope);
      int across = 0;
      for (int j = 1; j < dim; ++j)
        if (length(base, j) < length(base, across)) across = j;
      for (int along = 0; along < dim; ++along) {
        const Real aspect = length(base, along) / length(base, across);
        if (!(aspect > thin)) continue;
        Thin t{.cell = first_cell + e, .along = along, .aspect = aspect, .base = base};
        for (int a = 0; a < nodes; ++a) {
          const auto& xi = Cell::corner[static_cast<std::size_t>(a)];
          t.node[static_cast<std::size_t>(a)] = first_node + cell[static_cast<std::size_t>(a)];
          t.hourglass[a] = xi[static_cast<std::size_t>(along)] * xi[static_cast<std::size_t>(across)];
        }
        Real det;
        t.hourglass = hourglass_vectors<nodes, dim, 1>(t.hourglass, slope, inverse(base, det), X);
        cells_.push_back(t);
      }
    }
  }

  /// One sentence about the cell that bends and is the thinnest; empty where none does.
  std::string bending(const Field& u) const {
    const Mat<Real, nodes, dim> slope = Cell::gradient(Vec<Real, dim>::Zero());
    const Thin* worst = nullptr;
    for (const Thin& t : cells_) {
      if (worst && t.aspect <= worst->aspect) continue;
      Mat<Real, dim> now = t.base;
      Vec<Real, dim> y = Vec<Real, dim>::Zero();
      for (int a = 0; a < nodes; ++a)
        for (int i = 0; i < dim; ++i) {
          const Real moved = u[t.node[static_cast<std::size_t>(a)] * dim + i];
          y[i] += moved * t.hourglass[a];
          for (int j = 0; j < dim; ++j) now(i, j) += moved * slope(a, j);
        }
      Real curved = 0, mean = 0;
      for (int i = 0; i < dim; ++i) curved += now(i, t.along) * y[i];
      curved = std::abs(curved) / std::pow(length(t.base, t.along), 2);
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k) {
          Real change = 0;
          for (int i = 0; i < dim; ++i) change += now(i, j) * now(i, k) - t.base(i, j) * t.base(i, k);
          mean += std::pow(0.5 * change / (length(t.base, j) * length(t.base, k)), 2);
        }
      if (curved > 1e-9 && curved > notable * std::sqrt(mean)) worst = &t;
    }
    if (!worst) return {};
    return "cell " + std::to_string(worst->cell) + " is " + brief(worst->aspect, 2) +
           " times as long as thick and bends: its element resists a bending of its own about " +
           brief(1 + 0.35 * worst->aspect * worst->aspect, 2) + " times too much; take AssumedStrain, or shorter cells";
  }

 private:
  struct Thin {
    Index cell;
    int along;  // direction of the length in the cell
    Real aspect;
    Mat<Real, dim> base;  // derivatives of the place at the centre
    std::array<Index, static_cast<std::size_t>(nodes)> node{};
    Vec<Real, nodes> hourglass{};  // of the product of that direction and the one across
  };

  static Real length(const Mat<Real, dim>& base, int j) {
    Real square = 0;
    for (int i = 0; i < dim; ++i) square += base(i, j) * base(i, j);
    return std::sqrt(square);
  }

  std::vector<Thin> cells_;
};

namespace detail {
struct NoThinCells {};
template <class... Types>
struct ThinCellsOf {
  using type = NoThinCells;
};
template <class Type, class... Others>
struct ThinCellsOf<Type, Others...> {
  using Element = typename Type::Element;
  using type =
      typename std::conditional_t<locks_in_bending<Element>, std::type_identity<ThinCells<typename Element::Cell>>,
                                  ThinCellsOf<Others...>>::type;
};
template <class... Types>
typename ThinCellsOf<Types...>::type thin_cells_of(BodyTypes<Types...>);
}  // namespace detail

/// Those of a model's bodies; empty where no element of theirs locks in bending.
template <class Model>
using ThinCellsOf = decltype(detail::thin_cells_of(BodyTypesOf<Model>{}));

}  // namespace stickslip
