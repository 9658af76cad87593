// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/dofs/index_map.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// A component of all nodes of a side, as a function of time.
struct SideValue {
  std::string side;
  Index component;
  std::function<Real(Real)> value;  ///< displacement [length] or total force [force]
};

/// What functions of time prescribe at nodal components: the displacements of some, forces on others.
class Prescribed {
 public:
  /// Of a body of the size `extent` [length], whose nodes have `dim` components each.
  explicit Prescribed(Index dim, Real extent = 0) : dim_(dim), extent_(extent) {}

  /// Prescribes the displacement of a side's nodes; without a function they are held. Sides may share nodes, where they
  /// prescribe the same.
  [[gnu::cold]] void drive(const SideValue& side, const std::vector<Index>& nodes) {
    const auto number = driven_.size();
    driven_.push_back({side.side, side.value, components(side, nodes), {}});
    for (const Index c : driven_.back().components) {
      const auto [by, first] = driven_by_.emplace(c, number);
      if (!first && by->second != number && (side.value || driven_[by->second].value) &&
          (shared_.empty() || shared_.back().one != by->second || shared_.back().other != number))
        shared_.push_back({by->second, number, c});
    }
  }
  /// Loads a side's nodes with parts of a total force that go with their areas.
  [[gnu::cold]] void load(const SideValue& side, const std::vector<Index>& nodes, std::vector<Real> areas) {
    Real total = 0;
    for (const Real area : areas) total += area;
    for (Real& area : areas) area /= total;
    loads_.push_back({side.side, side.value, components(side, nodes), std::move(areas)});
  }

  /// Makes a component depend on others, u = sum of weight * u_master + offset(time); without a function the offset is
  /// zero. Where a support prescribes the component, the support stands and the constraint is a fault: see
  /// `unknowns_of`.
  [[gnu::cold]] void constrain(IndexMap::Dependent dependent, std::function<Real(Real)> offset = {}) {
    dependents_.push_back({std::move(dependent), std::move(offset)});
  }

  /// The unknowns that are left of so many components; with `assembled` the dependent ones among them, as forces and
  /// stiffness are assembled before constraints are condensed. Throws std::invalid_argument where a dependent component
  /// is prescribed, depends on a dependent one or does so twice.
  [[gnu::cold]] IndexMap unknowns_of(Index components, bool assembled = false) const {
    std::vector<bool> constrained(static_cast<std::size_t>(components), false);
    for (const Values& d : driven_)
      for (const Index c : d.components) constrained[static_cast<std::size_t>(c)] = true;
    if (assembled || dependents_.empty()) return IndexMap(components, constrained);
    std::vector<bool> dependent(constrained.size(), false);
    std::vector<IndexMap::Dependent> list;
    for (const Linear& l : dependents_) {
      const auto c = static_cast<std::size_t>(l.of.component);
      if (constrained[c] || dependent[c])
        throw std::invalid_argument("linear constraint: component " + std::to_string(l.of.component % dim_) +
                                    " of node " + std::to_string(l.of.component / dim_) +
                                    (dependent[c] ? " depends on others twice" : " has a support as well"));
      dependent[c] = true;
      list.push_back(l.of);
    }
    for (const Linear& l : dependents_)
      for (const IndexMap::Weighted& m : l.of.masters)
        if (dependent[static_cast<std::size_t>(m.index)])
          throw std::invalid_argument("linear constraint: component " + std::to_string(m.index % dim_) + " of node " +
                                      std::to_string(m.index / dim_) + " depends on others itself");
    for (std::size_t c = 0; c < dependent.size(); ++c) constrained[c] = constrained[c] || dependent[c];
    return IndexMap(components, constrained, std::move(list));
  }

  /// Sets the driven and held components of a nodal field to their values at `time`.
  Failure apply_constraints(Real time, Field& u) const {
    for (const Values& d : driven_) {
      const Real value = d.value ? d.value(time) : 0.0;
      if (!std::isfinite(value)) return not_finite(d);
      for (const Index c : d.components) u[c] = value;
    }
    for (const Linear& l : dependents_) {
      Real value = l.offset ? l.offset(time) : 0;
      for (const IndexMap::Weighted& m : l.of.masters) value += m.weight * u[m.index];
      if (!std::isfinite(value)) return {FailureCause::not_finite, {Location::Kind::node, l.of.component / dim_}};
      u[l.of.component] = value;
    }
    for (const Shared& s : shared_)
      if (contradicts(s, time))
        return {FailureCause::contradicting_supports, {Location::Kind::node, s.component / dim_}};
    return {};
  }
  /// Which supports prescribe different values of one component at `time`, in words; empty if none do.
  [[gnu::cold]] std::string contradiction(Real time) const {
    for (const Shared& s : shared_) {
      if (!contradicts(s, time)) continue;
      const Values &one = driven_[s.one], &other = driven_[s.other];
      return "at node " + std::to_string(s.component / dim_) + ", component " + std::to_string(s.component % dim_) +
             ", side \"" + one.side + "\" is at " + brief(at(one, time)) + " and side \"" + other.side + "\" at " +
             brief(at(other, time)) + " at time " + brief(time);
    }
    return "";
  }
  /// Adds the loads at `time` to the nodal forces.
  Failure add_loads(Real time, Field& forces) const {
    for (const Values& l : loads_) {
      const Real value = l.value(time);
      if (!std::isfinite(value)) return not_finite(l);
      for (std::size_t k = 0; k < l.components.size(); ++k) forces[l.components[k]] += l.shares[k] * value;
    }
    return {};
  }

 private:
  struct Values {
    std::string side;
    std::function<Real(Real)> value;  // of a displacement, empty: held at zero
    std::vector<Index> components;
    std::vector<Real> shares;  // of a load
  };

  struct Linear {
    IndexMap::Dependent of;
    std::function<Real(Real)> offset;
  };
  // A component that two supports prescribe, the first of those that they share.
  struct Shared {
    std::size_t one, other;
    Index component;
  };
  static Real at(const Values& of, Real time) { return of.value ? of.value(time) + 0.0 : 0; }  // no -0
  bool contradicts(const Shared& s, Real time) const {
    const Real one = at(driven_[s.one], time), other = at(driven_[s.other], time);
    const Real rounded = 16 * std::numeric_limits<Real>::epsilon() * extent_;
    return std::abs(one - other) > 1e-9 * std::max(std::abs(one), std::abs(other)) + rounded;
  }

  std::vector<Index> components(const SideValue& side, const std::vector<Index>& nodes) const {
    std::vector<Index> c = nodes;
    for (Index& n : c) n = n * dim_ + side.component;
    return c;
  }
  Failure not_finite(const Values& of) const {
    return {FailureCause::not_finite, {Location::Kind::node, of.components.empty() ? -1 : of.components[0] / dim_}};
  }

  Index dim_;
  Real extent_;
  std::vector<Values> driven_, loads_;
  std::map<Index, std::size_t> driven_by_;  // the first support of a component
  std::vector<Shared> shared_;
  std::vector<Linear> dependents_;
};

}  // namespace stickslip
