// SPDX-License-Identifier: BSL-1.0
#pragma once

/// Everything that needs Eigen alone, but for four parts to include where you use them (tests/structure/umbrella.py):
/// - io/, which reads and writes files;
/// - run_time.hpp, for programs that offer models and solvers by name;
/// - linear_solver/eigen_iterative.hpp, whose Eigen headers would cost each program a second to compile, of twelve of
///   README.md's;
/// - what needs another library: linear_solver/cholmod.hpp, linear_solver/umfpack.hpp, linear_solver/mumps.hpp,
///   linear_solver/banded.hpp, material/tabulated_hardening.hpp, geometry/triangulated.hpp,
///   contact/surface_contact.hpp.

#include <stickslip/advise.hpp>
#include <stickslip/damping/stiffness_damping.hpp>
#include <stickslip/element/assumed_strain.hpp>
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
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/time_integration/quasistatic.hpp>
#include <stickslip/verify/contact.hpp>
#include <stickslip/verify/element.hpp>
#include <stickslip/verify/energy.hpp>
#include <stickslip/verify/material.hpp>
#include <stickslip/verify/system.hpp>
#include <stickslip/verify/tangent.hpp>
#include <stickslip/verify/tool.hpp>
#include <stickslip/version.hpp>

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
