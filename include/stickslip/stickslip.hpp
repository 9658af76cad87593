// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Everything that needs only Eigen, except the iterative solvers (linear_solver/eigen_iterative.hpp). Include these,
/// the headers that need other libraries (linear_solver/cholmod.hpp, umfpack.hpp, mumps.hpp, banded.hpp,
/// material/tabulated_hardening.hpp, geometry/triangulated.hpp), io/ and verify/ where you use them.

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/geometry/any_of.hpp>
#include <stickslip/geometry/extruded.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/geometry/revolution.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_direct.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/material/neo_hookean.hpp>
#include <stickslip/mesh/extrude.hpp>
#include <stickslip/mesh/quarter_disc.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

namespace stickslip {

/// Defaults of a quasi-static model; derive and override.
struct QuasistaticDefaults {
  using Kinematics = PlaneStrain;
  using Element = MeanDilatation<Quad4>;
  using Material = Hencky;
  using Friction = Frictionless;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = EigenDirect;
};

/// Defaults of a type of bodies (BodyTypes); derive and override.
struct BodyDefaults {
  using Element = MeanDilatation<Quad4>;
  using Material = Hencky;
};

}  // namespace stickslip
