// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/friction/frictionless.hpp>

struct Touching {
#ifdef CONTROL
  using Role = role::Surfaces;
#else
  using Role = role::Friction;
#endif
  using Friction = Frictionless;
  static constexpr bool active = true;
};
struct Model : Sound {
  using Surfaces = Touching;
};

static_assert(CheckModel<Model>::ok);
