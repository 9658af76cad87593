// SPDX-License-Identifier: BSL-1.0
#pragma once

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
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/material/neo_hookean.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

#include <boost/mp11.hpp>

#include <array>

/// The choices of each axis as types, and the same, in the same order, as enumerators to write rows of models with.
namespace typed {

using namespace stickslip;
using boost::mp11::mp_at_c;
using boost::mp11::mp_list;
using boost::mp11::mp_product;
using boost::mp11::mp_size;

enum Kinematics_ { plane, ring, space };
using AllKinematics = mp_list<PlaneStrain, Axisymmetric, ThreeDimensional>;

/// Treatments of volume and shear; the cell follows the dimension.
template <int dim>
using Cell = std::conditional_t<dim == 3, Hex8, Quad4>;
struct Mean {
  template <int dim>
  using Element = MeanDilatation<Cell<dim>>;
};
struct Full {
  template <int dim>
  using Element = FullyIntegrated<Cell<dim>>;
};
struct Assumed {
  template <int dim>
  using Element = AssumedStrain<Cell<dim>>;
};
enum Treatment_ { mean, full, bends };
using Treatments = mp_list<Mean, Full, Assumed>;

enum Material_ {
  hencky,
  neo_hookean,
  j2_perfect,
  j2_linear,
  j2_swift,
  j2_voce,
  hypo_perfect,
  hypo_linear,
  hypo_swift,
  hypo_voce
};
using Materials = mp_list<Hencky, NeoHookean, FiniteJ2<PerfectPlasticity>, FiniteJ2<LinearHardening>,
                          FiniteJ2<SwiftHardening>, FiniteJ2<VoceHardening>, HypoelasticJ2<PerfectPlasticity>,
                          HypoelasticJ2<LinearHardening>, HypoelasticJ2<SwiftHardening>, HypoelasticJ2<VoceHardening>>;

enum Bound_ { smooth, coulomb, capped, tresca, weakening, stribeck, anisotropic, by_pair };
using Bounds = mp_list<Frictionless, Coulomb, CappedCoulomb, Tresca, SlipWeakeningCoulomb, Stribeck, AnisotropicCoulomb,
                       PerContact<Coulomb, Frictionless>>;

enum Source_ { current, last, ahead, iterated };
using Sources = mp_list<CurrentPressure, LastConverged, Extrapolated, LagIterated>;

/// A bound with a source. All bounds of the library name the current pressure themselves; of a list by the pair, those
/// with friction take the source.
template <class Bound, class Source>
struct FrictionOf {
  using type = WithPressure<Bound, Source>;
};
template <class Bound>
struct FrictionOf<Bound, CurrentPressure> {
  using type = Bound;
};
template <class Bound, class Source>
struct FrictionOf<PerContact<Bound, Frictionless>, Source> {
  using type = PerContact<typename FrictionOf<Bound, Source>::type, Frictionless>;
};
template <class Bound>
struct FrictionOf<PerContact<Bound, Frictionless>, CurrentPressure> {
  using type = PerContact<Bound, Frictionless>;
};

enum Enforcement_ { free_, penalty, augmented };
using Enforcements = mp_list<NoContact, Penalty, AugmentedLagrangian>;

enum Inertia_ { still, moving };
using Inertias = mp_list<Quasistatic, GeneralizedAlpha>;

/// By turns one for symmetric systems and one for all. Their headers are dear to read: solvers_*.hpp.
enum Solver_ {
  eigen_ldlt,
  eigen_lu,
  cholmod,
  umfpack,
  banded_cholesky,
  banded_lu,
  mumps_ldlt,
  mumps_lu,
  conjugate_gradients,
  bicgstab
};
constexpr std::size_t solvers = 10;
template <Solver_>
struct SolverType;
/// What a model's contracts look at of either.
template <Symmetry accepted>
struct DeclaredSolver {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = accepted;
  static constexpr Symmetry storage = accepted;
  void analyze(const SparseView&) {}
  Factorization factorize(const SparseView&) { return Factorization::failed; }
  bool solve(const Real*, Real*) { return false; }
};
template <class L, Symmetry accepted>
constexpr bool is_as_declared =
    LinearSolverPolicy<L>&& L::accepts == accepted&& L::storage == accepted && !accepts_couplings<L>;

template <class K, class T, class M, class B, class S, class E, class I, class L>
struct Combination {
  using Kinematics = K;
  using Element = typename T::template Element<K::dim>;
  using Material = M;
  using Friction = typename FrictionOf<B, S>::type;
  using Enforcement = E;
  using TimeIntegration = I;
  using LinearSolver = L;
};

constexpr std::size_t axes = 8;
constexpr std::array<std::size_t, axes> choices{
    mp_size<AllKinematics>::value, mp_size<Treatments>::value,   mp_size<Materials>::value, mp_size<Bounds>::value,
    mp_size<Sources>::value,       mp_size<Enforcements>::value, mp_size<Inertias>::value,  solvers};

/// A model by its choices.
struct Row {
  Kinematics_ kinematics;
  Treatment_ treatment;
  Material_ material;
  Bound_ bound;
  Source_ source;
  Enforcement_ enforcement;
  Inertia_ inertia;
  Solver_ solver;

  constexpr std::array<std::size_t, axes> numbers() const {
    return {kinematics, treatment, material, bound, source, enforcement, inertia, solver};
  }
};
template <Row row>
using ModelOf = Combination<mp_at_c<AllKinematics, row.kinematics>, mp_at_c<Treatments, row.treatment>,
                            mp_at_c<Materials, row.material>, mp_at_c<Bounds, row.bound>, mp_at_c<Sources, row.source>,
                            mp_at_c<Enforcements, row.enforcement>, mp_at_c<Inertias, row.inertia>,
                            typename SolverType<row.solver>::type>;

}  // namespace typed
