// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Model : Sound {
  using Enforcement = NoContact;
#ifdef CONTROL
  using Friction = Frictionless;
#endif
};

static_assert(CheckModel<Model>::ok);
