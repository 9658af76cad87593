// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/linear_solver/mumps.hpp>

struct Model : Sound {
  using LinearSolver = MumpsLdlt;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#endif
};

static_assert(CheckModel<Model>::ok);
