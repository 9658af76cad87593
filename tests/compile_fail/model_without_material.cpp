// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Model {
  using Kinematics = PlaneStrain;
  using Element = FullyIntegrated<Quad4>;
#ifdef CONTROL
  using Material = Hencky;
#endif
  using Friction = Coulomb;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = DeclaredSolver<Symmetry::general>;
};

static_assert(CheckModel<Model>::ok);
