// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/mesh/mesh.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace stickslip {

/// Reference area of a facet (times thickness, or of the full circumference) tributary to `node` [length^2]: integral
/// of its shape function, exact for straight two-node facets with a measure linear along them; 0 for other nodes.
template <class Kinematics, int nodes_per_cell>
Real tributary_area(const Mesh<2, nodes_per_cell>& mesh, const Kinematics& kinematics,
                    const std::array<Index, 2>& facet, Index node) {
  if (node != facet[0] && node != facet[1]) return 0;
  const Index other = node == facet[0] ? facet[1] : facet[0];
  const Vec<Real, 2>& here = mesh.nodes[static_cast<std::size_t>(node)];
  const Vec<Real, 2>& there = mesh.nodes[static_cast<std::size_t>(other)];
  const Vec<Real, 2> third((2 * here[0] + there[0]) / 3, (2 * here[1] + there[1]) / 3);
  return 0.5 * std::hypot(there[0] - here[0], there[1] - here[1]) * kinematics.volume_factor(third);
}

/// The same for a four-node facet (theory.md, eq. 1.2): exact if flat; a warped one is projected along its mean normal.
template <class Kinematics, int nodes_per_cell>
Real tributary_area(const Mesh<3, nodes_per_cell>& mesh, const Kinematics& kinematics,
                    const std::array<Index, 4>& facet, Index node) {
  using V = Vec<Real, Kinematics::dim>;
  const auto found = std::find(facet.begin(), facet.end(), node);
  if (found == facet.end()) return 0;
  const auto first = static_cast<std::size_t>(found - facet.begin());
  std::array<V, 4> x;
  for (std::size_t a = 0; a < 4; ++a) x[a] = mesh.nodes[static_cast<std::size_t>(facet[(first + a) % 4])];
  // x = centre + xi along + eta across + xi eta twist, the node at (-1, -1).
  V along, across, twist, centre;
  for (int i = 0; i < 3; ++i) {
    const Real a = x[0][i], b = x[1][i], c = x[2][i], d = x[3][i];
    along[i] = (b - a + c - d) / 4;
    across[i] = (d - a + c - b) / 4;
    twist[i] = (a - b + c - d) / 4;
    centre[i] = (a + b + c + d) / 4;
  }
  const V normal = cross(along, across);
  V change = cross(along, twist);
  add(change, cross(twist, across));
  const Real area = normal.norm();
  return (area - contraction(normal, change) / (3 * area)) * kinematics.volume_factor(centre);
}

/// Calls visit(index in the side's list of nodes, node, facet) for every node of every facet of a side.
template <class MeshType, class Visit>
void for_each_corner(const MeshType& mesh, const std::string& side, Visit&& visit) {
  const auto& nodes = mesh.side(side).nodes;
  std::vector<std::size_t> place(mesh.nodes.size(), nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) place[static_cast<std::size_t>(nodes[k])] = k;
  for (const auto& facet : mesh.side(side).facets)
    for (const Index n : facet)
      if (const std::size_t k = place[static_cast<std::size_t>(n)]; k < nodes.size()) visit(k, n, facet);
}

/// Tributary reference areas of the nodes of a side [length^2], in the side's order.
template <class MeshType, class Kinematics>
std::vector<Real> nodal_areas(const MeshType& mesh, const Kinematics& kinematics, const std::string& side) {
  std::vector<Real> areas(mesh.side(side).nodes.size(), 0.0);
  for_each_corner(mesh, side, [&](std::size_t k, Index node, const auto& facet) {
    areas[k] += tributary_area(mesh, kinematics, facet, node);
  });
  return areas;
}

/// Distances of the nodes of a side from the nearest neighbour on a common facet, else on a common cell [length].
template <class MeshType>
std::vector<Real> nodal_spacing(const MeshType& mesh, const std::string& side) {
  const auto& nodes = mesh.side(side).nodes;
  const auto at = [&](Index n) -> const auto& {
    return mesh.nodes[static_cast<std::size_t>(n)];
  };
  std::vector<Real> lengths(nodes.size(), std::numeric_limits<Real>::infinity());
  const auto nearest = [&](std::size_t k, const auto& neighbours) {
    for (const Index other : neighbours)
      if (other != nodes[k]) lengths[k] = std::min(lengths[k], (at(other) - at(nodes[k])).norm());
  };
  for_each_corner(mesh, side, [&](std::size_t k, Index, const auto& facet) { nearest(k, facet); });
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (std::isinf(lengths[k]))
      for (const auto& cell : mesh.cells)
        if (std::find(cell.begin(), cell.end(), nodes[k]) != cell.end()) nearest(k, cell);
  return lengths;
}

}  // namespace stickslip
