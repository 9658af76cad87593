// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

// A solver that takes a triangle, and the couplings of sliding nodes apart.
struct Correcting : DeclaredSolver<Symmetry::symmetric> {
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr bool corrects = true;
};
struct NonAssociated : Hencky {
#ifndef CONTROL
  static constexpr Symmetry symmetry = Symmetry::general;
#endif
};
struct Model : Sound {
  using Material = NonAssociated;
  using LinearSolver = Correcting;
};

static_assert(CheckModel<Model>::ok);
