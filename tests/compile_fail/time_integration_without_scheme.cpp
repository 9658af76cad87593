// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sluggish {
  using Role = role::TimeIntegration;
  static constexpr bool active = true;
  Real density = 1;
  bool lumped = true;
#ifdef CONTROL
  TimeScheme scheme{};
#endif
};
struct Model : Sound {
  using TimeIntegration = Sluggish;
};

static_assert(CheckModel<Model>::ok);
