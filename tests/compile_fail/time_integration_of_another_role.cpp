// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sluggish {
#ifdef CONTROL
  using Role = role::TimeIntegration;
#else
  using Role = role::Friction;
#endif
  static constexpr bool active = false;
};
struct Model : Sound {
  using TimeIntegration = Sluggish;
};

static_assert(CheckModel<Model>::ok);
