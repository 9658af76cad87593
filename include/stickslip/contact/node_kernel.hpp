// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/contact_law.hpp>
#include <stickslip/policy/condensed_unknown.hpp>

#include <limits>

namespace stickslip {

/// What a contact node contributes.
template <class S, int dim, class Memory>
struct NodeContact {
  Vec<S, dim> force = Vec<S, dim>::Zero();      ///< R_C + R_F: the node's force on the tool [force]
  Mat<S, dim> stiffness = Mat<S, dim>::Zero();  ///< its derivative by the node's position, but for the coupling
  /// Derivative of the friction force by the pressure that it follows, where that is not symmetrised: see coupling [-].
  Vec<S, dim> friction_by_pressure = Vec<S, dim>::Zero();
  CondensedUnknown<S, dim> pressure{};  ///< -t_N [force]
  S bound = S(0);                       ///< largest friction force at the current pressure [force]
  S lag = S(0);                         ///< bound at the current pressure less the bound that was used [force]
  S dissipated = S(0);                  ///< work of friction in this step [energy]
  S lag_work = S(0);                    ///< work that friction would do besides at the current bound [energy]
  Vec<S, surface_coordinates<dim>> friction_force =
      Vec<S, surface_coordinates<dim>>::Zero();  ///< where to: the friction force then
  Vec<S, dim> stick_force =
      Vec<S, dim>::Zero();  ///< force that sticking would add to a node that is held (eq. 6.14) [force]
  FailureCause cause = FailureCause::none;
  bool touching = false;
  bool sliding = false;
  bool relaxed = false;  ///< whether its constraint is closed at a smaller stiffness than the enforcement's
  Memory memory{};

  /// What `stiffness` lacks to the whole: friction that follows the pressure, a dyad (eq. 5.9).
  Mat<S, dim> coupling() const { return product_transposed(friction_by_pressure, pressure.gradient); }
};

/// Turns a friction force that has followed a curved surface back into its tangent plane, its magnitude kept; the arc
/// length of the plane needs none of that (theory.md, eq. 4.15).
template <class S, int dim>
Vec<S, surface_coordinates<dim>> along_surface(const Vec<S, surface_coordinates<dim>>& traction,
                                               [[maybe_unused]] const Vec<S, dim>& normal) {
  if constexpr (dim == 2) {
    return traction;
  } else {
    const Vec<S, 3> flat = minus(traction, scaled(normal, contraction(normal, traction)));
    const S before = detail::magnitude<S, 3>(traction), after = detail::magnitude<S, 3>(flat);
    return value_of(after) > 0 ? scaled<S>(flat, before / after) : flat;
  }
}

/// Normal contact and friction of one node, in the tool's frame: contact_law at the closest point `at`. `slipped` is
/// the change of the place on the tool since the converged state.
template <class S, int dim, class Enforcement, class Law, class Friction>
NodeContact<S, dim, NodeMemory<S, dim, Enforcement, Friction>> contact_node(
    const Enforcement& enforcement, const Law& law, Friction friction, Real weight, const SurfacePoint<S, dim>& at,
    const Vec<S, surface_coordinates<dim>>& slipped, const NodeMemory<S, dim, Enforcement, Friction>& old,
    const S& pressure, Real dt, [[maybe_unused]] Real area = 0, [[maybe_unused]] bool held = false,
    Real stiffest = std::numeric_limits<Real>::infinity()) {
  constexpr int m = surface_coordinates<dim>;
  NodeContact<S, dim, NodeMemory<S, dim, Enforcement, Friction>> out;
  const auto node =
      contact_law<S, m>(enforcement, law, friction, weight, at.gap, slipped, old, pressure, dt, area, held, stiffest);
  out.touching = node.touching;
  out.memory = node.memory;
  if constexpr (Friction::active) out.memory.friction.surface_coordinate = at.surface_coordinate;
  if (!out.touching) return out;
  out.relaxed = node.relaxed;

  const S now = node.pressure;
  Vec<S, dim> by_pressure = scaled(at.normal, S(-1));  // d force / d pressure
  out.force = scaled(by_pressure, now);
  for (int j = 0; j < dim; ++j)
    for (int i = 0; i < dim; ++i)
      out.stiffness(i, j) = at.normal[i] * at.normal[j] * node.d_gap - at.hess_gap(i, j) * now;

  if constexpr (Friction::active) {
    using Pressure = typename Friction::Pressure;
    constexpr bool follows_pressure = Law::depends_on_pressure && Pressure::follows_current;
    const FrictionReturn<S, m>& end = node.friction;
    out.cause = node.cause;
    out.sliding = node.sliding;
    out.dissipated = node.dissipated;
    out.bound = node.bound;
    out.lag = node.lag;
    out.lag_work = node.lag_work;
    if (node.sliding) out.friction_force = end.traction;
    if (node.sliding && held) out.stick_force = product(at.grad_surface, node.to_stick);
    add(out.force, product(at.grad_surface, end.traction));
    add(out.stiffness, product_transposed(product(at.grad_surface, end.d_surface), at.grad_surface));
    for (int k = 0; k < m; ++k) add(out.stiffness, at.hess_surface[static_cast<std::size_t>(k)], end.traction[k]);
    if constexpr (follows_pressure) {
      const Vec<S, dim> of_friction = product(at.grad_surface, end.d_pressure);
      add(by_pressure, of_friction);
      if constexpr (!is_symmetrised<Pressure>()) out.friction_by_pressure = of_friction;
    }
    out.memory.friction.traction = along_surface<S, dim>(end.traction, at.normal);
  }
  out.pressure.value = now;
  out.pressure.residual = node.pressure_residual;
  out.pressure.gradient = scaled(at.normal, S(-node.d_gap));
  out.pressure.force = scaled<S>(by_pressure, out.pressure.residual * S(out.relaxed ? measured_closing : 1));
  return out;
}

}  // namespace stickslip
