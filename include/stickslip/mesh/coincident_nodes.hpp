// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace stickslip::mesh {

/// Coincident nodes of a mesh.
struct Coincidence {
  Index nodes = 0;               ///< number of nodes beyond one per position; 0: none
  std::array<Index, 2> first{};  ///< two coincident nodes
};

/// What a user is told of those of a body.
[[gnu::cold]] inline std::string in_words(const Coincidence& apart, const std::string& body) {
  return std::to_string(apart.nodes) + " nodes of the mesh" + (body.empty() ? "" : " of body \"" + body + "\"") +
         " lie where another one does, nodes " + std::to_string(apart.first[0]) + " and " +
         std::to_string(apart.first[1]) +
         " (from 0) among them: what was meshed in blocks that were not joined comes apart there";
}

/// Finds nodes closer to each other than `tolerance` times the mesh's size: blocks that were meshed separately and
/// never merged come apart at their interface, although their cell lists are valid.
template <int dim, int nodes_per_cell>
[[gnu::cold]] Coincidence coincident_nodes(const Mesh<dim, nodes_per_cell>& mesh, Real tolerance = 1e-9) {
  Coincidence found;
  if (mesh.nodes.empty()) return found;
  auto low = mesh.nodes[0], high = low;
  for (const auto& x : mesh.nodes) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  // At least the round-off of the coordinates.
  const Real near =
      std::max(tolerance * (high - low).norm(), 4 * std::numeric_limits<Real>::epsilon() *
                                                    std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()));
  // Sorted along a direction in which no two columns of a structured mesh coincide.
  Vec<Real, dim> along;
  for (int i = 0; i < dim; ++i) along[i] = 1 / (1 + i * Real(0.6180339887498949));
  along /= along.norm();
  std::vector<Real> place(mesh.nodes.size());
  for (std::size_t n = 0; n < place.size(); ++n) place[n] = along.dot(mesh.nodes[n] - low);
  std::vector<Index> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return place[static_cast<std::size_t>(a)] < place[static_cast<std::size_t>(b)]; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto at = [&](std::size_t i) { return static_cast<std::size_t>(order[i]); };
    for (std::size_t j = k; j-- > 0 && place[at(k)] - place[at(j)] <= near;)
      if ((mesh.nodes[at(k)] - mesh.nodes[at(j)]).norm() <= near) {
        if (found.nodes++ == 0) found.first = {std::min(order[j], order[k]), std::max(order[j], order[k])};
        break;
      }
  }
  return found;
}

}  // namespace stickslip::mesh
