// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/stored_if.hpp>
#include <stickslip/contact/friction_return.hpp>
#include <stickslip/geometry/surface_point.hpp>
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

/// What the laws of a contact node say, along the normal and along the surface. `m` surface coordinates.
template <class S, int m, class Memory>
struct ContactResponse {
  S pressure = S(0);                       ///< p = -t_N [force]
  S pressure_residual = S(0);              ///< what the gap asks for, less that [force]
  S d_gap = S(0);                          ///< derivative of t_N by the gap [force / length]
  FrictionReturn<S, m> friction{};         ///< t_F and its derivatives
  Vec<S, m> to_stick = Vec<S, m>::Zero();  ///< what sticking would add to t_F of a node that is held (eq. 6.14) [force]
  S bound = S(0);                          ///< largest friction force at the current pressure [force]
  S lag = S(0);                            ///< bound at the current pressure less the bound that was used [force]
  S dissipated = S(0);                     ///< work of friction in this step [energy]
  S lag_work = S(0);                       ///< work that friction would do besides at the current bound [energy]
  FailureCause cause = FailureCause::none;
  bool touching = false;
  bool sliding = false;
  bool relaxed = false;  ///< whether its constraint is closed at a smaller stiffness than the enforcement's
  Memory memory{};       ///< the traction in it is t_F, the surface coordinate the old one
};

/// The largest stiffness at which an iteration closes the gap of a node, in parts of the body's there: its round-off is
/// 2^-30 of the body's, what a step leaves of the gap takes 2^-22 of its change of the pressure (theory.md, eq. 6.21,
/// 6.23).
inline constexpr Real largest_closing_stiffness = 0x1p22;
/// The part of it at which a gap that is left counts as a force: it can make none beyond the body's stiffness times it.
inline constexpr Real measured_closing = 0x1p-16;

/// The pressure that a gap asks for: -t_N where that presses [force].
template <class S, class Enforcement, class Memory>
S penalty_pressure(const Enforcement& enforcement, Real weight, const S& gap, const Memory& old) {
  const S pressure = -enforcement.normal_force(gap, weight, old.enforcement).value;
  return value_of(pressure) > 0 ? pressure : S(0);
}

/// Normal contact and friction of one node (theory.md, eq. 4.4-4.6, 5.1-5.9 and 6.11), whatever its gap and its slip
/// are functions of. `slipped` is the change of its place on the surface since the converged state, `pressure` the one
/// that the iteration has; a node touches while it is positive, or once the gap asks for one. `area` is the reference
/// area that the node carries, looked at only by a law that asks for it. A sliding node that is `held` is linearised as
/// one that sticks. The constraint of an enforcement stiffer than `stiffest` is closed at that stiffness (eq. 6.22).
template <class S, int m, class Enforcement, class Law, class Friction, class Memory>
ContactResponse<S, m, Memory> contact_law(const Enforcement& enforcement, const Law& law, Friction, Real weight,
                                          const S& gap, const Vec<S, m>& slipped, const Memory& old, const S& pressure,
                                          Real dt, [[maybe_unused]] Real area = 0, [[maybe_unused]] bool held = false,
                                          Real stiffest = std::numeric_limits<Real>::infinity()) {
  ContactResponse<S, m, Memory> out;
  const NormalForce<S> normal = enforcement.normal_force(gap, weight, old.enforcement);
  out.touching = value_of(normal.value) <= 0 || value_of(pressure) > 0;
  if constexpr (Friction::active) {
    out.memory.friction.surface_coordinate = old.friction.surface_coordinate;
    out.memory.friction.accumulated_slip = old.friction.accumulated_slip;
  }
  if (!out.touching) return out;
  const S now = value_of(pressure) > 0 ? pressure : S(0);
  out.pressure = now;
  out.relaxed = value_of(normal.d_gap) > stiffest;
  out.d_gap = out.relaxed ? S(stiffest) : normal.d_gap;
  out.pressure_residual = -normal.value - now;
  if (out.relaxed) out.pressure_residual = out.pressure_residual / normal.d_gap * out.d_gap;

  if constexpr (Friction::active) {
    using Pressure = typename Friction::Pressure;
    const S stiffness = S(enforcement.stick_stiffness(weight));
    S bound_pressure = now;
    if constexpr (Law::depends_on_pressure) bound_pressure = Pressure::pressure(now, old.friction.pressure, dt);
    const auto bound_at = [&](const S& normal_force, const S& slide) {
      return bound_after(law, normal_force, old.friction.accumulated_slip, slide, area, dt);
    };
    Vec<S, m> trial = old.friction.traction;
    add(trial, slipped, stiffness);
    FrictionReturn<S, m>& end = out.friction;
    if constexpr (is_anisotropic<Law>)
      end = elliptic_return<S>(trial, stiffness, law.metric(), bound_at(bound_pressure, S(0)));
    else
      end = radial_return<Law, S, m>(trial, stiffness, [&](const S& slide) { return bound_at(bound_pressure, slide); });
    out.cause = end.cause;
    out.sliding = end.sliding;
    out.memory.friction.accumulated_slip = old.friction.accumulated_slip + end.slip_increment;
    out.dissipated = end.bound * end.slip_increment;
    if (end.sliding && held) {
      out.to_stick = minus(trial, end.traction);
      end.d_surface = isotropic<m>(stiffness);
      end.d_pressure.setZero();
    }
    out.bound = end.bound;
    if constexpr (Law::depends_on_pressure && !Pressure::follows_current) {
      out.bound = bound_at(now, end.slip_increment).value;
      out.lag = out.bound - end.bound;
      out.lag_work = out.lag * end.slip_increment;
    }
    out.memory.friction.traction = end.traction;
    if constexpr (Law::depends_on_pressure)
      out.memory.friction.pressure = Pressure::advance(now, old.friction.pressure, dt);
  }
  if constexpr (is_augmented<Enforcement>) out.memory.enforcement = enforcement.augmented(now);
  return out;
}

}  // namespace stickslip
