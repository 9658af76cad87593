// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/friction/frictionless.hpp>

struct Model : Sound {
  using Surfaces = SurfaceContact<Frictionless>;
  using Friction = Frictionless;
#ifndef CONTROL
  using Enforcement = NoContact;
#endif
};

static_assert(CheckModel<Model>::ok);
