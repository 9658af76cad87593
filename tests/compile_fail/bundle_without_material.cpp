// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Bundle {
  using Kinematics = PlaneStrain;
  using Element = FullyIntegrated<Quad4>;
#ifdef CONTROL
  using Material = Hencky;
#endif
  using Friction = Coulomb;
  using Enforcement = Penalty;
  using Inertia = Quasistatic;
  using LinearSolver = DeclaredSolver<Symmetry::general>;
};

static_assert(CheckModel<Bundle>::ok);
