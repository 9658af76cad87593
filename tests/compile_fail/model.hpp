// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

using namespace stickslip;

// Solvers by their contract alone: nothing here is run, and Eigen's own take seconds to read.
template <Symmetry accepted>
struct DeclaredSolver {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = accepted;
  static constexpr Symmetry storage = accepted;
  void analyze(const SparseView&);
  Factorization factorize(const SparseView&);
  bool solve(const Real*, Real*);
};

// A model that meets every rule; each case spoils one thing.
struct Sound {
  using Kinematics = PlaneStrain;
  using Element = FullyIntegrated<Quad4>;
  using Material = Hencky;
  using Friction = Coulomb;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = DeclaredSolver<Symmetry::general>;
};
