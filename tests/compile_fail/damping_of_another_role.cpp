// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/inertia/generalized_alpha.hpp>

struct Viscous {
#ifdef CONTROL
  using Role = role::Damping;
#else
  using Role = role::Inertia;
#endif
  static constexpr bool active = true;
  Real tau = 1;
};
struct Bundle : Sound {
  using Inertia = GeneralizedAlpha;
  using Damping = Viscous;
};

static_assert(CheckModel<Bundle>::ok);
