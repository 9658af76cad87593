// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/base/stored_if.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// What a friction bound may look at. Area and rate are filled in for laws that ask for them, by `depends_on_area` and
/// `depends_on_rate`.
template <class S>
struct InterfaceState {
  S pressure;          ///< normal force of the node, positive in compression, as the pressure source gives it [force]
  S accumulated_slip;  ///< slid distance accumulated so far, the current step's included [length]
  Real area = 0;       ///< reference area that the node carries [length^2]
  S rate = S(0);       ///< speed of sliding, the mean over the step [length / time]
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

/// Whether a law's bound depends on the direction: `metric()` is the matrix M of sqrt(t . M t) = bound, in the tool's
/// frame (theory.md, eq. 5.28). Three dimensions only.
template <class Law>
inline constexpr bool is_anisotropic = requires(const Law& law) {
  { law.metric() } -> std::same_as<Mat<Real, 3>>;
};

/// Whether a pressure source is brought up to date by outer iterations, and not by its end alone.
template <class Source>
constexpr bool is_iterated() {
  if constexpr (requires { Source::iterated; })
    return Source::iterated;
  else
    return false;
}

/// Whether a source's pressure lags behind, and can be told which one to take: `from_pressure(pressure)` is the memory
/// with which the bound sees just that, `critical_feedback` the feedback up to which the lag settles. Passes over a
/// step need it, and the probe whether friction feeds back on its own bound.
template <class Source>
inline constexpr bool is_lagged = requires(const Real& pressure) {
  requires !Source::follows_current;
  { Source::critical_feedback } -> std::convertible_to<Real>;
  { Source::from_pressure(pressure) } -> std::same_as<typename Source::template Memory<Real>>;
};

/// Whether a source that follows the current pressure leaves its part out of the tangent, which is symmetric then.
template <class Source>
constexpr bool is_symmetrised() {
  if constexpr (requires { Source::symmetrised; })
    return Source::symmetrised;
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
concept FrictionLaw = requires(const L& law, const InterfaceState<Real>& at) {
  requires std::same_as<typename L::Role, role::Friction>;
  requires std::same_as<decltype(L::depends_on_pressure), const bool>;
  requires std::same_as<decltype(L::depends_on_slip), const bool>;
  requires PressureSourcePolicy<typename L::Pressure>;
  { law.bound(at) } -> std::same_as<FrictionBound<Real>>;
};

/// One friction choice: a law, a law with another pressure source, or none. The disjunction stands outside `requires`,
/// inside which Clang 14 does not stop at the first operand.
template <class F>
concept SingleFriction = requires {
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

/// A friction choice for each kind of contact in the scene. The contacts of a model are then one list a kind, and a
/// pair of a kind without friction keeps nothing of it.
template <class... Frictions>
struct PerContact {
  using Role = role::Friction;
  static constexpr bool active = (Frictions::active || ...);
  static constexpr bool per_contact = (SingleFriction<Frictions> && ...);
};

/// The friction choice of a model: one for all contacts, or one a kind.
template <class F>
concept FrictionPolicy = SingleFriction<F> || requires {
  requires F::per_contact;
};

namespace detail {
template <class... F>
struct Frictions {
  static constexpr bool any_general = ((F::active &&
                                        [] {
                                          if constexpr (F::active)
                                            return F::Law::depends_on_pressure && F::Pressure::follows_current &&
                                                   !is_symmetrised<typename F::Pressure>();
                                          else
                                            return false;
                                        }()) ||
                                       ...);
  static constexpr bool any_iterated = ((F::active &&
                                         [] {
                                           if constexpr (F::active)
                                             return F::Law::depends_on_pressure && is_iterated<typename F::Pressure>();
                                           else
                                             return false;
                                         }()) ||
                                        ...);
  static constexpr bool any_lagging = ((F::active &&
                                        [] {
                                          if constexpr (F::active)
                                            return F::Law::depends_on_pressure && is_lagged<typename F::Pressure>;
                                          else
                                            return false;
                                        }()) ||
                                       ...);
  static constexpr bool any_symmetrised =
      ((F::active &&
        [] {
          if constexpr (F::active)
            return F::Law::depends_on_pressure && is_symmetrised<typename F::Pressure>();
          else
            return false;
        }()) ||
       ...);
  static constexpr bool any_anisotropic = (is_anisotropic<typename F::Law> || ...);
};
template <class F>
struct FrictionsOf {
  using type = Frictions<F>;
};
template <class... F>
struct FrictionsOf<PerContact<F...>> {
  using type = Frictions<F...>;
};
}  // namespace detail

/// Symmetry of the friction's tangent: only a bound that follows the current normal force breaks it (theory.md, 5.9).
template <class F>
constexpr Symmetry friction_symmetry() {
  return detail::FrictionsOf<F>::type::any_general ? Symmetry::general : Symmetry::symmetric;
}
/// Whether a bound is brought up to date by outer iterations.
template <class F>
inline constexpr bool friction_is_iterated = detail::FrictionsOf<F>::type::any_iterated;
/// Whether a bound lags behind the pressure and can be asked what another pressure would do.
template <class F>
inline constexpr bool friction_lags = detail::FrictionsOf<F>::type::any_lagging;
/// Whether the tangent is only near the residual's derivative.
template <class F>
inline constexpr bool friction_is_symmetrised = detail::FrictionsOf<F>::type::any_symmetrised;
/// Whether a bound depends on the direction.
template <class F>
inline constexpr bool friction_is_anisotropic = detail::FrictionsOf<F>::type::any_anisotropic;

}  // namespace stickslip
