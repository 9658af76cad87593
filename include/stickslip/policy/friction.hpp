// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nothing.hpp>
#include <stickslip/base/role.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// What a friction bound may look at. Area and rate are filled in for laws that ask for them, by `depends_on_area` and
/// `depends_on_rate`.
template <class S>
struct FrictionPoint {
  S pressure;     ///< normal force of the node, positive in compression, as the pressure source gives it [force]
  S slip;         ///< slid distance accumulated so far, the current step's included [length]
  Real area = 0;  ///< reference area that the node carries [length^2]
  S rate = S(0);  ///< speed of sliding, the mean over the step [length / time]
};

/// Largest friction force that an interface bears, and its derivatives.
template <class S>
struct FrictionBound {
  S value;          ///< [force], not negative
  S d_pressure;     ///< [-]
  S d_slip;         ///< [force / length]
  S d_rate = S(0);  ///< [force time / length]
};

/// Whether a law looks at the area of the node; a law that does not say so does not.
template <class Law>
constexpr bool depends_on_area() {
  if constexpr (requires { Law::depends_on_area; })
    return Law::depends_on_area;
  else
    return false;
}
/// Whether a law looks at the speed of sliding; a law that does not say so does not.
template <class Law>
constexpr bool depends_on_rate() {
  if constexpr (requires { Law::depends_on_rate; })
    return Law::depends_on_rate;
  else
    return false;
}

/// Where the normal force in a friction bound is taken from. `Memory` is what that needs to remember at a node.
/// docs/policies.md, section Pressure source.
template <class P>
concept PressureSourcePolicy = requires(const Real& current, const typename P::template Memory<Real>& memory, Real dt) {
  requires std::same_as<typename P::Role, role::PressureSource>;
  requires std::same_as<decltype(P::follows_current), const bool>;
  { P::pressure(current, memory, dt) } -> std::same_as<Real>;
  { P::advance(current, memory, dt) } -> std::same_as<typename P::template Memory<Real>>;
};

/// A friction law: a scalar bound with its derivatives, and the pressure source that feeds it. Radial return, the
/// stick-slip switch and the linearisation are the library's. docs/policies.md, section Friction.
template <class L>
concept FrictionLaw = requires(const L& law, const FrictionPoint<Real>& at) {
  requires std::same_as<typename L::Role, role::Friction>;
  requires std::same_as<decltype(L::depends_on_pressure), const bool>;
  requires std::same_as<decltype(L::depends_on_slip), const bool>;
  requires PressureSourcePolicy<typename L::Pressure>;
  { law.bound(at) } -> std::same_as<FrictionBound<Real>>;
};

/// The friction choice of a bundle: a law, a law with another pressure source, or none. The disjunction stands outside
/// `requires`, inside which Clang 14 does not stop at the first operand.
template <class F>
concept FrictionPolicy = requires {
  requires std::same_as<typename F::Role, role::Friction>;
  requires std::same_as<decltype(F::active), const bool>;
}
&&(!F::active || (FrictionLaw<typename F::Law> && PressureSourcePolicy<typename F::Pressure>));

/// The friction `Law_` with its bound fed by `Source`. Type only: the parameters are those of the law.
template <class Law_, class Source>
struct WithPressure {
  using Role = role::Friction;
  using Law = Law_;
  using Pressure = Source;
  static constexpr bool active = true;
};

/// Symmetry of the friction's tangent: only a bound that follows the current normal force breaks it (theory.md, 5.9).
template <class F>
constexpr Symmetry friction_symmetry() {
  if constexpr (!F::active)
    return Symmetry::symmetric;
  else
    return F::Law::depends_on_pressure && F::Pressure::follows_current ? Symmetry::general : Symmetry::symmetric;
}

}  // namespace stickslip
