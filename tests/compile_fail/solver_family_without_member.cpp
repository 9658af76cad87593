// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

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
struct Bundle : Sound {
  using LinearSolver = Family;
};

static_assert(CheckModel<Bundle>::ok);
