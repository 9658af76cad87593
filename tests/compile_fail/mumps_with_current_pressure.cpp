// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/linear_solver/mumps.hpp>

struct Bundle : Sound {
  using LinearSolver = MumpsLdlt;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#endif
};

static_assert(CheckModel<Bundle>::ok);
