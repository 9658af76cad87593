// SPDX-License-Identifier: BSL-1.0
// A wheel on a block, and what a step makes of its turns: of a part of one, of whole ones, and of turns to and fro.
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_direct.hpp>
#include <stickslip/verify/energy.hpp>

#include <doctest/doctest.h>

#include <functional>

namespace turning {

using namespace scene;

constexpr Real radius = 5, mu = 0.3;

template <class F>
using Block = Model<EigenDirect, F>;

// Pressed 0.1 into the block until time 1, from then on it turns by `angle` [rad].
template <class F>
std::unique_ptr<Problem<Block<F>>> wheel(const rigid::Profile& tool, std::function<Real(Real)> angle) {
  auto p =
      std::make_unique<Problem<Block<F>>>(
          typename Problem<Block<F>>::Parameters{.body = mesh::rectangle({.size = {10, 5}, .cells = {16, 8}}),
                                                 .material = {.young = 1000, .poisson = 0.3},
                                                 .contacts = {{.side = "top",
                                                               .tool = tool,
                                                               .motion =
                                                                   [angle](Real t) {
                                                                     return rigid::turned(
                                                                         angle(std::max(0.0, t - 1)), {0, 0},
                                                                         {5, 10 - 0.1 * std::min(t, 1.0)});
                                                                   },
                                                               .friction = {.mu = mu},
                                                               .enforcement = {.normal = 1e5, .tangential = 1e4},
                                                               .name = "wheel"}}});
  p->hold("bottom", 0).hold("bottom", 1);
  REQUIRE(p->march({.end = 1, .steps = 5}).finish());
  return p;
}
template <class F>
std::unique_ptr<Problem<Block<F>>> wheel(std::function<Real(Real)> angle) {
  return wheel<F>(rigid::disc({0, 0}, radius), std::move(angle));
}
std::function<Real(Real)> turns(Real count) {
  return [count](Real t) { return 2 * pi * count * t; };
}

// Friction over mu N, against the way: that of a wheel whose lower side goes to the right pulls the block to the right.
template <class F>
Real friction(const Problem<Block<F>>& p) {
  const auto& pair = p.contact("wheel");
  Real pressure = 0, torque = 0;
  for (std::size_t k = 0; k < pair.nodes().size(); ++k) {
    const auto& node = pair.states()[k];
    if (!node.touching) continue;
    const Index n = pair.nodes()[k];
    const V r = p.body().mesh().nodes[std::size_t(n)] + p.displacement(n) - V(5, 9.9);
    pressure += node.pressure * radius;
    torque += r[0] * node.force[1] - r[1] * node.force[0];
  }
  return -torque / (mu * pressure);
}

TEST_CASE_TEMPLATE("a rotating wheel is resisted by mu N and slips by its path, at any number of turns a step", F,
                   Coulomb, QuasiCoulomb) {
  for (const Real part : {0.125, 0.25, 0.5, 1.0, 1.5, 4.0, -1.0}) {
    auto p = wheel<F>(turns(4 * part));
    verify::EnergyBalance<Block<F>> balance(*p);
    auto march = p->march({.end = 2, .steps = 4});
    Real before = p->contact("wheel").summary().max_slip;
    verify::Energies first;
    Index steps = 0;
    for (const StepReport& step : march) {
      balance.update(step);
      if (++steps == 1) first = balance.energies();
      // Lags wear off over two steps, as the wheel takes hold.
      CHECK(friction<F>(*p) == doctest::Approx(part > 0 ? 1 : -1).epsilon(steps > 2 ? 1e-3 : 0.01));
      const Real way = 2 * pi * radius * std::abs(part);
      CHECK(step.contact.max_slip - before == doctest::Approx(way).epsilon(steps > 1 ? 2e-3 : 0.01));
      CHECK(step.contact.turn == 0);
      before = step.contact.max_slip;
    }
    REQUIRE(march.outcome());
    CHECK(steps == 4);
    CHECK(march.report().iterations <= 10);
    // All that the wheel does on the block, once it slides, is rubbed off.
    CHECK(balance.energies().external - first.external ==
          doctest::Approx(balance.energies().friction - first.friction).epsilon(2e-3));
  }
}

TEST_CASE("a rotating wheel takes few of the default automatic steps") {
  auto p = wheel<Coulomb>(turns(4));
  auto march = p->march({.end = 2});
  REQUIRE(march.finish());
  CHECK(march.report().steps < 15);
  CHECK(friction<Coulomb>(*p) == doctest::Approx(1).epsilon(2e-3));
  CHECK(march.report().max_slip == doctest::Approx(8 * pi * radius).epsilon(2e-3));
}

TEST_CASE(
    "a polygonal wheel slips by its circumference, and a wheel that rotates before contact only by the part after it") {
  // A polygon of 24 sides slips by its circumference.
  rigid::Profile polygon({radius * std::tan(pi / 24), -radius}, {-1, 0});
  for (int i = 0; i < 24; ++i) polygon.straight(2 * radius * std::tan(pi / 24)).corner(-2 * pi / 24);
  polygon.close();
  auto p = wheel<Coulomb>(polygon, turns(4));
  const Real before = p->contact("wheel").summary().max_slip;
  auto march = p->march({.end = 2, .steps = 4});
  REQUIRE(march.finish());
  CHECK(march.report().steps == 4);
  CHECK(march.report().max_slip - before == doctest::Approx(4 * 48 * radius * std::tan(pi / 24)).epsilon(0.02));

  // It comes down from 0.4 above within one step, and turns twice meanwhile: only the last fifth of that is felt.
  Problem<Block<Coulomb>> late({.body = mesh::rectangle({.size = {10, 5}, .cells = {16, 8}}),
                                .material = {.young = 1000, .poisson = 0.3},
                                .contacts = {{.side = "top",
                                              .tool = rigid::disc({0, 0}, radius),
                                              .motion =
                                                  [](Real t) {
                                                    return rigid::turned(4 * pi * t, {0, 0}, {5, 10.4 - 0.5 * t});
                                                  },
                                              .friction = {.mu = mu},
                                              .enforcement = {.normal = 1e5, .tangential = 1e4},
                                              .name = "wheel"}}});
  late.hold("bottom", 0).hold("bottom", 1);
  auto once = late.march({.end = 1, .steps = 1});
  REQUIRE(once.finish());
  CHECK(once.report().steps == 1);
  CHECK(once.report().max_slip == doctest::Approx(0.2 * 4 * pi * radius).epsilon(0.05));
}

TEST_CASE("a step in which a wheel oscillates is cut until the slip path is resolved") {
  // Eight times by 0.2 rad; the end is on the way back.
  const auto lag_oscillation = [](Real t) { return 0.2 * std::sin(2 * pi * 8 * t); };
  const auto slide = [&](const MarchOptions& options, Index& rejected) {
    auto p = wheel<Coulomb>(lag_oscillation);
    auto march = p->march(options);
    REQUIRE(march.finish());
    rejected = march.report().rejected_steps;
    CHECK(friction<Coulomb>(*p) == doctest::Approx(-1).epsilon(2e-3));
    return march.report().max_slip;
  };
  Index none = 0, some = 0;
  const Real right = slide({.end = 1.95, .steps = 608}, none), found = slide({.end = 1.95}, some);
  CHECK(none == 0);
  CHECK(some > 10);
  CHECK(found == doctest::Approx(right).epsilon(0.01));
}

TEST_CASE("a tool too fast for every step is refused with the name of its contact") {
  auto p = wheel<Coulomb>([](Real t) { return 0.2 * std::sin(1e6 * t); });
  auto march = p->march({.end = 2, .smallest = 1e-3});
  CHECK(!march.finish());
  CHECK(march.outcome().failure.cause == FailureCause::slide_turns);
  CHECK(march.outcome().message().find("contact wheel") != std::string::npos);
  CHECK(p->time() == doctest::Approx(1));
}

TEST_CASE("a tool without rotation needs no further poses and no slip path") {
  Index asked = 0;
  const auto run = [&](auto motion) {
    Problem<Block<Coulomb>> p({.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}),
                               .material = material<Hencky>(),
                               .contacts = {{.side = "bottom",
                                             .tool = rigid::line({0, 0}, {1, 0}),
                                             .motion =
                                                 [&asked, motion](Real t) {
                                                   ++asked;
                                                   return motion(t);
                                                 },
                                             .friction = {.mu = mu},
                                             .enforcement = {.normal = 1e5, .tangential = 2e4}}}});
    p.hold("top", 0).drive("top", 1, [](Real t) { return -0.02 - 0.02 * t; });
    auto march = p.march({.end = 1, .steps = 10});
    asked = 0;
    REQUIRE(march.finish());
    CHECK(march.report().rejected_steps == 0);
    // Five poses of a step, and one of each evaluation: one more than there are iterations, and trials of its search.
    CHECK(asked >= 10 * 6 + march.report().iterations);
    return asked - 10 * 6 - march.report().iterations;
  };
  const Index straight = run([](Real t) { return V(2 * t, 0); });
  CHECK(straight <= 10);
  CHECK(run([](Real) { return V(0, 0); }) <= 10);
}

TEST_CASE("poses along a step resolve rotations at any rate") {
  rigid::PosesAlong<2> along;
  const auto take = [&](std::function<Real(Real)> angle) {
    along.take([=](Real t) { return rigid::turned(angle(t), {0, 0}); }, 2, 3);
    Real sum = 0;
    for (std::size_t i = 1; i < along.size(); ++i) {
      const Mat<Real, 2>&a = along[i - 1].pose.rotation, b = along[i].pose.rotation;
      const Real turn = std::atan2(a(0, 0) * b(1, 0) - a(1, 0) * b(0, 0), a(0, 0) * b(0, 0) + a(1, 0) * b(1, 0));
      CHECK(std::abs(turn) <= 0.1 + 1e-12);
      sum += std::abs(turn);
    }
    return sum;
  };
  for (const int count : {1, 2, 3, 4, 5, 8, 12, 13, 16, 17, 20, 21, 30, 34, 40}) {
    CHECK(take(turns(count)) == doctest::Approx(2 * pi * count).epsilon(1e-9));
    CHECK(along.turns());
    CHECK(along.resolved());
  }
  for (const int count : {1, 4, 8, 16, 32})
    CHECK(take([=](Real t) { return 0.5 * std::sin(2 * pi * count * t); }) ==
          doctest::Approx(2.0 * count).epsilon(0.01));
  CHECK(take(turns(0)) == 0);
  CHECK(along.size() == 5);
  CHECK(!along.turns());
  along.take([](Real t) { return V(3 * t, t * t); }, 0, 1);
  CHECK(!along.turns());
  CHECK(along.size() == 5);
  along.take([](Real t) { return V(std::sin(2 * pi * t), 0); }, 0, 1);  // to and fro
  CHECK(along.turns());
  along.take([](Real t) { return rigid::turned(1e4 * t, {0, 0}); }, 0, 1);
  CHECK(!along.resolved());
  along.take([](Real t) { return rigid::turned(t < 0.4 ? 0 : 0.5, {0, 0}); }, 0, 1);  // a jump is one turn
  CHECK(along.resolved());
  CHECK(along.size() < 200);
}

}  // namespace turning
