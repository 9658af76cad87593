// SPDX-License-Identifier: BSL-1.0
// An effect that the scene does not call for takes no memory.
#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/material/neo_hookean.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;

struct GeneralSolver {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::symmetric;
  void analyze(const SparseView&) {}
  Factorization factorize(const SparseView&) { return Factorization::failed; }
  bool solve(const Real*, Real*) { return false; }
};
template <class M, class F, class E, class K = PlaneStrain>
struct Model {
  using Kinematics = K;
  using Element = MeanDilatation<Quad4>;
  using Material = M;
  using Friction = F;
  using Enforcement = E;
  using TimeIntegration = Quasistatic;
  using LinearSolver = GeneralSolver;
};
using J2 = FiniteJ2<LinearHardening>;
using Free = Model<Hencky, Frictionless, NoContact>;
using Smooth = Model<Hencky, Frictionless, Penalty>;
using Rough = Model<Hencky, Coulomb, Penalty>;
using Lagged = Model<Hencky, QuasiCoulomb, Penalty>;

static_assert(Body<Free>::bytes_per_point == 0);
static_assert(Body<Model<NeoHookean, Frictionless, NoContact>>::bytes_per_point == 0);
static_assert(Body<Model<J2, Frictionless, NoContact>>::bytes_per_point == 5 * sizeof(Real));
static_assert(Body<Model<FiniteJ2<PowerHardening>, Frictionless, NoContact>>::bytes_per_point == 5 * sizeof(Real));
static_assert(Body<Model<HypoelasticJ2<LinearHardening>, Frictionless, NoContact>>::bytes_per_point ==
              10 * sizeof(Real));
// A model without surfaces has the pairs on tools alone, and nothing for surfaces in what it is made of.
static_assert(std::is_same_v<ContactPairs<Rough>, std::list<ContactPair<Rough>>>);
static_assert(std::is_empty_v<decltype(detail::SceneParameters<Rough, int>::surfaces)> && !has_surfaces<Rough>);
static_assert(ContactPair<Smooth>::bytes_per_node == 0);
static_assert(ContactPair<Rough>::bytes_per_node == 3 * sizeof(Real));   // traction, place, slip
static_assert(ContactPair<Lagged>::bytes_per_node == 4 * sizeof(Real));  // and the pressure
template <class F>
constexpr std::size_t numbers_per_node = ContactPair<Model<Hencky, F, Penalty>>::bytes_per_node / sizeof(Real);
static_assert(numbers_per_node<ExtrapolatedCoulomb> == 5);  // the pressure and its trend
static_assert(numbers_per_node<CappedCoulomb> == 3 && numbers_per_node<Quasi<CappedCoulomb>> == 4);
static_assert(numbers_per_node<SlipWeakeningCoulomb> == 3 && numbers_per_node<Stribeck> == 3);
static_assert(numbers_per_node<WithPressure<Stribeck, Extrapolated>> == 5);
// A bound that does not look at the pressure remembers none, whatever the source.
static_assert(numbers_per_node<Tresca> == 3 && numbers_per_node<WithPressure<Tresca, Extrapolated>> == 3);
// Areas are kept for laws that look at them.
static_assert(sizeof(Tresca) == sizeof(Coulomb));
static_assert(sizeof(ContactPair<Model<Hencky, Tresca, Penalty>>) > sizeof(ContactPair<Rough>));
static_assert(!ContactPair<Model<Hencky, Stribeck, Penalty>>::takes_area);
static_assert(!History<Hencky::State<Real, Planar>>::stored && std::is_empty_v<History<Hencky::State<Real, Planar>>>);
static_assert(sizeof(PointGeometry<Axisymmetric, 4>) == sizeof(PointGeometry<PlaneStrain, 4>) + 4 * sizeof(Real));

// An element keeps the condensed unknowns that it has, and what the iteration needs of them; without any, nothing.
template <class E>
struct With : Free {
  using Element = E;
};
template <class E>
constexpr std::size_t body_size = sizeof(Body<With<E>>);
static_assert(std::is_empty_v<CondensedUnknowns<8, 0>> && std::is_empty_v<CondensedUnknowns<24, 0>>);
// But for what the alignment of a body pads.
template <class E>
constexpr std::size_t kept = body_size<E> - body_size<FullyIntegrated<Quad4>>;
template <class E, int count>
constexpr bool keeps_these_alone = kept<E> < sizeof(CondensedUnknowns<8, count>) + alignof(Body<Free>) &&
                                   sizeof(CondensedUnknowns<8, count>) < kept<E> + alignof(Body<Free>);
static_assert(keeps_these_alone<MeanDilatation<Quad4>, 1>);
static_assert(keeps_these_alone<AssumedStrain<Quad4>, 5>);
static_assert(sizeof(CondensedUnknown<Real, 8, 5>) == (5 + 5 + 8 * 5 + 8) * sizeof(Real));
static_assert(sizeof(CondensedUnknown<Real, 24, 7>) == (7 + 7 + 24 * 7 + 24) * sizeof(Real));

// In space: the gradients and the weight of a point, six components of the plastic memory and the strain.
static_assert(sizeof(PointGeometry<ThreeDimensional, 8>) <= 26 * sizeof(Real));
static_assert(sizeof(J2::State<Real, Spatial>) == 7 * sizeof(Real));

// Without contact there is no list of pairs.
static_assert(std::is_empty_v<System<Free>::Pairs>);
static_assert(!std::is_empty_v<System<Smooth>::Pairs>);
static_assert(sizeof(Problem<Smooth>) > sizeof(Problem<Free>));
static_assert(sizeof(Problem<Smooth>::Parameters) > sizeof(Problem<Free>::Parameters));
// A pair without friction keeps neither of its two vectors of memory, nor a law.
static_assert(sizeof(ContactPair<Rough>) > sizeof(ContactPair<Smooth>) + sizeof(std::vector<int>));
static_assert(std::is_empty_v<decltype(Contact<Smooth>::friction)>);
static_assert(sizeof(Contact<Lagged>) == sizeof(Contact<Rough>));
// A solver without parameters is told nothing, and what Newton's method keeps of a solver is the solver; one process
// takes its norms by nothing.
struct ToldSolver : GeneralSolver {
  struct Parameters {
    Real told[10] = {};
  };
  explicit ToldSolver(const Parameters&) {}
};
static_assert(std::is_empty_v<SolverParameters<GeneralSolver>> && std::is_empty_v<SolverParametersOf<Smooth>>);
static_assert(sizeof(Newton<GeneralSolver>) == sizeof(Newton<ToldSolver>));
static_assert(sizeof(EigenLdlt) > sizeof(GeneralSolver) && std::is_empty_v<SolverParameters<EigenLdlt>>);
static_assert(std::is_empty_v<SerialSpace> && std::is_empty_v<System<Smooth>::Space>);
struct Spaced {
  [[no_unique_address]] SerialSpace space;
  Real x;
};
static_assert(sizeof(Spaced) == sizeof(Real));
// Nothing is nothing, also twice.
struct A;
struct B;
struct Both {
  [[no_unique_address]] Empty<A> a;
  [[no_unique_address]] Empty<B> b;
  Real x;
};
static_assert(sizeof(Both) == sizeof(Real));

template <class M>
SparseView view_of(System<M>& system) {
  return system.tangent().stored;
}

TEST_CASE("a symmetric system stores its lower triangle only") {
  const auto mesh = mesh::rectangle({.cells = {3, 3}});
  const auto count = [&](auto tag) {
    using M = decltype(tag);
    Bodies<M> body(mesh, {}, {.young = 1, .poisson = 0.3});
    ContactPairs<M> pairs;
    typename System<M>::Inertia inertia{};
    System<M> system(body, pairs, inertia, {{"bottom", 1, nullptr}}, {});
    const SparseView view = system.tangent().stored;
    bool upper = false;
    for (Index j = 0; j < view.size; ++j)
      for (Index k = view.column_start[j]; k < view.column_start[j + 1]; ++k) upper = upper || view.row[k] < j;
    CHECK(upper == (view.symmetry == Symmetry::general));
    return std::pair(view.size, view.nonzeros());
  };
  const auto [n, lagged] = count(Lagged{});
  const auto [m, rough] = count(Rough{});
  CHECK(n == m);
  CHECK(n == 32 - 4);
  CHECK(rough == 2 * lagged - n);
  static_assert(Problem<Lagged>::symmetric_storage && Problem<Smooth>::symmetric_storage &&
                !Problem<Rough>::symmetric_storage);
}

}  // namespace
