// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/mesh/mesh.hpp>

namespace stickslip {

/// Reference area of a facet (times thickness, or of the full turn) that `node` carries: the integral of its shape
/// function, exact for straight two-node facets with a measure linear along them; 0 for a node of another facet.
template <class Kinematics, int nodes_per_cell>
Real facet_share(const Mesh<2, nodes_per_cell>& mesh, const Kinematics& kinematics, const std::array<Index, 2>& facet,
                 Index node) {
  if (node != facet[0] && node != facet[1]) return 0;
  const Index other = node == facet[0] ? facet[1] : facet[0];
  const Vec<Real, 2>& here = mesh.nodes[static_cast<std::size_t>(node)];
  const Vec<Real, 2>& there = mesh.nodes[static_cast<std::size_t>(other)];
  const Vec<Real, 2> third = (2 * here + there) / 3;
  return 0.5 * (there - here).norm() * kinematics.measure(third);
}

}  // namespace stickslip
