// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace stickslip {

/// The connected parts of a mesh: nodes belong to one part where a chain of cells joins them. Parts are numbered by
/// their first nodes.
class Parts {
 public:
  template <class MeshType>
  explicit Parts(const MeshType& mesh) : part_(mesh.nodes.size()) {
    // Trees of nodes, each on its part's least one.
    std::iota(part_.begin(), part_.end(), 0);
    const auto root = [&](Index n) {
      while (at(n) != n) n = part_[static_cast<std::size_t>(n)] = at(at(n));
      return n;
    };
    for (const auto& cell : mesh.cells)
      for (const Index n : cell) {
        const Index a = root(cell[0]), b = root(n);
        part_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      }
    for (Index n = 0; n < static_cast<Index>(part_.size()); ++n) {
      Index& part = part_[static_cast<std::size_t>(n)];
      part = part == n ? count_++ : at(part);  // that of an earlier node, numbered already
    }
  }

  Index count() const { return count_; }
  /// The part of a node.
  Index at(Index node) const { return part_[static_cast<std::size_t>(node)]; }

  /// What a part is called: by a side that lies in it, or else by a node. Empty where there is but one.
  template <class MeshType>
  std::string name(Index part, const MeshType& mesh) const {
    if (count_ == 1) return "";
    for (const auto& [name, side] : mesh.sides) {
      const auto inside = [&](Index n) { return at(n) == part; };
      if (!side.nodes.empty() && std::all_of(side.nodes.begin(), side.nodes.end(), inside))
        return "the part of the mesh with side \"" + name + "\"";
    }
    const auto first = std::find(part_.begin(), part_.end(), part);
    return "the part of the mesh with node " + std::to_string(first - part_.begin());
  }

 private:
  std::vector<Index> part_;
  Index count_ = 0;
};

}  // namespace stickslip
