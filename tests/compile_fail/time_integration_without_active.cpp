// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sluggish {
  using Role = role::TimeIntegration;
#ifdef CONTROL
  static constexpr bool active = false;
#endif
};
struct Model : Sound {
  using TimeIntegration = Sluggish;
};

static_assert(CheckModel<Model>::ok);
