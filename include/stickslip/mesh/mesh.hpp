// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// A named part of the boundary: facets as node lists, and their nodes once each, in the order of first appearance. In
/// the plane the body is on the left of a facet's nodes; in three dimensions they run counter-clockwise viewed from
/// outside, with the normal out of the body by the right-hand rule.
template <int dim>
struct Side {
  static constexpr std::size_t facet_nodes = dim == 2 ? 2 : 4;
  std::vector<std::array<Index, facet_nodes>> facets;
  std::vector<Index> nodes;
};

/// A mesh of one cell type with named sides.
template <int dim_, int nodes_per_cell_>
struct Mesh {
  static constexpr int dim = dim_;
  static constexpr int nodes_per_cell = nodes_per_cell_;

  std::vector<Vec<Real, dim>> nodes;                                               ///< reference coordinates [length]
  std::vector<std::array<Index, static_cast<std::size_t>(nodes_per_cell)>> cells;  ///< node numbers, from 0
  std::map<std::string, Side<dim>, std::less<>> sides;
  std::map<std::string, std::vector<Index>, std::less<>> blocks{};  ///< named groups of cells, by number

  Index node_count() const { return static_cast<Index>(nodes.size()); }
  Index cell_count() const { return static_cast<Index>(cells.size()); }
  /// Largest magnitude of a coordinate [length].
  Real extent() const {
    Real largest = 0;
    for (const auto& X : nodes)
      for (int i = 0; i < dim; ++i) largest = std::max(largest, std::abs(X[i]));
    return largest;
  }

  /// The side called `name`. Throws std::invalid_argument, which lists the existing names, if there is none.
  const Side<dim>& side(const std::string& name) const {
    const auto found = sides.find(name);
    if (found != sides.end()) return found->second;
    std::string known;
    for (const auto& [other, side] : sides) known += (known.empty() ? "" : ", ") + other;
    throw std::invalid_argument("the mesh has no side called \"" + name +
                                "\"; it has: " + (known.empty() ? "none" : known));
  }
};

/// Identifies a mesh by its numbers of nodes and cells and a digest of its nodes, cells and sides.
template <int dim, int nodes_per_cell>
std::string fingerprint(const Mesh<dim, nodes_per_cell>& mesh) {
  Digest digest;
  digest.add(mesh.nodes.data(), mesh.nodes.size());
  digest.add(mesh.cells.data(), mesh.cells.size());
  for (const auto& [name, side] : mesh.sides) {
    digest.add(name.data(), name.size());
    digest.add(side.facets.data(), side.facets.size());
    digest.add(side.nodes.data(), side.nodes.size());
  }
  return std::to_string(mesh.nodes.size()) + " nodes, " + std::to_string(mesh.cells.size()) + " cells, " +
         digest.text();
}

namespace mesh {

/// Adds a side that is the union of others, each node once, for a contact that extends around corners.
template <int dim, int nodes_per_cell>
void join(Mesh<dim, nodes_per_cell>& mesh, const std::string& name, const std::vector<std::string>& parts) {
  Side<dim> joined;
  for (const std::string& part : parts) {
    const Side<dim>& side = mesh.side(part);
    joined.facets.insert(joined.facets.end(), side.facets.begin(), side.facets.end());
    for (const Index n : side.nodes)
      if (std::find(joined.nodes.begin(), joined.nodes.end(), n) == joined.nodes.end()) joined.nodes.push_back(n);
  }
  mesh.sides[name] = std::move(joined);
}

/// The cells of a block on the nodes of the whole mesh, and the parts of its sides that they have: a body that shares
/// nodes with the others of the mesh (BodyDescription::nodes_of). Throws std::invalid_argument, which lists the
/// existing names, if there is no such block.
template <int dim, int nodes_per_cell>
Mesh<dim, nodes_per_cell> block(const Mesh<dim, nodes_per_cell>& mesh, const std::string& name) {
  const auto found = mesh.blocks.find(name);
  if (found == mesh.blocks.end()) {
    std::string known;
    for (const auto& [other, cells] : mesh.blocks) known += (known.empty() ? "" : ", ") + other;
    throw std::invalid_argument("the mesh has no block called \"" + name +
                                "\"; it has: " + (known.empty() ? "none" : known));
  }
  Mesh<dim, nodes_per_cell> part{.nodes = mesh.nodes, .cells = {}, .sides = {}};
  std::vector<bool> inside(mesh.nodes.size(), false);
  for (const Index e : found->second) {
    part.cells.push_back(mesh.cells[static_cast<std::size_t>(e)]);
    for (const Index n : part.cells.back()) inside[static_cast<std::size_t>(n)] = true;
  }
  const auto is_inside = [&](Index n) { return inside[static_cast<std::size_t>(n)]; };
  for (const auto& [side_name, side] : mesh.sides) {
    Side<dim> own;
    for (const auto& facet : side.facets)
      if (std::all_of(facet.begin(), facet.end(), is_inside)) own.facets.push_back(facet);
    for (const Index n : side.nodes) {
      const bool on_facet = std::any_of(own.facets.begin(), own.facets.end(), [&](const auto& facet) {
        return std::find(facet.begin(), facet.end(), n) != facet.end();
      });
      if (is_inside(n) && (side.facets.empty() || on_facet)) own.nodes.push_back(n);
    }
    if (!own.nodes.empty()) part.sides[side_name] = std::move(own);
  }
  return part;
}

/// A structured rectangle: cells[0] x cells[1] quadrilaterals over [origin, origin + size].
struct Rectangle {
  Vec<Real, 2> origin = Vec<Real, 2>::Zero();  ///< [length]
  Vec<Real, 2> size = Vec<Real, 2>::Ones();    ///< [length]
  std::array<Index, 2> cells{1, 1};
};

/// Meshes a rectangle. Sides: left, right, bottom, top. Nodes are numbered along the direction with fewer cells first,
/// for a small bandwidth of the matrices.
[[gnu::cold]] inline Mesh<2, 4> rectangle(const Rectangle& r) {
  if (r.cells[0] < 1 || r.cells[1] < 1)
    throw std::invalid_argument("mesh rectangle: needs at least one cell in each direction");
  if (!(r.size[0] > 0 && r.size[1] > 0) || !is_finite(r.size) || !is_finite(r.origin))
    throw std::invalid_argument("mesh rectangle: the size must be positive and finite");
  const Index nx = r.cells[0], ny = r.cells[1];
  const bool y_first = ny <= nx;
  const auto node = [&](Index i, Index j) { return y_first ? i * (ny + 1) + j : j * (nx + 1) + i; };

  Mesh<2, 4> mesh;
  mesh.nodes.resize(static_cast<std::size_t>((nx + 1) * (ny + 1)));
  for (Index i = 0; i <= nx; ++i)
    for (Index j = 0; j <= ny; ++j)
      mesh.nodes[std::size_t(node(i, j))] = {r.origin[0] + r.size[0] * i / nx, r.origin[1] + r.size[1] * j / ny};
  for (Index a = 0; a < (y_first ? nx : ny); ++a)
    for (Index b = 0; b < (y_first ? ny : nx); ++b) {
      const Index i = y_first ? a : b, j = y_first ? b : a;
      mesh.cells.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }

  // From node (i, j) on, in the direction (di, dj).
  const auto add_side = [&](const char* name, Index count, Index i, Index j, Index di, Index dj) {
    Side<2>& side = mesh.sides[name];
    for (Index k = 0; k <= count; ++k) side.nodes.push_back(node(i + k * di, j + k * dj));
    for (std::size_t k = 0; k + 1 < side.nodes.size(); ++k) side.facets.push_back({side.nodes[k], side.nodes[k + 1]});
  };
  add_side("bottom", nx, 0, 0, 1, 0);
  add_side("right", ny, nx, 0, 0, 1);
  add_side("top", nx, nx, ny, -1, 0);
  add_side("left", ny, 0, ny, 0, -1);
  return mesh;
}

/// A structured box: cells[0] x cells[1] x cells[2] hexahedra over [origin, origin + size].
struct Box {
  Vec<Real, 3> origin = Vec<Real, 3>::Zero();  ///< [length]
  Vec<Real, 3> size = Vec<Real, 3>::Ones();    ///< [length]
  std::array<Index, 3> cells{1, 1, 1};
};

/// Meshes a box. Sides: left, right (along x), bottom, top (along y), back, front (along z). Nodes are numbered along
/// the direction with the fewest cells first and along that with the most last, for a small bandwidth of the matrices.
[[gnu::cold]] inline Mesh<3, 8> box(const Box& b) {
  if (b.cells[0] < 1 || b.cells[1] < 1 || b.cells[2] < 1)
    throw std::invalid_argument("mesh box: needs at least one cell in each direction");
  if (!(b.size[0] > 0 && b.size[1] > 0 && b.size[2] > 0) || !is_finite(b.size) || !is_finite(b.origin))
    throw std::invalid_argument("mesh box: the size must be positive and finite");
  using Location = std::array<Index, 3>;
  std::array<std::size_t, 3> order{2, 1, 0};  // directions from the innermost to the outermost
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return b.cells[i] < b.cells[j]; });
  Location stride{};
  Index count = 1;
  for (const std::size_t i : order) {
    stride[i] = count;
    count *= b.cells[i] + 1;
  }
  const auto node = [&](const Location& at) { return at[0] * stride[0] + at[1] * stride[1] + at[2] * stride[2]; };
  // Calls visit(at) for places[i] grid indices in each direction i, in the order of the numbering.
  const auto walk = [&](const Location& places, auto&& visit) {
    Location at{};
    for (at[order[2]] = 0; at[order[2]] < places[order[2]]; ++at[order[2]])
      for (at[order[1]] = 0; at[order[1]] < places[order[1]]; ++at[order[1]])
        for (at[order[0]] = 0; at[order[0]] < places[order[0]]; ++at[order[0]]) visit(at);
  };

  Mesh<3, 8> mesh;
  mesh.nodes.reserve(static_cast<std::size_t>(count));
  walk({b.cells[0] + 1, b.cells[1] + 1, b.cells[2] + 1}, [&](const Location& at) {
    Vec<Real, 3> x;
    for (std::size_t i = 0; i < 3; ++i) {
      const int c = static_cast<int>(i);
      x[c] = b.origin[c] + b.size[c] * at[i] / b.cells[i];
    }
    mesh.nodes.push_back(x);
  });
  walk(b.cells, [&](const Location& at) {
    const Index n = node(at), x = stride[0], y = stride[1], z = stride[2];
    mesh.cells.push_back({n, n + x, n + x + y, n + y, n + z, n + x + z, n + x + y + z, n + y + z});
  });

  // The side at the low or high end of direction `normal`; its facets span the two others.
  const auto add_side = [&](const char* name, std::size_t normal, bool high) {
    std::size_t u = (normal + 1) % 3, v = (normal + 2) % 3;
    if (!high) std::swap(u, v);  // counter-clockwise from u to v, viewed from outside
    Side<3> side;
    Location places{1, 1, 1};
    places[u] = b.cells[u];
    places[v] = b.cells[v];
    const Index offset = high ? b.cells[normal] * stride[normal] : 0;
    walk(places, [&](const Location& at) {
      const Index n = offset + node(at);
      side.facets.push_back({n, n + stride[u], n + stride[u] + stride[v], n + stride[v]});
    });
    std::vector<bool> listed(static_cast<std::size_t>(count), false);
    for (const auto& facet : side.facets)
      for (const Index n : facet) {
        if (!listed[static_cast<std::size_t>(n)]) side.nodes.push_back(n);
        listed[static_cast<std::size_t>(n)] = true;
      }
    mesh.sides[name] = std::move(side);
  };
  add_side("left", 0, false);
  add_side("right", 0, true);
  add_side("bottom", 1, false);
  add_side("top", 1, true);
  add_side("back", 2, false);
  add_side("front", 2, true);
  return mesh;
}

}  // namespace mesh
}  // namespace stickslip
