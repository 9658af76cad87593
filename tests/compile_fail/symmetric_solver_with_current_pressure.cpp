// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Model : Sound {
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#endif
};

static_assert(CheckModel<Model>::ok);
