// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Tilted : Penalty {
#ifndef CONTROL
  static constexpr Symmetry symmetry = Symmetry::general;
#endif
};
struct Model : Sound {
  using Friction = Frictionless;
  using Enforcement = Tilted;
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
};

static_assert(CheckModel<Model>::ok);
