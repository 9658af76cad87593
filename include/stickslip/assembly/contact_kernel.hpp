// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nothing.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/policy/enforcement.hpp>
#include <stickslip/policy/friction.hpp>
#include <stickslip/policy/stiff_relation.hpp>

#include <cmath>

namespace stickslip {

/// What a node in frictional contact remembers; of the pressure only if the bound depends on it.
template <class S, int dim, class Friction>
struct FrictionMemory {
  using Pressure = Only<Friction::Law::depends_on_pressure, typename Friction::Pressure::template Memory<S>, Friction>;

  Vec<S, dim - 1> traction =
      Vec<S, dim - 1>::Zero();                      ///< t_F, work conjugate to the tool's surface coordinates [force]
  Vec<S, dim - 1> place = Vec<S, dim - 1>::Zero();  ///< surface coordinates of the closest point [length]
  S slip = S(0);                                    ///< slid distance so far [length]
  [[no_unique_address]] Pressure pressure{};
};

namespace detail {
template <class S, int dim, class Friction, bool active = Friction::active>
struct FrictionMemoryOf {
  using type = FrictionMemory<S, dim, Friction>;
};
template <class S, int dim, class Friction>
struct FrictionMemoryOf<S, dim, Friction, false> {
  using type = Nothing<Friction>;
};
}  // namespace detail

/// What a contact node remembers: the friction's memory and the enforcement's, each only where there is one.
template <class S, int dim, class Enforcement, class Friction>
struct NodeMemory {
  [[no_unique_address]] typename detail::FrictionMemoryOf<S, dim, Friction>::type friction{};
  [[no_unique_address]] typename Enforcement::template Memory<S> enforcement{};
};

/// What a contact node contributes.
template <class S, int dim, class Memory>
struct NodeContact {
  Vec<S, dim> force = Vec<S, dim>::Zero();      ///< R_C + R_F: the node's force on the tool [force]
  Mat<S, dim> stiffness = Mat<S, dim>::Zero();  ///< its derivative by the node's position
  StiffRelation<S, dim> pressure{};             ///< -t_N [force]
  S bound = S(0);                               ///< largest friction force at the current pressure [force]
  S lag = S(0);                                 ///< bound at the current pressure less the bound that was used [force]
  S dissipated = S(0);                          ///< work of friction in this step [energy]
  Cause cause = Cause::none;
  bool touching = false;
  bool sliding = false;
  Memory memory{};
};

/// The pressure that a gap asks for: -t_N where it is closed [force].
template <class S, int dim, class Enforcement, class Memory>
S settled_pressure(const Enforcement& enforcement, Real weight, const SurfacePoint<S, dim>& at, const Memory& old) {
  return value_of(at.gap) <= 0 ? S(-enforcement.normal_force(at.gap, weight, old.enforcement).value) : S(0);
}

/// Normal contact and friction of one node, in the tool's frame (theory.md, eq. 4.4-4.6, 5.1-5.9 and 6.7). `slipped` is
/// the change of the surface coordinates since the converged state, `pressure` the one that the iteration has; a node
/// touches while it is positive, or once the gap is closed. `area` is the reference area that the node carries, looked
/// at only by a law that asks for it.
template <class S, int dim, class Enforcement, class Law, class Friction>
NodeContact<S, dim, NodeMemory<S, dim, Enforcement, Friction>> contact_node(
    const Enforcement& enforcement, const Law& law, Friction, Real weight, const SurfacePoint<S, dim>& at,
    const Vec<S, dim - 1>& slipped, const NodeMemory<S, dim, Enforcement, Friction>& old, const S& pressure, Real dt,
    [[maybe_unused]] Real area = 0) {
  using std::sqrt;
  NodeContact<S, dim, NodeMemory<S, dim, Enforcement, Friction>> out;
  out.memory.enforcement = old.enforcement;
  out.touching = value_of(at.gap) <= 0 || value_of(pressure) > 0;
  if constexpr (Friction::active) {
    out.memory.friction.place = at.place;
    out.memory.friction.slip = old.friction.slip;
  }
  if (!out.touching) return out;

  const NormalForce<S> normal = enforcement.normal_force(at.gap, weight, old.enforcement);
  const S now = value_of(pressure) > 0 ? pressure : S(0);
  Vec<S, dim> by_pressure = -at.normal;  // d force / d pressure
  out.force = by_pressure * now;
  out.stiffness = at.normal * at.normal.transpose() * normal.d_gap - at.hess_gap * now;

  if constexpr (Friction::active) {
    using Pressure = typename Friction::Pressure;
    constexpr int m = dim - 1;
    const S stiffness = S(enforcement.stick_stiffness(weight));
    constexpr bool follows_pressure = Law::depends_on_pressure && Pressure::follows_current;
    S felt = now;
    if constexpr (Law::depends_on_pressure) felt = Pressure::pressure(now, old.friction.pressure, dt);
    // The bound at a normal force and at the end of a slide; its d_slip is the whole derivative by the slide, that of
    // the speed slide / dt included (eq. 5.17). In a step without duration there is no speed.
    const auto bound_after = [&](const S& normal_force, [[maybe_unused]] const S& slide) {
      FrictionPoint<S> point{normal_force, old.friction.slip};
      if constexpr (depends_on_area<Law>()) point.area = area;
      if constexpr (Law::depends_on_slip) point.slip += slide;
      if constexpr (depends_on_rate<Law>()) {
        const Real per_time = dt > 0 ? 1 / dt : 0;
        point.rate = slide * per_time;
        FrictionBound<S> there = law.bound(point);
        there.d_slip += there.d_rate * per_time;
        return there;
      } else {
        return law.bound(point);
      }
    };
    const Vec<S, m> trial = old.friction.traction + slipped * stiffness;
    // The magnitude of one component is exact; a root would lose the derivative at zero.
    S size;
    if constexpr (m == 1)
      size = value_of(trial[0]) < 0 ? S(-trial[0]) : S(trial[0]);
    else
      size = value_of(trial.squaredNorm()) > 0 ? S(sqrt(trial.squaredNorm())) : S(0);

    // Radial return: |t_F| = size - stiffness lambda = bound(pressure, slip + lambda).
    FrictionBound<S> bound = bound_after(felt, S(0));
    [[maybe_unused]] S lambda = S(0);
    Vec<S, m> traction = trial;
    Mat<S, m> d_trial = Mat<S, m>::Identity() * stiffness;  // d traction / d place
    Vec<S, m> d_pressure = Vec<S, m>::Zero();               // d traction / d pressure
    if (!(value_of(size) < value_of(bound.value))) {
      out.sliding = true;
      if (value_of(stiffness) > 0) lambda = (size - bound.value) / stiffness;
      if constexpr (Law::depends_on_slip || depends_on_rate<Law>()) {
        // The excess is not negative without a slide and not positive at size / stiffness: Newton's method between the
        // two, halving where it leaves them or would go up a slope (eq. 5.18).
        Real low = 0, high = value_of(size) / value_of(stiffness);
        bool converged = value_of(stiffness) <= 0;
        for (int i = 0; i < 60 && !converged; ++i) {
          bound = bound_after(felt, lambda);
          const S excess = size - stiffness * lambda - bound.value;
          const S next = lambda + excess / (stiffness + bound.d_slip);
          converged = std::abs(value_of(excess)) <= 1e-14 * value_of(size);
          (value_of(excess) > 0 ? low : high) = value_of(lambda);
          lambda = converged || (value_of(next) > low && value_of(next) < high) ? next : S(0.5 * (low + high));
        }
        if (!converged) out.cause = Cause::friction_failed;
        // At the slide of the last step, which carries the derivatives of a dual number.
        bound = bound_after(felt, lambda);
      }
      const Vec<S, m> direction = value_of(size) > 0 ? Vec<S, m>(trial / size) : Vec<S, m>(Vec<S, m>::Zero());
      // A slide at which the bound falls faster than the stiffness unloads is not an equilibrium that could last; no
      // stiffness, no slip to solve for.
      const S resistance = stiffness + bound.d_slip;
      if (value_of(stiffness) > 0 && !(value_of(resistance) > 0)) out.cause = Cause::friction_failed;
      const S share = value_of(stiffness) > 0 ? S(stiffness / resistance) : S(0);
      const S ratio = value_of(size) > 0 ? S(bound.value / size) : S(0);
      traction = direction * bound.value;
      d_trial = (Mat<S, m>::Identity() - direction * direction.transpose()) * S(ratio * stiffness) +
                direction * direction.transpose() * S(share * bound.d_slip);
      if constexpr (follows_pressure) d_pressure = direction * S(share * bound.d_pressure);
      out.memory.friction.slip = old.friction.slip + lambda;
      out.dissipated = bound.value * lambda;
    }
    out.force += at.grad_place * traction;
    out.stiffness += at.grad_place * d_trial * at.grad_place.transpose();
    for (int k = 0; k < m; ++k) out.stiffness += at.hess_place[static_cast<std::size_t>(k)] * traction[k];
    if constexpr (follows_pressure) {
      by_pressure += at.grad_place * d_pressure;
      out.stiffness -= at.grad_place * d_pressure * at.normal.transpose() * normal.d_gap;
    }

    out.bound = bound.value;
    if constexpr (Law::depends_on_pressure && !Pressure::follows_current) {
      out.bound = bound_after(now, lambda).value;
      out.lag = out.bound - bound.value;
    }
    out.memory.friction.traction = traction;
    if constexpr (Law::depends_on_pressure)
      out.memory.friction.pressure = Pressure::advance(now, old.friction.pressure, dt);
  }
  out.pressure.value = now;
  out.pressure.defect = -normal.value - now;
  out.pressure.slope = at.normal * -normal.d_gap;
  out.pressure.excess = by_pressure * out.pressure.defect;
  return out;
}

}  // namespace stickslip
