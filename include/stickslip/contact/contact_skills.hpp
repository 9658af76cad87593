// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/outer_start.hpp>
#include <stickslip/contact/slip_reversals.hpp>
#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/policy/enforcement.hpp>
#include <stickslip/policy/friction.hpp>

#include <type_traits>

namespace stickslip {

/// What a pair of enforcement and friction law calls for, in one place: the pair takes the parts named here.
template <class Enforcement, class Friction, bool active = Friction::active>
struct ContactSkills {
  static constexpr bool friction = true;
  static constexpr bool lags = friction_lags<Friction>;
  static constexpr bool updates_lag = friction_is_iterated<Friction>;  ///< by outer iterations
  static constexpr bool outer_iterations = is_augmented<Enforcement> || updates_lag;
  static constexpr bool takes_area = depends_on_area<typename Friction::Law>();
  static constexpr bool probed = friction_is_symmetrised<Friction>;  ///< Newton's method probes the residual

  template <class Memory>
  using Start =
      std::conditional_t<lags, StartsLagged<Memory, typename Friction::Pressure>,
                         std::conditional_t<outer_iterations, StartsAugmented<Memory>, StartsConverged<Memory>>>;
  template <int dim>
  using Reversals = SlipReversals<surface_coordinates<dim>, probed>;
};

/// Without friction.
template <class Enforcement, class Friction>
struct ContactSkills<Enforcement, Friction, false> {
  static constexpr bool friction = false, lags = false, updates_lag = false, takes_area = false, probed = false;
  static constexpr bool outer_iterations = is_augmented<Enforcement>;

  template <class Memory>
  using Start = std::conditional_t<outer_iterations, StartsAugmented<Memory>, StartsConverged<Memory>>;
  template <int dim>
  using Reversals = NoSlipReversals;
};

}  // namespace stickslip
