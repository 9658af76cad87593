// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct NonAssociated : Hencky {
#ifndef CONTROL
  static constexpr Symmetry symmetry = Symmetry::general;
#endif
};
struct Model : Sound {
  using Friction = Frictionless;
  using Material = NonAssociated;
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
};

static_assert(CheckModel<Model>::ok);
