// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Bundle : Sound {
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#endif
};

static_assert(CheckModel<Bundle>::ok);
