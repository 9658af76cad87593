// SPDX-License-Identifier: BSL-1.0
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/solve/system.hpp>
#include <stickslip/time_integration/quasistatic.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;

// A system needs no solver, only to know what it would store.
struct AnySolver {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::symmetric;
  void analyze(const SparseView&) {}
  Factorization factorize(const SparseView&) { return Factorization::failed; }
  bool solve(const Real*, Real*) { return false; }
};
template <class K, class F>
struct Model {
  using Kinematics = K;
  using Element = MeanDilatation<Quad4>;
  using Material = FiniteJ2<LinearHardening>;
  using Friction = F;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = AnySolver;
};

// 2 x 2 elements on a disc: nodes that slide, flow in the body, a load and a driven side.
template <class M>
verify::TangentReport check(
    const rigid::Profile& tool = rigid::disc({1.1, -3.02}, 3),
    const rigid::Motion<2>& motion = [](Real t) { return Vec<Real, 2>(0.3 * t, 0.05 * t); }) {
  using Kinematics = typename M::Kinematics;
  Bodies<M> body(mesh::rectangle({.origin = {0.2, 0}, .size = {2, 1}, .cells = {2, 2}}), Kinematics{},
                 {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 40}});
  ContactPairs<M> pairs;
  const Contact<M> contact{.side = "bottom",
                           .tool = tool,
                           .motion = motion,
                           .friction = {.mu = 0.2},
                           .enforcement = {.normal = 2e3, .tangential = 5e2}};
  pairs.emplace_back(contact, body);
  typename System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {{"top", 1, [](Real t) { return -0.1 * t; }}},
                   {{"right", 0, [](Real t) { return 3 * t; }}});
  Field u = Field::Zero(system.dofs().components());
  pairs.front().start(u, 0);
  // One committed step, which leaves pressures and plastic strains, then the state that is checked.
  Failure failure = system.prescribed().apply_constraints(1, u);
  for (Index i = 0; i < u.size(); ++i)
    u[i] += system.dofs().equation(i) == IndexMap::constrained ? 0 : 0.01 * std::sin(3.0 * i);
  failure = system.evaluate(u, 1, 1);
  CHECK_FALSE(bool(failure));
  system.commit();
  failure = system.prescribed().apply_constraints(2, u);
  for (Index i = 0; i < u.size(); ++i)
    u[i] += system.dofs().equation(i) == IndexMap::constrained ? 0 : 0.02 * std::cos(2.0 * i);
  failure = system.evaluate(u, 2, 1);
  CHECK_FALSE(bool(failure));
  CHECK(contact_summary(system.pairs()).touching >= 1);
  CHECK(contact_summary(system.pairs()).sliding >= 1);
  return verify::system_tangent(system, u, 2, 1, 1e-6);
}

TEST_CASE("the system tangent with Coulomb friction is exact") {
  const auto plane = check<Model<PlaneStrain, Coulomb>>(), axi = check<Model<Axisymmetric, Coulomb>>();
  CHECK(plane.by_differences < 1e-8);
  CHECK(axi.by_differences < 1e-8);
  CHECK(plane.asymmetry > 1e-3);
}
TEST_CASE("the tangent of a whole system is turned with its tool") {
  const auto motion = [](Real t) { return rigid::turned(0.1 * t, {1.1, 0}, {0.3 * t, -0.02 + 0.01 * t}); };
  for (const auto& report : {check<Model<PlaneStrain, Coulomb>>(rigid::line({0, 0}, {1, 0}), motion),
                             check<Model<Axisymmetric, QuasiCoulomb>>(rigid::line({0, 0}, {1, 0}), motion)})
    CHECK(report.by_differences < 1e-8);
}

TEST_CASE("the system tangent with Quasi-Coulomb friction is exact and stored as its lower triangle") {
  const auto plane = check<Model<PlaneStrain, QuasiCoulomb>>(), axi = check<Model<Axisymmetric, QuasiCoulomb>>();
  CHECK(plane.by_differences < 1e-8);
  CHECK(axi.by_differences < 1e-8);
}

TEST_CASE("the system tangent in space is exact") {
  struct M : Model<ThreeDimensional, Frictionless> {
    using Element = MeanDilatation<Hex8>;
    using Enforcement = NoContact;
  };
  Bodies<M> body(mesh::box({.cells = {2, 1, 2}}), {},
                 {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 40}});
  System<M>::Pairs pairs{};
  System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {{"top", 2, nullptr}}, {{"right", 0, [](Real t) { return 3 * t; }}});
  Field u = Field::Zero(system.dofs().components());
  for (const Real frequency : {3.0, 2.0}) {
    for (Index i = 0; i < u.size(); ++i)
      u[i] += system.dofs().equation(i) == IndexMap::constrained ? 0 : 0.03 * std::sin(frequency * i);
    CHECK_FALSE(bool(system.evaluate(u, 1, 1)));
    if (frequency == 3.0) system.commit();
  }
  const auto report = verify::system_tangent(system, u, 1, 1, 1e-6);
  CHECK(report.by_differences < 1e-8);
}

// The predictor of a driven step: residual to first order after the increments still to come.
TEST_CASE("the tangent predictor contains the driven increments") {
  using M = Model<PlaneStrain, QuasiCoulomb>;
  Bodies<M> body(mesh::rectangle({.size = {2, 1}, .cells = {2, 2}}), PlaneStrain{},
                 {.young = 1000, .poisson = 0.3, .hardening = {.yield = 50, .modulus = 40}});
  ContactPairs<M> pairs;
  typename System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {{"top", 1, nullptr}, {"bottom", 1, nullptr}}, {});
  Field u = Field::Zero(system.dofs().components()), driven = u;
  for (const Index n : body.mesh().side("top").nodes) driven[2 * n + 1] = -1e-6;
  {
    System<M>::Iterate iterate(system);
    CHECK_FALSE(bool(iterate.evaluate(u, 0, 1, Want::tangent, &driven)));
  }
  const Field predicted = system.forces().residual;
  u += driven;
  CHECK_FALSE(bool(system.evaluate(u, 0, 1)));
  CHECK(predicted.norm() > 0);
  CHECK((predicted - system.forces().residual).norm() < 1e-5 * predicted.norm());
}

}  // namespace
