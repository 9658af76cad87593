// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>

struct Multipliers : AugmentedLagrangian {
#ifndef CONTROL
  Real augmented(const Real& pressure) const {
    return pressure;
  }  // must be a Memory
#endif
};
struct Model : Sound {
  using Enforcement = Multipliers;
};

static_assert(CheckModel<Model>::ok);
