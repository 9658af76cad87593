// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/time_integration/generalized_alpha.hpp>

struct Viscous {
#ifdef CONTROL
  using Role = role::Damping;
#else
  using Role = role::TimeIntegration;
#endif
  static constexpr bool active = true;
  Real tau = 1;
};
struct Model : Sound {
  using TimeIntegration = GeneralizedAlpha;
  using Damping = Viscous;
};

static_assert(CheckModel<Model>::ok);
