// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/inertia/generalized_alpha.hpp>

struct Viscous {
  using Role = role::Damping;
  static constexpr bool active = true;
#ifdef CONTROL
  Real tau = 1;
#endif
};
struct Bundle : Sound {
  using Inertia = GeneralizedAlpha;
  using Damping = Viscous;
};

static_assert(CheckModel<Bundle>::ok);
