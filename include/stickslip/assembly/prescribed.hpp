// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/dofs.hpp>
#include <stickslip/base/outcome.hpp>

#include <cmath>
#include <functional>
#include <string>
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
  /// Of a body whose nodes have `dim` components each.
  explicit Prescribed(Index dim) : dim_(dim) {}

  /// Prescribes the displacement of a side's nodes; without a function they are held.
  void drive(const SideValue& side, const std::vector<Index>& nodes) {
    driven_.push_back({side.value, components(side, nodes), {}});
  }
  /// Loads a side's nodes with parts of a total force that go with their areas.
  void load(const SideValue& side, const std::vector<Index>& nodes, std::vector<Real> areas) {
    Real total = 0;
    for (const Real area : areas) total += area;
    for (Real& area : areas) area /= total;
    loads_.push_back({side.value, components(side, nodes), std::move(areas)});
  }

  /// The unknowns that are left of so many components.
  Dofs unknowns_of(Index components) const {
    std::vector<bool> constrained(static_cast<std::size_t>(components), false);
    for (const Values& d : driven_)
      for (const Index c : d.components) constrained[static_cast<std::size_t>(c)] = true;
    return Dofs(components, constrained);
  }

  /// Sets the driven and held components of a nodal field to their values at `time`.
  Trouble impose(Real time, Field& u) const {
    for (const Values& d : driven_) {
      const Real value = d.value ? d.value(time) : 0.0;
      if (!std::isfinite(value)) return not_finite(d);
      for (const Index c : d.components) u[c] = value;
    }
    return {};
  }
  /// Adds the loads at `time` to the nodal forces.
  Trouble add_loads(Real time, Field& forces) const {
    for (const Values& l : loads_) {
      const Real value = l.value(time);
      if (!std::isfinite(value)) return not_finite(l);
      for (std::size_t k = 0; k < l.components.size(); ++k) forces[l.components[k]] += l.shares[k] * value;
    }
    return {};
  }

 private:
  struct Values {
    std::function<Real(Real)> value;  // of a displacement, empty: held at zero
    std::vector<Index> components;
    std::vector<Real> shares;  // of a load
  };

  std::vector<Index> components(const SideValue& side, const std::vector<Index>& nodes) const {
    std::vector<Index> c = nodes;
    for (Index& n : c) n = n * dim_ + side.component;
    return c;
  }
  Trouble not_finite(const Values& of) const {
    return {Cause::not_finite, {Place::Kind::node, of.components.empty() ? -1 : of.components[0] / dim_}};
  }

  Index dim_;
  std::vector<Values> driven_, loads_;
};

}  // namespace stickslip
