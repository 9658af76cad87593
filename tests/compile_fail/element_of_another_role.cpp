// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Quad : FullyIntegrated<Quad4> {
#ifndef CONTROL
  using Role = role::Material;
#endif
};
struct Model : Sound {
  using Element = Quad;
};

static_assert(CheckModel<Model>::ok);
