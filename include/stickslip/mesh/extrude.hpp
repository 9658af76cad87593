// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/mesh/mesh.hpp>

#include <cmath>
#include <set>
#include <stdexcept>

namespace stickslip::mesh {

/// Extrusion of a plane mesh along z.
struct Extrusion {
  Real thickness = 1;                        ///< [length]
  Index layers = 1;                          ///< number of cells through the thickness
  Real from = 0;                             ///< z of the plane mesh [length]
  std::string low = "back", high = "front";  ///< names of the two faces
};

/// Extrudes a mesh of quadrilaterals to hexahedra. Its sides keep their names, and the faces at low and high z are
/// added: a rectangle becomes the mesh of `box`. Nodes are numbered through the thickness first, in the order of the
/// plane mesh, for a small bandwidth with few layers. Throws std::invalid_argument for invalid parameters or names.
inline Mesh<3, 8> extrude(const Mesh<2, 4>& plane, const Extrusion& e) {
  if (e.layers < 1) throw std::invalid_argument("mesh extrude: needs at least one layer");
  if (!(e.thickness > 0) || !std::isfinite(e.thickness) || !std::isfinite(e.from))
    throw std::invalid_argument("mesh extrude: the thickness must be positive and finite, and its start finite");
  if (e.low == e.high) throw std::invalid_argument("mesh extrude: both faces are called \"" + e.low + "\"");
  for (const std::string& face : {e.low, e.high})
    if (plane.sides.count(face) > 0)
      throw std::invalid_argument("mesh extrude: the plane mesh has a side called \"" + face +
                                  "\" already; give the face another name");
  const auto node = [&](Index in_plane, Index level) { return in_plane * (e.layers + 1) + level; };

  Mesh<3, 8> mesh;
  mesh.nodes.reserve(plane.nodes.size() * static_cast<std::size_t>(e.layers + 1));
  for (const Vec<Real, 2>& x : plane.nodes)
    for (Index k = 0; k <= e.layers; ++k) mesh.nodes.emplace_back(x[0], x[1], e.from + e.thickness * k / e.layers);
  mesh.cells.reserve(plane.cells.size() * static_cast<std::size_t>(e.layers));
  for (const auto& [a, b, c, d] : plane.cells)
    for (Index k = 0; k < e.layers; ++k)
      mesh.cells.push_back({node(a, k), node(b, k), node(c, k), node(d, k), node(a, k + 1), node(b, k + 1),
                            node(c, k + 1), node(d, k + 1)});

  const auto add_side = [&](const std::string& name, std::vector<std::array<Index, 4>> facets) {
    Side<3> side{std::move(facets), {}};
    std::set<Index> listed;
    for (const auto& facet : side.facets)
      for (const Index n : facet)
        if (listed.insert(n).second) side.nodes.push_back(n);
    mesh.sides[name] = std::move(side);
  };
  for (const auto& [name, side] : plane.sides) {
    std::vector<std::array<Index, 4>> facets;
    for (const auto& [a, b] : side.facets)
      for (Index k = 0; k < e.layers; ++k) facets.push_back({node(a, k), node(b, k), node(b, k + 1), node(a, k + 1)});
    add_side(name, std::move(facets));
  }
  std::vector<std::array<Index, 4>> low, high;
  for (const auto& [a, b, c, d] : plane.cells) {
    low.push_back({node(a, 0), node(d, 0), node(c, 0), node(b, 0)});
    high.push_back({node(a, e.layers), node(b, e.layers), node(c, e.layers), node(d, e.layers)});
  }
  add_side(e.low, std::move(low));
  add_side(e.high, std::move(high));
  return mesh;
}

}  // namespace stickslip::mesh
