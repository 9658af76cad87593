// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/node_kernel.hpp>
#include <stickslip/verify/report.hpp>

#include <vector>

namespace stickslip::verify {

/// One contact node against one tool at rest, without a body.
template <class Enforcement, class Law, class Friction, class Tool, int dim = 2>
struct SingleNode {
  Enforcement enforcement{};
  Law law{};
  Friction friction{};
  const Tool& tool;
  Real weight = 1;
  Real area = 1;  ///< reference area of the node [length^2], for laws that depend on it

  template <class S>
  using Memory = NodeMemory<S, dim, Enforcement, Friction>;

  /// Contact at the position x [length] with the memory `old`.
  template <class S>
  NodeContact<S, dim, Memory<S>> at(const Vec<S, dim>& x, const Memory<S>& old, Real dt = 1) const {
    const SurfacePoint<S, dim> point = surface_point<S, dim>(tool, x);
    return at_pressure(point, penalty_pressure(enforcement, weight, point.gap, old), old, dt);
  }

  /// The same with the condensed pressure open: at `pressure` [force] instead of the pressure of the gap.
  RelationSample<dim> open(const Vec<Real, dim>& x, const Memory<Real>& old, Real pressure, Real dt = 1) const {
    const auto node = at_pressure<Real>(surface_point<Real, dim>(tool, x), pressure, old, dt);
    return {node.force, node.stiffness + node.coupling(), node.pressure};
  }

  /// Memory after all but the last position of a path; the node starts at the first.
  template <class S>
  Memory<S> preloaded(const std::vector<Vec<Real, dim>>& path, Real dt = 1) const {
    Memory<S> memory{};
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      Vec<S, dim> x;
      for (int c = 0; c < dim; ++c) x[c] = S(path[i][c]);
      if constexpr (Friction::active)
        if (i == 0) memory.friction.surface_coordinate = surface_point<S, dim>(tool, x).surface_coordinate;
      memory = at<S>(x, memory, dt).memory;
    }
    return memory;
  }

 private:
  template <class S>
  NodeContact<S, dim, Memory<S>> at_pressure(const SurfacePoint<S, dim>& point, const S& pressure, const Memory<S>& old,
                                             Real dt) const {
    Vec<S, surface_coordinates<dim>> slipped = Vec<S, surface_coordinates<dim>>::Zero();
    if constexpr (Friction::active)
      slipped = relative_displacement<S, dim>(tool, point.surface_coordinate, old.friction.surface_coordinate);
    return contact_node<S, dim>(enforcement, law, friction, weight, point, slipped, old, pressure, dt, area);
  }
};

/// Tangent of contact and friction of a node at the last position of a path. The derivative of the force jumps where
/// the node touches and where it begins to slip: keep away from both by more than two `step`s [length].
template <class Enforcement, class Law, class Friction, class Tool, int dim>
TangentReport contact_tangent(const SingleNode<Enforcement, Law, Friction, Tool, dim>& node,
                              const std::vector<Vec<Real, dim>>& path, Real dt = 1, Real step = 1e-5) {
  const auto old = node.template preloaded<Real>(path, dt);
  const auto now = node.template at<Real>(path.back(), old, dt);
  const Mat<Real, dim> stiffness = now.stiffness + now.coupling();
  const auto dual_old = node.template preloaded<Dual<dim>>(path, dt);
  const Mat<Real, dim> by_duals =
      slopes<dim, dim>(node.template at<Dual<dim>>(seeded<dim>(path.back()), dual_old, dt).force);
  const Mat<Real, dim> by_differences = differentiate<dim, dim>(
      path.back(), step, [&](const Vec<Real, dim>& x) { return node.template at<Real>(x, old, dt).force; });
  return {relative_error(stiffness, by_duals), relative_error(stiffness, by_differences), asymmetry(stiffness)};
}

}  // namespace stickslip::verify
