// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Frontal {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;
  void analyze(const SparseView&);
#ifdef CONTROL
  Factorization factorize(const SparseView&);
#else
  bool factorize(const SparseView&);
#endif
  bool solve(const Real*, Real*);
};
struct Model : Sound {
  using LinearSolver = Frontal;
};

static_assert(CheckModel<Model>::ok);
