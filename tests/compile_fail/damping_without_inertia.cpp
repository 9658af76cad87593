// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/damping/stiffness_damping.hpp>
#include <stickslip/inertia/generalized_alpha.hpp>

struct Bundle : Sound {
  using Damping = StiffnessDamping;
#ifdef CONTROL
  using Inertia = GeneralizedAlpha;
#endif
};

static_assert(CheckModel<Bundle>::ok);
