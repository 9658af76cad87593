// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Quad : FullyIntegrated<Quad4> {
#ifndef CONTROL
  static constexpr int points = 0;
#endif
};
struct Model : Sound {
  using Element = Quad;
};

static_assert(CheckModel<Model>::ok);
