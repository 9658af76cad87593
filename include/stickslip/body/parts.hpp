// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/dofs/index_map.hpp>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace stickslip {

/// The connected parts of the bodies: nodes belong to one part where a chain of cells joins them. Parts are numbered by
/// their first nodes.
class Parts {
 public:
  template <class BodiesType>
  Parts(const BodiesType& bodies, const IndexMap& dofs) : part_(static_cast<std::size_t>(bodies.node_count())) {
    std::iota(part_.begin(), part_.end(), 0);
    bodies.for_each([&](const auto& body) {
      for (const auto& cell : body.mesh().cells)
        for (const Index n : cell) join(body.first_node() + cell[0], body.first_node() + n);
    });
    // Linear constraints join the parts of their nodes.
    const Index dim = BodiesType::dim;
    for (const auto& d : dofs.dependents())
      for (const auto& m : d.masters)
        if (d.component / dim < nodes() && m.index / dim < nodes()) join(d.component / dim, m.index / dim);
    for (Index n = 0; n < nodes(); ++n) {
      Index& part = part_[static_cast<std::size_t>(n)];
      part = part == n ? count_++ : at(part);  // that of an earlier node, numbered already
    }
  }

  Index count() const { return count_; }
  /// Number of nodes; the components behind theirs are no node's.
  Index nodes() const { return static_cast<Index>(part_.size()); }
  /// The part of a node.
  Index at(Index node) const { return part_[static_cast<std::size_t>(node)]; }

  /// The name of a part: of the body that it is, or else of a side that lies in it, or else of a node. Empty where
  /// there is but one.
  template <class BodiesType>
  [[gnu::cold]] std::string name(Index part, const BodiesType& bodies) const {
    if (count_ == 1) return "";
    std::string name;
    bodies.for_each([&](const auto& body) {
      const auto inside = [&](Index n) { return at(body.first_node() + n) == part; };
      std::vector<Index> all(body.mesh().nodes.size());
      std::iota(all.begin(), all.end(), 0);
      if (!name.empty()) return;
      if (!body.name().empty() && std::all_of(all.begin(), all.end(), inside) &&
          std::count(part_.begin(), part_.end(), part) == std::ptrdiff_t(all.size())) {
        name = "body \"" + body.name() + "\"";
        return;
      }
      for (const auto& [side, of] : body.mesh().sides)
        if (name.empty() && !of.nodes.empty() && std::all_of(of.nodes.begin(), of.nodes.end(), inside))
          name = "the part of the mesh with side \"" + (body.name().empty() ? "" : body.name() + ".") + side + "\"";
    });
    if (!name.empty()) return name;
    const auto first = std::find(part_.begin(), part_.end(), part);
    return "the part of the mesh with node " + std::to_string(first - part_.begin());
  }

 private:
  // Trees of nodes, each on its part's least one.
  Index root(Index n) {
    while (at(n) != n) n = part_[static_cast<std::size_t>(n)] = at(at(n));
    return n;
  }
  void join(Index one, Index other) {
    const Index a = root(one), b = root(other);
    part_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  }

  std::vector<Index> part_;
  Index count_ = 0;
};

}  // namespace stickslip
