// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/contact_kernel.hpp>
#include <stickslip/verify/report.hpp>

#include <vector>

namespace stickslip::verify {

/// One contact node against one tool at rest, without a body.
template <class Enforcement, class Law, class Friction, class Tool>
struct LoneNode {
  Enforcement enforcement{};
  Law law{};
  Friction friction{};
  const Tool& tool;
  Real weight = 1;
  Real area = 1;  ///< reference area of the node [length^2], for laws that ask for it

  template <class S>
  using Memory = NodeMemory<S, 2, Enforcement, Friction>;

  /// Contact at the place x on the memory `old`.
  template <class S>
  NodeContact<S, 2, Memory<S>> at(const Vec<S, 2>& x, const Memory<S>& old, Real dt = 1) const {
    const SurfacePoint<S, 2> point = tool.closest(x);
    return at_pressure(point, settled_pressure(enforcement, weight, point, old), old, dt);
  }

  /// The same at a pressure that is not the one of the gap.
  RelationSample<2> open(const Vec<Real, 2>& x, const Memory<Real>& old, Real pressure, Real dt = 1) const {
    const auto node = at_pressure<Real>(tool.closest(x), pressure, old, dt);
    return {node.force, node.stiffness, node.pressure};
  }

  /// The memory that all but the last place of a path leave; the first place is where the node starts.
  template <class S>
  Memory<S> preloaded(const std::vector<Vec<Real, 2>>& path, Real dt = 1) const {
    Memory<S> memory{};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Vec<S, 2> x{S(path[i][0]), S(path[i][1])};
      if constexpr (Friction::active)
        if (i == 0) memory.friction.place = tool.closest(x).place;
      memory = at<S>(x, memory, dt).memory;
    }
    return memory;
  }

 private:
  template <class S>
  NodeContact<S, 2, Memory<S>> at_pressure(const SurfacePoint<S, 2>& point, const S& pressure, const Memory<S>& old,
                                           Real dt) const {
    Vec<S, 1> slipped = Vec<S, 1>::Zero();
    if constexpr (Friction::active) slipped[0] = tool.difference(point.place[0], old.friction.place[0]);
    return contact_node<S, 2>(enforcement, law, friction, weight, point, slipped, old, pressure, dt, area);
  }
};

/// Tangent of contact and friction of a node at the last of a path of places. The slope of the force jumps where the
/// node touches, and where it begins to slide: stay off these by more than two `step`s.
template <class Enforcement, class Law, class Friction, class Tool>
TangentReport contact_tangent(const LoneNode<Enforcement, Law, Friction, Tool>& node,
                              const std::vector<Vec<Real, 2>>& path, Real dt = 1, Real step = 1e-5) {
  const auto old = node.template preloaded<Real>(path, dt);
  const Mat<Real, 2> stiffness = node.template at<Real>(path.back(), old, dt).stiffness;
  const auto dual_old = node.template preloaded<Dual<2>>(path, dt);
  const Mat<Real, 2> by_duals = slopes<2, 2>(node.template at<Dual<2>>(seeded<2>(path.back()), dual_old, dt).force);
  const Mat<Real, 2> by_differences = differentiate<2, 2>(
      path.back(), step, [&](const Vec<Real, 2>& x) { return node.template at<Real>(x, old, dt).force; });
  return {relative_error(stiffness, by_duals), relative_error(stiffness, by_differences), asymmetry(stiffness)};
}

}  // namespace stickslip::verify
