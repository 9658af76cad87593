// SPDX-License-Identifier: BSL-1.0
// How deep a body lies in itself, looked at without the library's contact: what self-contact is held against.
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/mesh/mesh.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace examples {

/// The largest depth of a node of the side in a cell that it does not belong to, at the nodal displacements u: its
/// distance from the nearest facet of the side that is not its own [length]; 0 where none is in a cell.
inline double depth_in_itself(const stickslip::Mesh<2, 4>& mesh, const stickslip::Field& u, const std::string& side) {
  using Point = stickslip::Vec<double, 2>;
  std::vector<Point> x(mesh.nodes.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = mesh.nodes[n] + stickslip::at_node<2>(u, static_cast<stickslip::Index>(n));
  const auto at = [&](stickslip::Index n) -> const Point& { return x[static_cast<std::size_t>(n)]; };
  const auto distance = [&](stickslip::Index node) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& facet : mesh.side(side).facets) {
      if (facet[0] == node || facet[1] == node) continue;
      const Point way = at(facet[1]) - at(facet[0]), from = at(node) - at(facet[0]);
      nearest = std::min(nearest, (from - std::clamp(from.dot(way) / way.squaredNorm(), 0.0, 1.0) * way).norm());
    }
    return nearest;
  };
  double deepest = 0;
  for (const auto& cell : mesh.cells) {
    Point low = at(cell[0]), high = low;
    for (const auto n : cell) {
      low = low.cwiseMin(at(n));
      high = high.cwiseMax(at(n));
    }
    for (const auto node : mesh.side(side).nodes) {
      const Point& p = at(node);
      if ((p.array() <= low.array()).any() || (p.array() >= high.array()).any()) continue;
      if (std::find(cell.begin(), cell.end(), node) != cell.end()) continue;
      bool inside = true;  // on the left of every edge
      for (std::size_t a = 0; a < cell.size() && inside; ++a) {
        const Point edge = at(cell[(a + 1) % cell.size()]) - at(cell[a]);
        inside = edge[0] * (p[1] - at(cell[a])[1]) - edge[1] * (p[0] - at(cell[a])[0]) > 0;
      }
      if (inside) deepest = std::max(deepest, distance(node));
    }
  }
  return deepest;
}

}  // namespace examples
