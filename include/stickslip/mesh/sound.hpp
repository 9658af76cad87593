// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/mesh/mesh.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace stickslip {

namespace detail {
// Throws because `what` names the node n, which a mesh of `nodes` nodes does not have.
[[noreturn, gnu::cold]] inline void refuse_node(const std::string& what, Index n, std::size_t nodes) {
  throw std::invalid_argument(what + " names a node that does not exist, " + std::to_string(n) + ": the mesh has " +
                              std::to_string(nodes) + ", numbered from 0");
}
}  // namespace detail

/// Throws std::invalid_argument, naming the fault, for an invalid mesh: a cell or a side with nodes that do not exist,
/// or a side with a node or a facet twice, which would count double.
template <int dim, int nodes_per_cell>
[[gnu::cold]] void require_sound(const Mesh<dim, nodes_per_cell>& mesh) {
  const std::size_t count = mesh.nodes.size();
  const auto exists = [count](Index n) { return n >= 0 && static_cast<std::size_t>(n) < count; };
  for (std::size_t e = 0; e < mesh.cells.size(); ++e)
    for (const Index n : mesh.cells[e])
      if (!exists(n)) detail::refuse_node("body: cell " + std::to_string(e), n, count);
  std::vector<bool> listed(count, false);

  for (const auto& [name, side] : mesh.sides) {
    const std::string named = "side \"" + name + "\"";
    std::fill(listed.begin(), listed.end(), false);
    for (const Index n : side.nodes) {
      if (!exists(n)) detail::refuse_node(named, n, count);
      if (listed[static_cast<std::size_t>(n)])
        throw std::invalid_argument(named + " has node " + std::to_string(n) + " twice");
      listed[static_cast<std::size_t>(n)] = true;
    }
    std::map<std::array<Index, Side<dim>::facet_nodes>, std::size_t> facets;
    for (std::size_t f = 0; f < side.facets.size(); ++f) {
      auto nodes = side.facets[f];
      for (const Index n : nodes)
        if (!exists(n)) detail::refuse_node(named + ", facet " + std::to_string(f), n, count);
      std::sort(nodes.begin(), nodes.end());
      if (const auto [first, fresh] = facets.emplace(nodes, f); !fresh)
        throw std::invalid_argument(named + " has a facet twice: " + std::to_string(f) + " joins the nodes of " +
                                    std::to_string(first->second));
    }
  }
}

}  // namespace stickslip
