// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace failure {

using namespace scene;
using M = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<PowerHardening>>;
constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();

// A block pressed by a disc whose motion fails when `broken` says so.
std::unique_ptr<Problem<M>> block(std::function<bool(Real)> broken) {
  auto p = std::make_unique<Problem<M>>(Problem<M>::Parameters{
      .body = mesh::rectangle({.size = {4, 2}, .cells = {6, 3}}),
      .material = material<FiniteJ2<PowerHardening>>(),
      .contacts = {{.side = "top",
                    .tool = rigid::disc({2, 7}, 5),
                    .motion = [broken](Real t) { return broken(t) ? V(nan, 0) : V(0.3 * t, -0.4 * t); },
                    .friction = {.mu = 0.2},
                    .enforcement = {.normal = 1e5, .tangential = 1e4},
                    .name = "punch"}}});
  p->hold("bottom", 0).hold("bottom", 1);
  return p;
}

TEST_CASE("a run that cannot go on stops cleanly, and can be taken up again") {
  bool broken = true;
  auto p = block([&](Real t) { return broken && t > 0.5; });
  auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  Field last;
  V force(0, 0);
  Real slip = 0;
  for (const auto& step : march) {
    last = p->displacement();
    force = p->contact_force("punch");
    slip = p->contact("punch").states()[3].slip;
    CHECK(step.time <= 0.5 + 1e-12);
  }
  const Outcome outcome = march.outcome();
  CHECK_FALSE(bool(outcome));
  CHECK(outcome.trouble.cause == Cause::not_finite);
  CHECK(outcome.trouble.place.kind == Place::Kind::contact_node);
  CHECK(outcome.step == march.report().steps + 1);
  CHECK(outcome.time == p->time());
  CHECK(outcome.time >= 0.5 - 1e-8);
  CHECK(outcome.attempts > 3);
  CHECK(outcome.tried_step < 1e-6);
  CHECK(outcome.message().find("not finite") != std::string::npos);
  // The last converged state stands: displacements and what the tool feels.
  CHECK(last == p->displacement());
  CHECK(force == p->contact_force("punch"));
  CHECK(slip == p->contact("punch").states()[3].slip);
  CHECK(p->max_plastic_strain() > 1e-3);
  // It stays ended.
  CHECK_FALSE(bool(march.finish()));
  CHECK(p->displacement() == last);

  broken = false;
  auto rest = p->march({.end = 1, .steps = 5, .tolerance = 1e-10});
  CHECK(bool(rest.finish()));
  CHECK(p->time() == 1);
  auto whole = block([](Real) { return false; });
  auto unbroken = whole->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  CHECK(bool(unbroken.finish()));
  CHECK((p->displacement() - whole->displacement()).norm() < 1e-6 * whole->displacement().norm());
}

TEST_CASE("a rejected step leaves no trace") {
  // The motion fails late in the first attempt at the fourth step, when all trial memory has been written to.
  int calls = 0;
  bool recovered = false;
  auto p = block([&](Real t) {
    if (t > 0.35 && t < 0.399) recovered = recovered || calls > 3;
    return t > 0.399 && !recovered && ++calls > 3;
  });
  auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  std::vector<Real> times;
  for (const auto& step : march) times.push_back(step.time);
  CHECK(bool(march.outcome()));
  CHECK(march.report().rejected_steps >= 1);
  CHECK(calls > 3);
  CHECK(times.size() > 10);

  auto q = block([](Real) { return false; });
  auto direct = q->march({.end = 1, .steps = 10, .tolerance = 1e-10, .stops = times});
  std::vector<Real> direct_times;
  for (const auto& step : direct) direct_times.push_back(step.time);
  CHECK(direct.report().rejected_steps == 0);
  CHECK(direct_times == times);
  CHECK(q->displacement() == p->displacement());  // to the bit
  CHECK(q->contact_force("punch") == p->contact_force("punch"));
  CHECK(q->max_plastic_strain() == p->max_plastic_strain());
}

TEST_CASE("a drive that turns elements inside out") {
  using Body = Lone<EigenLdlt>;
  Problem<Body> p({.body = mesh::rectangle({.cells = {3, 3}}), .material = material<Hencky>()});
  p.hold("bottom", 0).hold("bottom", 1).hold("top", 0).drive("top", 1, [](Real t) {
    return t < 0.5 ? -0.2 * t : -3.0;
  });
  auto march = p.march({.end = 1, .steps = 10});
  CHECK_FALSE(bool(march.finish()));
  CHECK(march.outcome().trouble.cause == Cause::element_inverted);
  CHECK(march.outcome().trouble.place.kind == Place::Kind::element);
  CHECK(p.time() > 0.39);
  CHECK(p.time() < 0.5);
  CHECK(p.displacement(p.body().mesh().side("top").nodes[1])[1] == doctest::Approx(-0.2 * p.time()).epsilon(1e-12));
}

TEST_CASE("a drive and a load that are no numbers name their node") {
  using Body = Lone<EigenLdlt>;
  const auto run = [](auto prepare) {
    Problem<Body> p({.body = mesh::rectangle({.cells = {1, 1}}), .material = material<Hencky>()});
    prepare(p);
    auto march = p.march({.end = 1, .steps = 2});
    (void)march.finish();
    CHECK(p.displacement().norm() == 0);
    return march.outcome().trouble;
  };
  const auto driven =
      run([](auto& p) { p.hold("bottom", 0).hold("bottom", 1).drive("top", 1, [](Real) { return nan; }); });
  CHECK(driven.cause == Cause::not_finite);
  CHECK(driven.place.kind == Place::Kind::node);
  const auto loaded =
      run([](auto& p) { p.hold("bottom", 0).hold("bottom", 1).load("top", 1, [](Real) { return nan; }); });
  CHECK(loaded.cause == Cause::not_finite);
  CHECK(loaded.place.kind == Place::Kind::node);
}

}  // namespace failure
