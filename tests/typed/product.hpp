// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/umfpack.hpp>
#include <stickslip/stickslip.hpp>

#include <boost/mp11.hpp>

// All choices of today, and the bundles that they make.
namespace typed {

using namespace stickslip;
using boost::mp11::mp_copy_if;
using boost::mp11::mp_list;
using boost::mp11::mp_product;
using boost::mp11::mp_size;

template <class Kinematics_, class Element_, class Material_, class Friction_, class LinearSolver_>
struct Bundle {
  using Kinematics = Kinematics_;
  using Element = Element_;
  using Material = Material_;
  using Friction = Friction_;
  using Enforcement = Penalty;
  using Inertia = Quasistatic;
  using LinearSolver = LinearSolver_;
};

using AllKinematics = mp_list<PlaneStrain, Axisymmetric>;
using Elements = mp_list<MeanDilatation<Quad4>, FullyIntegrated<Quad4>>;
using Materials =
    mp_list<Hencky, NeoHookean, FiniteJ2<LinearHardening>, FiniteJ2<PowerHardening>, HypoelasticJ2<LinearHardening>>;
using Frictions = mp_list<Frictionless, Coulomb, QuasiCoulomb>;
// Any bound takes any source: all of them are judged, those above run.
using Bounds = mp_list<Coulomb, CappedCoulomb, Tresca, SlipWeakeningCoulomb, Stribeck>;
using Sources = mp_list<CurrentPressure, LastConverged, Extrapolated>;
// First those for symmetric systems, then those for all. MUMPS and the iterative solvers are held against these in
// tests/physics/solvers.cpp.
using Solvers = mp_list<EigenLdlt, BandedCholesky, Cholmod, EigenLu, BandedLu, Umfpack>;

template <class Model>
using IsValid = std::bool_constant<valid_model<Model>>;

}  // namespace typed
