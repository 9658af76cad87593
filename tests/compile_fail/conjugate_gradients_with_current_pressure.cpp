// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/linear_solver/conjugate_gradients.hpp>

struct Model : Sound {
  using LinearSolver = ConjugateGradients;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#endif
};

static_assert(CheckModel<Model>::ok);
