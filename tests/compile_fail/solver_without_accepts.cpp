// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Frontal {
  using Role = role::LinearSolver;
#ifdef CONTROL
  static constexpr Symmetry accepts = Symmetry::general;
#endif
  static constexpr Symmetry storage = Symmetry::general;
  void analyze(const SparseView&);
  Factorization factorize(const SparseView&);
  bool solve(const Real*, Real*);
};
struct Model : Sound {
  using LinearSolver = Frontal;
};

static_assert(CheckModel<Model>::ok);
