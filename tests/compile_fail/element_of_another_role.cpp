// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Quad : FullyIntegrated<Quad4> {
#ifndef CONTROL
  using Role = role::Material;
#endif
};
struct Bundle : Sound {
  using Element = Quad;
};

static_assert(CheckModel<Bundle>::ok);
