// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Family {
  using Role = role::LinearSolver;
  template <Symmetry system>
  using For =
#ifdef CONTROL
      DeclaredSolver<system>;
#else
      Hencky;
#endif
};
struct Model : Sound {
  using LinearSolver = Family;
};

static_assert(CheckModel<Model>::ok);
