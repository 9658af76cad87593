// SPDX-License-Identifier: BSL-1.0
// Several passes over a step: multipliers, bounds brought up to date; and a law for each kind of contact.
#include "scene.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

#include <doctest/doctest.h>

namespace outer {

using namespace scene;
template <class S, class F, class E>
using With = Model<S, F, Hencky, PlaneStrain, MeanDilatation<Quad4>, E>;
using LagIteratedCoulomb = WithPressure<Coulomb, LagIterated>;

struct Run {
  Field u;
  V force;
  RunReport report;
  Index outer_iterations = 0;
};
template <class M, class E>
Run run(Real mu, const E& enforcement, Index steps = 10, Real outer_tolerance = 1e-4, Real tolerance = 1e-8) {
  Contact<M> contact{.side = "bottom",
                     .tool = rigid::disc({5, -20}, 20),
                     .motion = [](Real t) { return V(std::max(0.0, t - 0.3), 0); },
                     .enforcement = enforcement,
                     .name = "tool"};
  if constexpr (has_friction<M>) contact.friction = {.mu = mu};
  Problem<M> problem{{.body = mesh::rectangle({.size = {10, 5}, .cells = {8, 4}}),
                      .material = material<Hencky>(),
                      .contacts = {contact}}};
  problem.hold("top", 0).drive("top", 1, [](Real t) { return -0.5 * t; });
  auto march = problem.march({.end = 1, .steps = steps, .tolerance = tolerance, .outer_tolerance = outer_tolerance});
  const Outcome& outcome = march.finish();
  REQUIRE_MESSAGE(outcome, outcome.message());
  CHECK(march.report().rejected_steps == 0);
  return {problem.displacement(), problem.contact_force("tool"), march.report(), march.report().outer_iterations};
}

TEST_CASE("bounds updated by outer iterations give the answer of the current pressure with symmetric matrices") {
  const Penalty penalty{.normal = 1e5, .tangential = 2e4};
  static_assert(system_symmetry<With<EigenLdlt, LagIteratedCoulomb, Penalty>> == Symmetry::symmetric);
  const Run exact = run<With<EigenLu, Coulomb, Penalty>>(0.2, penalty);
  const Run lagged = run<With<EigenLdlt, QuasiCoulomb, Penalty>>(0.2, penalty);
  CHECK(exact.outer_iterations == 10);
  CHECK((lagged.force - exact.force).norm() > 1e-3 * exact.force.norm());
  Real before = 1;
  for (const Real tolerance : {1e-2, 1e-4, 1e-6}) {
    const Run iterated = run<With<EigenLdlt, LagIteratedCoulomb, Penalty>>(0.2, penalty, 10, tolerance);
    const Real error = (iterated.force - exact.force).norm() / exact.force.norm();
    CHECK(error < tolerance);
    CHECK(error < before);
    before = error;
    CHECK(iterated.outer_iterations > 10);
    MESSAGE(tolerance << ": error " << error << ", outer iterations " << iterated.outer_iterations << ", iterations "
                      << iterated.report.iterations);
  }
}

TEST_CASE("a symmetrised tangent gives the same answer in more iterations") {
  const Penalty penalty{.normal = 1e5, .tangential = 2e4};
  using Symmetric = With<EigenLdlt, WithPressure<Coulomb, Symmetrised>, Penalty>;
  static_assert(system_symmetry<Symmetric> == Symmetry::symmetric);
  const Run exact = run<With<EigenLu, Coulomb, Penalty>>(0.2, penalty);
  const Run symmetrised = run<Symmetric>(0.2, penalty);
  CHECK((symmetrised.u - exact.u).norm() < 1e-6 * exact.u.norm());
  CHECK((symmetrised.force - exact.force).norm() < 1e-6 * exact.force.norm());
  CHECK(symmetrised.report.iterations > exact.report.iterations);
  CHECK(symmetrised.report.iterations < 5 * exact.report.iterations);
}

TEST_CASE("the augmented Lagrangian leaves no penetration at any stiffness, also at the default one") {
  using General = With<EigenLu, Coulomb, AugmentedLagrangian>;
  using Symmetric = With<EigenLdlt, LagIteratedCoulomb, AugmentedLagrangian>;
  static_assert(system_symmetry<General> == Symmetry::general);
  static_assert(system_symmetry<Symmetric> == Symmetry::symmetric);
  Real before = 1;
  for (const Real tolerance : {1e-3, 1e-5, 1e-7}) {
    const Run r = run<General>(0.2, AugmentedLagrangian{}, 10, tolerance);
    CHECK(r.report.max_penetration < tolerance * 1.25);  // nodes are 1.25 apart
    CHECK(r.report.max_penetration < before);
    before = r.report.max_penetration;
    MESSAGE(tolerance << ": penetration " << before << ", outer iterations " << r.outer_iterations << ", iterations "
                      << r.report.iterations);
  }
  const Run fine = run<General>(0.2, AugmentedLagrangian{}, 10, 1e-8);
  for (const Real factor : {0.1, 100.0}) {
    const Run r = run<General>(0.2, AugmentedLagrangian{.normal = 10 * factor, .tangential = factor}, 10, 1e-8);
    CHECK((r.force - fine.force).norm() < 1e-6 * fine.force.norm());
    CHECK((r.u - fine.u).norm() < 1e-6 * fine.u.norm());
    MESSAGE(factor << ": outer iterations " << r.outer_iterations << ", iterations " << r.report.iterations);
  }
  const Run symmetric = run<Symmetric>(0.2, AugmentedLagrangian{}, 10, 1e-8);
  CHECK((symmetric.force - fine.force).norm() < 1e-6 * fine.force.norm());
  MESSAGE("symmetric: outer iterations " << symmetric.outer_iterations << ", iterations "
                                         << symmetric.report.iterations);
  // A penalty comes to the same answer as it stiffens.
  Real last = 1;
  for (const Real stiffness : {1e5, 1e6, 1e7}) {
    const Run penalty =
        run<With<EigenLu, Coulomb, Penalty>>(0.2, Penalty{.normal = stiffness, .tangential = stiffness});
    const Real error = (penalty.force - fine.force).norm() / fine.force.norm();
    CHECK(error < 0.3 * last);
    last = error;
  }
  CHECK(last < 1e-2);
}

TEST_CASE("a penalty relative to the body's stiffness gives a small penetration without a choice of units") {
  const Penalty penalty{.normal = 10, .tangential = 1, .per = PenaltyPer::stiffness};
  const Run r = run<With<EigenLu, Coulomb, Penalty>>(0.2, penalty);
  CHECK(r.report.max_penetration < 0.02);
  CHECK(r.report.max_penetration > 1e-4);
}

TEST_CASE("outer iterations that do not converge fail their step by name") {
  using M = With<EigenLdlt, LagIteratedCoulomb, Penalty>;
  Problem<M> problem{{.body = mesh::rectangle({.size = {10, 5}, .cells = {4, 2}}),
                      .material = material<Hencky>(),
                      .contacts = {{.side = "bottom",
                                    .tool = rigid::line({0, 0}, {1, 0}),
                                    .motion = [](Real t) { return V(t, 0.1 * t); },
                                    .friction = {.mu = 0.3},
                                    .enforcement = {.normal = 1e5, .tangential = 2e4}}}}};
  problem.hold("top", 0).hold("top", 1);
  auto march = problem.march({.end = 1, .steps = 4, .outer_tolerance = 1e-8, .max_outer = 1});
  const Outcome& outcome = march.finish();
  CHECK_FALSE(outcome);
  CHECK(outcome.failure.cause == FailureCause::outer_failed);
  CHECK(outcome.message().find("passes over the step did not settle") != std::string::npos);
  CHECK(problem.time() == 0);
}

TEST_CASE("a step rejected after its outer iterations restores multipliers and penalty scales") {
  using M = With<EigenLdlt, LagIteratedCoulomb, AugmentedLagrangian>;
  const auto scene = [] {
    auto p = std::make_unique<Problem<M>>(
        Problem<M>::Parameters{.body = mesh::rectangle({.size = {10, 5}, .cells = {8, 4}}),
                               .material = material<Hencky>(),
                               .contacts = {{.side = "bottom",
                                             .tool = rigid::line({0, 0}, {1, 0}),
                                             .friction = {.mu = 0},
                                             .enforcement = {.normal = 1e-2, .tangential = 1},
                                             .name = "floor"}}});
    p->drive("top", 1, [](Real t) { return -0.1 * t; });
    p->load("left", 0, [](Real t) { return 1000 * t; }).load("right", 0, [](Real t) { return -1000 * t; });
    return p;
  };
  auto refused = scene(), fresh = scene();
  for (auto* p : {&refused, &fresh}) {
    (*p)->hold("top", 0);
    CHECK(bool((*p)->march({.end = 0.5, .steps = 1}).finish()));
  }
  const Index touching = refused->contact("floor").summary().touching;
  refused->release("top", 0);
  auto march = refused->march({.end = 1, .steps = 1, .smallest = 0.1});
  CHECK_FALSE(bool(march.finish()));
  REQUIRE(march.outcome().failure.cause ==
          FailureCause::unsupported);  // the loads balance, but nothing holds it along x
  CHECK(march.outcome().attempts == 1);
  CHECK(march.report().outer_iterations > 1);
  CHECK(refused->contact("floor").summary().touching == touching);
  refused->hold("top", 0);
  auto again = refused->march({.end = 1, .steps = 1}), direct = fresh->march({.end = 1, .steps = 1});
  CHECK(bool(again.finish()));
  CHECK(bool(direct.finish()));
  CHECK(again.report().outer_iterations == direct.report().outer_iterations);
  CHECK(refused->displacement() == fresh->displacement());
}

TEST_CASE("abandoned outer iterations leave no trace") {
  // Bounds and multipliers, so soft that they are stiffened within a step.
  using M = With<EigenLdlt, LagIteratedCoulomb, AugmentedLagrangian>;
  const auto run = [](bool troubled) {
    Problem<M> problem{{.body = mesh::rectangle({.size = {10, 5}, .cells = {4, 2}}),
                        .material = material<Hencky>(),
                        .contacts = {{.side = "bottom",
                                      .tool = rigid::line({0, 0}, {1, 0}),
                                      .motion = [](Real t) { return V(t, 0.1 * t); },
                                      .friction = {.mu = 0.3},
                                      .enforcement = {.normal = 0.3, .tangential = 0.1}}}}};
    problem.hold("top", 0).hold("top", 1);
    const auto give_up = [&] {
      const Real now = problem.time();
      auto march = problem.march({.end = now + 0.5,
                                  .steps = 1,
                                  .smallest = 0.1,
                                  .tolerance = 1e-10,
                                  .outer_tolerance = 1e-12,
                                  .max_outer = 5});
      CHECK(march.finish().failure.cause == FailureCause::outer_failed);
      CHECK(march.report().rejected_steps > 1);
      CHECK(problem.time() == now);
    };
    if (troubled) give_up();
    CHECK(bool(problem.march({.end = 0.5, .steps = 2, .tolerance = 1e-10}).finish()));
    if (troubled) give_up();
    Index outer_iterations = 0;
    auto rest = problem.march({.end = 1, .steps = 2, .tolerance = 1e-10});
    for (const StepReport& step : rest) outer_iterations += step.outer_iterations;
    CHECK(bool(rest.outcome()));
    return std::tuple{problem.displacement(), problem.contact_force("bottom"), outer_iterations};
  };
  const auto [u, force, outer_iterations] = run(false);
  const auto [again_u, again_force, again_outer] = run(true);
  CHECK(again_u == u);  // to the bit
  CHECK(again_force == force);
  CHECK(again_outer == outer_iterations);
}

struct Mixed : With<EigenLu, PerContact<Coulomb, Frictionless>, Penalty> {};

TEST_CASE("laws of several contacts give the same answers as alone and keep no memory that they do not need") {
  static_assert(ContactPair<Mixed, Frictionless>::bytes_per_node == 0);
  static_assert(ContactPair<Mixed, Coulomb>::bytes_per_node == 3 * sizeof(Real));
  static_assert(std::is_empty_v<decltype(Contact<Mixed, Frictionless>::friction)>);
  static_assert(system_symmetry<Mixed> == Symmetry::general);
  static_assert(friction_symmetry<PerContact<QuasiCoulomb, Frictionless>>() == Symmetry::symmetric);
  static_assert(valid_model<With<EigenLdlt, PerContact<QuasiCoulomb, Tresca, Frictionless>, Penalty>>);
  static_assert(!valid_model<With<EigenLdlt, PerContact<QuasiCoulomb, Coulomb>, Penalty>>);
  const Penalty penalty{.normal = 1e5, .tangential = 2e4};
  // Squeezed between a rough tool below and a smooth or rough one above, while the lower one is dragged.
  const auto squeeze = [&]<class M>(M, Real mu_below, Real mu_above) {
    typename Problem<M>::Parameters parameters{
        .body = mesh::rectangle({.size = {10, 5}, .cells = {8, 4}}), .material = material<Hencky>(), .contacts = {}};
    const auto drag = [](Real t) { return V(0.3 * t, 0.1 * t); };
    const auto below = rigid::line({0, 0}, {1, 0}), above = rigid::line({0, 5}, {-1, 0});
    if constexpr (std::is_same_v<M, Mixed>)
      parameters.contacts = {
          {{.side = "bottom", .tool = below, .motion = drag, .friction = {.mu = mu_below}, .enforcement = penalty}},
          {{.side = "top", .tool = above, .enforcement = penalty}}};
    else
      parameters.contacts = {
          {.side = "bottom", .tool = below, .motion = drag, .friction = {.mu = mu_below}, .enforcement = penalty},
          {.side = "top", .tool = above, .friction = {.mu = mu_above}, .enforcement = penalty}};
    Problem<M> problem(std::move(parameters));
    problem.hold("right", 0);
    auto march = problem.march({.end = 1, .steps = 5, .tolerance = 1e-10});
    const Outcome& outcome = march.finish();
    REQUIRE_MESSAGE(outcome, outcome.message());
    int pairs = 0;
    problem.visit_contacts([&](const auto& pair) { pairs += pair.name() == "top" || pair.name() == "bottom"; });
    CHECK(pairs == 2);
    return std::pair{problem.displacement(), problem.contact_force("bottom")};
  };
  using Alike = With<EigenLu, Coulomb, Penalty>;
  const auto [mixed, force] = squeeze(Mixed{}, 0.2, 0.0);
  const auto [alike, same] = squeeze(Alike{}, 0.2, 0.0);
  CHECK((mixed - alike).norm() < 1e-9 * alike.norm());
  CHECK((force - same).norm() < 1e-9 * same.norm());
  CHECK(std::abs(force[0]) == doctest::Approx(0.2 * std::abs(force[1])).epsilon(1e-9));
  const auto [rough, other] = squeeze(Alike{}, 0.2, 0.2);
  CHECK((rough - alike).norm() > 1e-3 * alike.norm());
}

}  // namespace outer
