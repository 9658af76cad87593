// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Sluggish {
#ifdef CONTROL
  using Role = role::Inertia;
#else
  using Role = role::Friction;
#endif
  static constexpr bool active = false;
};
struct Bundle : Sound {
  using Inertia = Sluggish;
};

static_assert(CheckModel<Bundle>::ok);
