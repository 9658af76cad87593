// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/types.hpp>

#include <string>
#include <vector>

namespace stickslip {

/// Which nodal components are unknown, and their equation numbers. A component that is held or driven has none.
class IndexMap {
 public:
  static constexpr Index constrained = -1;

  IndexMap() = default;
  IndexMap(Index components, const std::vector<bool>& is_constrained)
      : equation_(static_cast<std::size_t>(components)) {
    for (std::size_t i = 0; i < equation_.size(); ++i) {
      equation_[i] = is_constrained[i] ? constrained : unknowns_++;
      if (!is_constrained[i]) component_.push_back(static_cast<Index>(i));
    }
  }
  /// Number of unknowns.
  Index unknowns() const { return unknowns_; }
  /// Number of nodal components, the constrained ones among them.
  Index components() const { return static_cast<Index>(equation_.size()); }
  /// Equation of component node * dim + i, or `constrained`.
  Index equation(Index component) const { return equation_[static_cast<std::size_t>(component)]; }
  /// Component of an equation.
  Index component(Index equation) const { return component_[static_cast<std::size_t>(equation)]; }

  /// Picks the unknowns out of a nodal field.
  void gather(const Field& field, Field& unknowns) const {
    for (Index i = 0; i < components(); ++i)
      if (equation(i) != constrained) unknowns[equation(i)] = field[i];
  }
  /// Adds factor * unknowns to a nodal field.
  void scatter_add(Real factor, const Field& unknowns, Field& field) const {
    for (Index i = 0; i < components(); ++i)
      if (equation(i) != constrained) field[i] += factor * unknowns[equation(i)];
  }
  /// By which to tell whether another numbering is the same.
  std::string fingerprint() const {
    Digest digest;
    digest.add(equation_.data(), equation_.size());
    return std::to_string(unknowns_) + " unknowns of " + std::to_string(components()) + " components, " + digest.text();
  }

 private:
  std::vector<Index> equation_, component_;
  Index unknowns_ = 0;
};

}  // namespace stickslip
