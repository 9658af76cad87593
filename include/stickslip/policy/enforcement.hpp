// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// What one unit of a nodal stiffness stands for.
enum class PenaltyPer {
  unit_depth,  ///< a node per radian (axisymmetric) or per unit thickness (plane strain)
  node,        ///< a node of the full turn or the full thickness
  area,        ///< reference area that the node carries
  stiffness,   ///< the body's own stiffness at the node when the run begins: the numbers have no unit then
};

/// Normal force of a node on the tool and its derivative; of a node that an iteration holds off the tool, their smooth
/// continuation.
template <class S>
struct NormalForce {
  S value;  ///< t_N <= 0 in contact [force]
  S d_gap;  ///< [force / length]
};

/// Whether an enforcement has multipliers that outer iterations bring to their values: `augmented(pressure)` gives
/// the memory for the next pass.
template <class E>
inline constexpr bool is_augmented = requires(const E& enforcement, const Real& pressure) {
  enforcement.augmented(pressure);
};
/// Whether they are of the right kind, if there are any.
template <class E>
concept SoundMultipliers = !is_augmented<E> || requires(const E& enforcement, const Real& pressure) {
  { enforcement.augmented(pressure) } -> std::same_as<typename E::template Memory<Real>>;
};

/// How contact is enforced. `Memory<S>` is what a node remembers of it, `weight` the measure behind PenaltyPer.
/// docs/policies.md, section Enforcement.
template <class E>
concept ContactEnforcement = requires(const E& enforcement, const Real& gap, Real weight,
                                      const typename E::template Memory<Real>& memory) {
  requires std::same_as<typename E::Role, role::Enforcement>;
  requires std::same_as<decltype(E::symmetry), const Symmetry>;
  { enforcement.per } -> std::convertible_to<PenaltyPer>;
  { enforcement.normal_force(gap, weight, memory) } -> std::same_as<NormalForce<Real>>;
  { enforcement.stick_stiffness(weight) } -> std::same_as<Real>;
};

/// The enforcement choice of a model: one of contact, or none. The disjunction stands outside `requires`, inside which
/// Clang 14 does not stop at the first operand.
template <class E>
concept EnforcementPolicy = requires {
  requires std::same_as<typename E::Role, role::Enforcement>;
  requires std::same_as<decltype(E::active), const bool>;
}
&&(!E::active || (ContactEnforcement<E> && SoundMultipliers<E>));

}  // namespace stickslip
