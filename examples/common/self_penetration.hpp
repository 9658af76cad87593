// SPDX-License-Identifier: BSL-1.0
// Whether a body passes through itself: there is no self-contact yet, so a benchmark says when it would be needed.
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/mesh/mesh.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace examples {

/// True when a node of the side lies inside a cell that it does not belong to, at the nodal displacements u.
inline bool passes_through_itself(const stickslip::Mesh<2, 4>& mesh, const stickslip::Field& u,
                                  const std::string& side) {
  using Point = stickslip::Vec<double, 2>;
  std::vector<Point> x(mesh.nodes.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = mesh.nodes[n] + stickslip::at_node<2>(u, static_cast<stickslip::Index>(n));
  for (const auto& cell : mesh.cells) {
    Point low = x[static_cast<std::size_t>(cell[0])], high = low;
    for (const auto n : cell) {
      low = low.cwiseMin(x[static_cast<std::size_t>(n)]);
      high = high.cwiseMax(x[static_cast<std::size_t>(n)]);
    }
    for (const auto node : mesh.side(side).nodes) {
      const Point& p = x[static_cast<std::size_t>(node)];
      if ((p.array() <= low.array()).any() || (p.array() >= high.array()).any()) continue;
      if (std::find(cell.begin(), cell.end(), node) != cell.end()) continue;
      bool inside = true;  // on the left of every edge
      for (std::size_t a = 0; a < cell.size() && inside; ++a) {
        const Point& from = x[static_cast<std::size_t>(cell[a])];
        const Point edge = x[static_cast<std::size_t>(cell[(a + 1) % cell.size()])] - from;
        inside = edge[0] * (p[1] - from[1]) - edge[1] * (p[0] - from[0]) > 0;
      }
      if (inside) return true;
    }
  }
  return false;
}

}  // namespace examples
