// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/types.hpp>

#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// Which components are unknown, and their equation numbers: nodal ones, and behind them those of unknowns that are no
/// node's. A component that is held or driven has none; one that depends on others has theirs.
class IndexMap {
 public:
  static constexpr Index constrained = -1;

  /// An index with a weight [-].
  struct Weighted {
    Index index;
    Real weight;
  };
  /// A component that linear constraints make a sum of others, times weights, and an offset.
  struct Dependent {
    Index component;
    std::vector<Weighted> masters;  ///< components that are not dependent themselves
  };

  IndexMap() = default;
  [[gnu::cold]] IndexMap(Index components, const std::vector<bool>& is_constrained)
      : equation_(static_cast<std::size_t>(components)) {
    for (std::size_t i = 0; i < equation_.size(); ++i) {
      equation_[i] = is_constrained[i] ? constrained : unknowns_++;
      if (!is_constrained[i]) component_.push_back(static_cast<Index>(i));
    }
  }
  /// The same with dependent components, which must be among the constrained ones.
  [[gnu::cold]] IndexMap(Index components, const std::vector<bool>& is_constrained, std::vector<Dependent> dependents)
      : IndexMap(components, is_constrained) {
    dependents_ = std::move(dependents);
    for (std::size_t k = 0; k < dependents_.size(); ++k)
      dependent_.resize(equation_.size(), -1),
          dependent_[static_cast<std::size_t>(dependents_[k].component)] = static_cast<Index>(k);
  }
  const std::vector<Dependent>& dependents() const { return dependents_; }
  /// Whether a component is prescribed: a support holds or drives it.
  bool supported(Index component) const {
    return equation(component) == constrained &&
           (dependent_.empty() || dependent_[static_cast<std::size_t>(component)] < 0);
  }
  /// The unknowns that a component is made of: itself, those of its masters, or none.
  std::vector<Weighted> equations(Index component) const {
    if (equation(component) != constrained) return {{equation(component), 1}};
    std::vector<Weighted> list;
    if (!supported(component))
      for (const Weighted& m :
           dependents_[static_cast<std::size_t>(dependent_[static_cast<std::size_t>(component)])].masters)
        if (equation(m.index) != constrained) list.push_back({equation(m.index), m.weight});
    return list;
  }

  /// Number of unknowns.
  Index unknowns() const { return unknowns_; }
  /// Number of nodal components, the constrained ones among them.
  Index components() const { return static_cast<Index>(equation_.size()); }
  /// Equation of component node * dim + i, or `constrained`.
  Index equation(Index component) const { return equation_[static_cast<std::size_t>(component)]; }
  /// Component of an equation.
  Index component(Index equation) const { return component_[static_cast<std::size_t>(equation)]; }

  /// The forces on the unknowns, C^T of a field: of its own component each, and of those that depend on it.
  void gather(const Field& field, Field& unknowns) const {
    for (Index i = 0; i < components(); ++i)
      if (equation(i) != constrained) unknowns[equation(i)] = field[i];
    for (const Dependent& d : dependents_)
      for (const Weighted& m : d.masters)
        if (equation(m.index) != constrained) unknowns[equation(m.index)] += m.weight * field[d.component];
  }
  /// Adds factor * C * unknowns to a field.
  void scatter_add(Real factor, const Field& unknowns, Field& field) const {
    for (Index i = 0; i < components(); ++i)
      if (equation(i) != constrained) field[i] += factor * unknowns[equation(i)];
    for (const Dependent& d : dependents_)
      for (const Weighted& m : d.masters)
        if (equation(m.index) != constrained) field[d.component] += factor * m.weight * unknowns[equation(m.index)];
  }
  /// By which to tell whether another numbering is the same.
  [[gnu::cold]] std::string fingerprint() const {
    Digest digest;
    digest.add(equation_.data(), equation_.size());
    for (const Dependent& d : dependents_) {
      digest.add(&d.component, 1);
      for (const Weighted& m : d.masters) digest.add(&m.index, 1), digest.add(&m.weight, 1);
    }
    return std::to_string(unknowns_) + " unknowns of " + std::to_string(components()) + " components, " + digest.text();
  }

 private:
  std::vector<Index> equation_, component_;
  std::vector<Dependent> dependents_;
  std::vector<Index> dependent_;  // by component: its place among these, or -1; empty without any
  Index unknowns_ = 0;
};

}  // namespace stickslip
