// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/linear_solver/conjugate_gradients.hpp>

struct Bundle : Sound {
  using LinearSolver = ConjugateGradients;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#endif
};

static_assert(CheckModel<Bundle>::ok);
