// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Tilted : Penalty {
#ifndef CONTROL
  static constexpr Symmetry symmetry = Symmetry::general;
#endif
};
struct Bundle : Sound {
  using Friction = Frictionless;
  using Enforcement = Tilted;
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
};

static_assert(CheckModel<Bundle>::ok);
