// SPDX-License-Identifier: BSL-1.0
// Pressures and dilatations as variables of the iteration: the answer is that of the displacements alone, and what is
// stiff costs no iterations.
#include "scene.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

#include <doctest/doctest.h>

namespace condensed_unknowns {

using namespace scene;

template <class Friction>
Index iterations(Real stiffening) {
  using M = Model<EigenLu, Friction, FiniteJ2<LinearHardening>>;
  auto p = press_and_drag<M>(0.2, 0.5, 1, {8, 4}, stiffening);
  auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-8});
  CHECK(bool(march.finish()));
  CHECK(march.report().rejected_steps == 0);
  CHECK(march.report().max_penetration < 0.05 / stiffening);
  return march.report().iterations;
}

TEST_CASE("a penalty 1000 times as stiff takes no more iterations") {
  const Index soft = iterations<Coulomb>(1), lagged_soft = iterations<QuasiCoulomb>(1);
  for (const Real stiffening : {1e1, 1e2, 1e3}) {
    CAPTURE(stiffening);
    const Index stiff = iterations<Coulomb>(stiffening), lagged_stiff = iterations<QuasiCoulomb>(stiffening);
    CHECK(stiff <= 1.25 * soft);
    CHECK(lagged_stiff <= 1.25 * lagged_soft);
    MESSAGE(stiffening << " times as stiff: " << stiff << " for " << soft << " iterations, Quasi-Coulomb "
                       << lagged_stiff << " for " << lagged_soft);
  }
}

TEST_CASE_TEMPLATE("at the end of an iteration the condensed unknowns agree with the displacements", Element,
                   MeanDilatation<Quad4>, AssumedStrain<Quad4>) {
  using M = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>, PlaneStrain, Element>;
  Bodies<M> body(mesh::rectangle({.size = {10, 5}, .cells = {8, 4}}), PlaneStrain{},
                 material<FiniteJ2<LinearHardening>>());
  ContactPairs<M> pairs;
  pairs.emplace_back(Contact<M>{.side = "bottom",
                                .tool = rigid::disc({5, -20}, 20),
                                .friction = {.mu = 0.2},
                                .enforcement = {.normal = 1e6, .tangential = 1e5}},
                     body);
  typename System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {{"top", 0, nullptr}, {"top", 1, [](Real t) { return -0.3 * t; }}}, {});
  Field u = Field::Zero(system.dofs().components());
  pairs.front().start(u, 0);
  Newton<EigenLdlt> newton({.tolerance = 1e-9});
  for (int step = 1; step <= 4; ++step) {
    Field driven = u;
    REQUIRE_FALSE(bool(system.prescribed().apply_constraints(0.25 * step, driven)));
    driven -= u;
    {
      typename System<M>::Iterate iterate(system);
      REQUIRE_FALSE(bool(newton.solve(iterate, u, 0.25 * step, 0.25, &driven).failure));
      iterate.accept();
    }
    const Field open = system.forces().internal;
    REQUIRE_FALSE(bool(system.evaluate(u, 0.25 * step, 0.25)));
    CHECK(system.forces().norm <= 2e-9 * system.forces().scale(system.space()));
    CHECK((system.forces().internal - open).norm() <= 1e-8 * open.norm());
    CHECK(contact_summary(system.pairs()).touching >= 3);
    system.commit();
  }
  CHECK(pairs.front().force()[1] < -1e3);
}

}  // namespace condensed_unknowns
