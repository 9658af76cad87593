// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Sluggish {
  using Role = role::Inertia;
  static constexpr bool active = true;
  Real density = 1;
  bool lumped = true;
#ifdef CONTROL
  TimeScheme scheme{};
#endif
};
struct Bundle : Sound {
  using Inertia = Sluggish;
};

static_assert(CheckModel<Bundle>::ok);
