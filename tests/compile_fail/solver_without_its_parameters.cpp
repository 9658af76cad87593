// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Patient : DeclaredSolver<Symmetry::general> {
  struct Parameters {
    Real patience = 1;
  };
  Patient();
#ifdef CONTROL
  explicit Patient(const Parameters& parameters);
#endif
};
struct Model : Sound {
  using LinearSolver = Patient;
};

static_assert(CheckModel<Model>::ok);
