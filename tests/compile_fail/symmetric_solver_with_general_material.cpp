// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct NonAssociated : Hencky {
#ifndef CONTROL
  static constexpr Symmetry symmetry = Symmetry::general;
#endif
};
struct Bundle : Sound {
  using Friction = Frictionless;
  using Material = NonAssociated;
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
};

static_assert(CheckModel<Bundle>::ok);
