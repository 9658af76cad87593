// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/damping/stiffness_damping.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>

struct Model : Sound {
  using Damping = StiffnessDamping;
#ifdef CONTROL
  using TimeIntegration = GeneralizedAlpha;
#endif
};

static_assert(CheckModel<Model>::ok);
