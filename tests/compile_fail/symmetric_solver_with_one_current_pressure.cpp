// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Model : Sound {
#ifdef CONTROL
  using Friction = PerContact<QuasiCoulomb, Frictionless>;
#else
  using Friction = PerContact<QuasiCoulomb, Coulomb>;
#endif
  using LinearSolver = DeclaredSolver<Symmetry::symmetric>;
};

static_assert(CheckModel<Model>::ok);
