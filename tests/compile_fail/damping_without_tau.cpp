// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/time_integration/generalized_alpha.hpp>

struct Viscous {
  using Role = role::Damping;
  static constexpr bool active = true;
#ifdef CONTROL
  Real tau = 1;
#endif
};
struct Model : Sound {
  using TimeIntegration = GeneralizedAlpha;
  using Damping = Viscous;
};

static_assert(CheckModel<Model>::ok);
