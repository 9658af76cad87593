// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Bundle : Sound {
  using Enforcement = NoContact;
#ifdef CONTROL
  using Friction = Frictionless;
#endif
};

static_assert(CheckModel<Bundle>::ok);
