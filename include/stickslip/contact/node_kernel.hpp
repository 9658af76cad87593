// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/stored_if.hpp>
#include <stickslip/contact/friction_return.hpp>
#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/policy/condensed_unknown.hpp>
#include <stickslip/policy/enforcement.hpp>
#include <stickslip/policy/friction.hpp>
#include <stickslip/tensor/products.hpp>

#include <limits>

namespace stickslip {

/// What a node in frictional contact remembers; of the pressure only if the bound depends on it.
template <class S, int dim, class Friction>
struct FrictionMemory {
  using Pressure =
      StoredIf<Friction::Law::depends_on_pressure, typename Friction::Pressure::template Memory<S>, Friction>;

  static constexpr int places = surface_coordinates<dim>;

  Vec<S, places> traction = Vec<S, places>::Zero();            ///< t_F, work conjugate to the place on the tool [force]
  Vec<S, places> surface_coordinate = Vec<S, places>::Zero();  ///< of the closest point, in the tool's frame [length]
  S accumulated_slip = S(0);                                   ///< slid distance so far [length]
  [[no_unique_address]] Pressure pressure{};

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("traction", self.traction);
    visit("surface_coordinate", self.surface_coordinate);
    visit("accumulated_slip", self.accumulated_slip);
    visit("pressure", self.pressure);
  }
};

namespace detail {
template <class S, int dim, class Friction, bool active = Friction::active>
struct FrictionMemoryOf {
  using type = FrictionMemory<S, dim, Friction>;
};
template <class S, int dim, class Friction>
struct FrictionMemoryOf<S, dim, Friction, false> {
  using type = Empty<Friction>;
};
}  // namespace detail

/// What a contact node remembers: the friction's memory and the enforcement's, each only where there is one.
template <class S, int dim, class Enforcement, class Friction>
struct NodeMemory {
  [[no_unique_address]] typename detail::FrictionMemoryOf<S, dim, Friction>::type friction{};
  [[no_unique_address]] typename Enforcement::template Memory<S> enforcement{};

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("friction", self.friction);
    visit("enforcement", self.enforcement);
  }
};

/// What a contact node contributes.
template <class S, int dim, class Memory>
struct NodeContact {
  Vec<S, dim> force = Vec<S, dim>::Zero();      ///< R_C + R_F: the node's force on the tool [force]
  Mat<S, dim> stiffness = Mat<S, dim>::Zero();  ///< its derivative by the node's position, but for the coupling
  Mat<S, dim> coupling = Mat<S, dim>::Zero();   ///< the rest: friction that follows the pressure (eq. 5.9)
  CondensedUnknown<S, dim> pressure{};          ///< -t_N [force]
  S bound = S(0);                               ///< largest friction force at the current pressure [force]
  S lag = S(0);                                 ///< bound at the current pressure less the bound that was used [force]
  S dissipated = S(0);                          ///< work of friction in this step [energy]
  S lag_work = S(0);                            ///< work that friction would do besides at the current bound [energy]
  Vec<S, surface_coordinates<dim>> friction_force =
      Vec<S, surface_coordinates<dim>>::Zero();  ///< where to: the friction force then
  Vec<S, dim> stick_force =
      Vec<S, dim>::Zero();  ///< force that sticking would add to a node that is held (eq. 6.14) [force]
  FailureCause cause = FailureCause::none;
  bool touching = false;
  bool sliding = false;
  bool relaxed = false;  ///< whether its constraint is closed at a smaller stiffness than the enforcement's
  Memory memory{};
};

/// The largest stiffness at which an iteration closes the gap of a node, in parts of the body's there: its round-off is
/// 2^-30 of the body's, what a step leaves of the gap takes 2^-22 of its change of the pressure (theory.md, eq. 6.21,
/// 6.23).
inline constexpr Real largest_closing_stiffness = 0x1p22;
/// The part of it at which a gap that is left counts as a force: it can make none beyond the body's stiffness times it.
inline constexpr Real measured_closing = 0x1p-16;

/// The pressure that a gap asks for: -t_N where that presses [force].
template <class S, int dim, class Enforcement, class Memory>
S penalty_pressure(const Enforcement& enforcement, Real weight, const SurfacePoint<S, dim>& at, const Memory& old) {
  const S pressure = -enforcement.normal_force(at.gap, weight, old.enforcement).value;
  return value_of(pressure) > 0 ? pressure : S(0);
}

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

/// Normal contact and friction of one node, in the tool's frame (theory.md, eq. 4.4-4.6, 5.1-5.9 and 6.11). `slipped`
/// is the change of the place on the tool since the converged state, `pressure` the one that the iteration has; a node
/// touches while it is positive, or once the gap asks for one. `area` is the reference area that the node carries,
/// looked at only by a law that asks for it. A sliding node that is `held` is linearised as one that sticks. The
/// constraint of an enforcement stiffer than `stiffest` is closed at that stiffness (eq. 6.22).
template <class S, int dim, class Enforcement, class Law, class Friction>
NodeContact<S, dim, NodeMemory<S, dim, Enforcement, Friction>> contact_node(
    const Enforcement& enforcement, const Law& law, Friction, Real weight, const SurfacePoint<S, dim>& at,
    const Vec<S, surface_coordinates<dim>>& slipped, const NodeMemory<S, dim, Enforcement, Friction>& old,
    const S& pressure, Real dt, [[maybe_unused]] Real area = 0, [[maybe_unused]] bool held = false,
    Real stiffest = std::numeric_limits<Real>::infinity()) {
  NodeContact<S, dim, NodeMemory<S, dim, Enforcement, Friction>> out;
  const NormalForce<S> normal = enforcement.normal_force(at.gap, weight, old.enforcement);
  out.touching = value_of(normal.value) <= 0 || value_of(pressure) > 0;
  if constexpr (Friction::active) {
    out.memory.friction.surface_coordinate = at.surface_coordinate;
    out.memory.friction.accumulated_slip = old.friction.accumulated_slip;
  }
  if (!out.touching) return out;

  out.relaxed = value_of(normal.d_gap) > stiffest;
  const S slope = out.relaxed ? S(stiffest) : normal.d_gap;
  const S now = value_of(pressure) > 0 ? pressure : S(0);
  Vec<S, dim> by_pressure = scaled(at.normal, S(-1));  // d force / d pressure
  out.force = scaled(by_pressure, now);
  for (int j = 0; j < dim; ++j)
    for (int i = 0; i < dim; ++i) out.stiffness(i, j) = at.normal[i] * at.normal[j] * slope - at.hess_gap(i, j) * now;

  if constexpr (Friction::active) {
    using Pressure = typename Friction::Pressure;
    constexpr int m = surface_coordinates<dim>;
    constexpr bool follows_pressure = Law::depends_on_pressure && Pressure::follows_current;
    const S stiffness = S(enforcement.stick_stiffness(weight));
    S bound_pressure = now;
    if constexpr (Law::depends_on_pressure) bound_pressure = Pressure::pressure(now, old.friction.pressure, dt);
    const auto bound_at = [&](const S& normal_force, const S& slide) {
      return bound_after(law, normal_force, old.friction.accumulated_slip, slide, area, dt);
    };
    Vec<S, m> trial = old.friction.traction;
    add(trial, slipped, stiffness);
    FrictionReturn<S, m> end;
    if constexpr (is_anisotropic<Law>)
      end = elliptic_return<S>(trial, stiffness, law.metric(), bound_at(bound_pressure, S(0)));
    else
      end = radial_return<Law, S, m>(trial, stiffness, [&](const S& slide) { return bound_at(bound_pressure, slide); });
    out.cause = end.cause;
    out.sliding = end.sliding;
    out.memory.friction.accumulated_slip = old.friction.accumulated_slip + end.slip_increment;
    out.dissipated = end.bound * end.slip_increment;
    if (end.sliding) out.friction_force = end.traction;
    if (end.sliding && held) {
      out.stick_force = product(at.grad_surface, minus(trial, end.traction));
      end.d_surface = isotropic<m>(stiffness);
      end.d_pressure.setZero();
    }
    add(out.force, product(at.grad_surface, end.traction));
    add(out.stiffness, product_transposed(product(at.grad_surface, end.d_surface), at.grad_surface));
    for (int k = 0; k < m; ++k) add(out.stiffness, at.hess_surface[static_cast<std::size_t>(k)], end.traction[k]);
    if constexpr (follows_pressure) {
      const Vec<S, dim> of_friction = product(at.grad_surface, end.d_pressure);
      add(by_pressure, of_friction);
      if constexpr (!is_symmetrised<Pressure>())
        out.coupling = product_transposed(of_friction, scaled(at.normal, S(-slope)));
    }

    out.bound = end.bound;
    if constexpr (Law::depends_on_pressure && !Pressure::follows_current) {
      out.bound = bound_at(now, end.slip_increment).value;
      out.lag = out.bound - end.bound;
      out.lag_work = out.lag * end.slip_increment;
    }
    out.memory.friction.traction = along_surface<S, dim>(end.traction, at.normal);
    if constexpr (Law::depends_on_pressure)
      out.memory.friction.pressure = Pressure::advance(now, old.friction.pressure, dt);
  }
  if constexpr (is_augmented<Enforcement>) out.memory.enforcement = enforcement.augmented(now);
  out.pressure.value = now;
  out.pressure.residual = -normal.value - now;
  if (out.relaxed) out.pressure.residual = out.pressure.residual / normal.d_gap * slope;
  out.pressure.gradient = scaled(at.normal, S(-slope));
  out.pressure.force = scaled<S>(by_pressure, out.pressure.residual * S(out.relaxed ? measured_closing : 1));
  return out;
}

}  // namespace stickslip
