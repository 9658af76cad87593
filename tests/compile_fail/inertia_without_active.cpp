// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Sluggish {
  using Role = role::Inertia;
#ifdef CONTROL
  static constexpr bool active = false;
#endif
};
struct Bundle : Sound {
  using Inertia = Sluggish;
};

static_assert(CheckModel<Bundle>::ok);
