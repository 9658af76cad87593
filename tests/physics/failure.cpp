// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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

// A block of 4 x 2 that a plane presses from above: Hencky's law in plane strain and the penalty per area in series.
struct Squeeze {
  Real young = 1000, poisson = 0.3, depth = 0.2, penalty = 1e8, offset = 0;
  Index steps = 0;
  Real tolerance = 1e-5;

  Real exact() const {
    const Real modulus = young / (1 - poisson * poisson);
    Real low = -1, high = 0;  // logarithmic strain
    for (int i = 0; i < 200; ++i) {
      const Real e = 0.5 * (low + high), stress = -modulus * e / std::exp(e);
      (-2 * std::expm1(e) + stress / penalty > depth ? low : high) = e;
    }
    return -4 * modulus * low / std::exp(low);
  }
  // True if it is right, to the tolerance, in force and balance; else it has to be refused for `reason`.
  bool right(const std::string& reason) const {
    auto mesh = mesh::rectangle({.origin = {offset, offset}, .size = {4, 2}, .cells = {4, 2}});
    Problem<Model<EigenLdlt>> p(
        {.body = mesh,
         .material = {.young = young, .poisson = poisson},
         .contacts = {{.side = "top",
                       .tool = rigid::line({offset, offset + 2}, {-1, 0}),
                       .motion = [d = depth](Real t) { return V(0, -d * t); },
                       .enforcement = {.normal = penalty, .tangential = penalty, .per = PenaltyPer::area},
                       .name = "plate"}}});
    p.hold("bottom", 1).hold("left", 0);
    auto march = p.march({.end = 1, .steps = steps, .tolerance = tolerance});
    for (const auto& step : march) CHECK(step.number < 200);
    const Outcome& outcome = march.outcome();
    if (!outcome) {
      CHECK(outcome.trouble.cause == Cause::digits_lost);
      CHECK(outcome.detail.find(reason) != std::string::npos);
      CAPTURE(outcome.message());
      CHECK(p.time() < 1);
      return false;
    }
    CHECK(p.contact_force("plate")[1] == doctest::Approx(exact()).epsilon(3 * tolerance));
    CHECK(p.reaction("bottom", 1) == doctest::Approx(exact()).epsilon(3 * tolerance));
    CHECK((*march.begin()).residual <= tolerance);
    return true;
  }
};
TEST_CASE("forces are right to the tolerance whatever the penalty") {
  for (Real penalty = 1e2; penalty < 2e20; penalty *= 100)
    for (const Index steps : {0, 5})
      for (const Real tolerance : {1e-5, 1e-9}) {
        CAPTURE(penalty);
        CHECK(Squeeze{.penalty = penalty, .steps = steps, .tolerance = tolerance}.right(""));
      }
  CHECK(Squeeze{.young = 1e-8, .penalty = 1e5}.right(""));
}
TEST_CASE("forces are right near incompressibility, or the bulk modulus is named") {
  for (const Real below : {1e-3, 1e-6, 1e-9, 1e-11, 1e-13}) {
    CAPTURE(below);
    CHECK((Squeeze{.poisson = 0.5 - below, .penalty = 1e5}.right("the bulk modulus is") || below < 1e-10));
  }
  CHECK_FALSE(Squeeze{.poisson = std::nextafter(0.5, 0.0), .penalty = 1e5}.right("the bulk modulus is 9e+15 times"));
}
TEST_CASE("forces are right far from the origin, or the coordinates are named") {
  CHECK(Squeeze{.offset = 1e6}.right(""));
  CHECK(Squeeze{.depth = 1e-7, .offset = 100}.right(""));
  for (const Real penalty : {1e5, 1e8, 1e12}) {
    CHECK_FALSE(Squeeze{.penalty = penalty, .offset = 1e12}.right("coordinates of up to 1e+12"));
    CHECK_FALSE(Squeeze{.depth = 1e-7, .penalty = penalty, .offset = 1e6}.right("coordinates of up to 1e+06"));
  }
  CHECK_FALSE(Squeeze{.depth = 1e-7, .offset = 1e6}.right("digits of the forces are left, the tolerance asks for 5"));
}
TEST_CASE("a penalty on a tool askew buries the body's stiffness along it: right, or it is named") {
  const auto force = [](Real penalty) {
    Problem<Model<EigenLdlt>> p({.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}),
                                 .material = {.young = 1000, .poisson = 0.3},
                                 .contacts = {{.side = "bottom",
                                               .tool = rigid::line({2, 0}, {1, 0.3}),
                                               .enforcement = {.normal = penalty, .tangential = 1000},
                                               .name = "slope"}}});
    p.hold("top", 0).drive("top", 1, [](Real t) { return -0.4 * t; });
    auto march = p.march({.end = 1, .steps = 10, .smallest = 1e-4});
    if (!march.finish()) {
      CHECK(march.outcome().trouble.cause == Cause::digits_lost);
      CHECK(march.outcome().detail.find("the penalty of contact \"slope\"") != std::string::npos);
      CHECK(p.time() == 0);
      return 0.0;
    }
    CHECK(p.contact_force("slope")[1] == doctest::Approx(p.reaction("top", 1)).epsilon(1e-5));
    return p.contact_force("slope")[1];
  };
  const Real best = force(1e12);
  CHECK(best == doctest::Approx(-1851.13766).epsilon(1e-6));
  CHECK(force(1e15) == doctest::Approx(best).epsilon(1e-5));
  for (const Real penalty : {1e19, 1e21}) CHECK(force(penalty) == 0);
}
TEST_CASE("a body that only moves has no forces that could lose digits") {
  for (const Real far : {1.0, 1e3, 1e6}) {
    Problem<Lone<EigenLdlt>> p(
        {.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}), .material = {.young = 1000, .poisson = 0.3}});
    p.hold("left", 0).drive("bottom", 1, [far](Real t) { return far * t; });
    auto march = p.march({.end = 1, .steps = 5});
    for (const auto& step : march) CHECK(step.residual == 0);
    CHECK(march.outcome().message() == "completed");
    CHECK(march.warnings().empty());
    CHECK(p.displacement(p.body().mesh().side("top").nodes[1])[1] == doctest::Approx(far).epsilon(1e-9));
  }
}
TEST_CASE("a body that springs back to rest is at rest, and no iteration runs after its last digits") {
  Problem<Model<EigenLdlt>> p({.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}),
                               .material = {.young = 1000, .poisson = 0.3},
                               .contacts = {{.side = "top",
                                             .tool = rigid::disc({0, 0}, 1),
                                             .motion = [](Real t) { return V(-48 + 100 * t, 2.8); },
                                             .enforcement = {.normal = 1e5},
                                             .name = "roller"}}});
  p.hold("bottom", 0).hold("bottom", 1);
  auto march = p.march({.end = 1, .steps = 1});
  CHECK(march.finish().message() == "completed");
  CHECK(march.report().rejected_steps <= 8);
  CHECK(p.displacement().norm() < 1e-10);
}

// Pressed far beyond its buckling loads, and nothing is askew.
TEST_CASE("a straight strip at 700 times Euler's load tells its negative pivots, and warns") {
  const Real length = 20, width = 0.2, euler = 4 * pi * pi * 1000 / 0.91 * std::pow(width, 3) / 12 / (length * length);
  const auto strip = [&](Real times, Index steps) {
    auto p = std::make_unique<Problem<Lone<EigenLdlt>>>(
        Problem<Lone<EigenLdlt>>::Parameters{.body = mesh::rectangle({.size = {length, width}, .cells = {40, 2}}),
                                             .material = {.young = 1000, .poisson = 0.3}});
    p->hold("left", 0).hold("left", 1).hold("right", 1).load("right", 0, [=](Real t) { return -times * euler * t; });
    auto march = p->march({.end = 1, .steps = steps, .tolerance = 1e-8});
    std::vector<Index> pivots;
    for (const auto& step : march) pivots.push_back(step.negative_pivots);
    CHECK(march.outcome().message() == "completed");
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(verify::dense(p->system().matrix()), Eigen::EigenvaluesOnly)
            .eigenvalues();
    CHECK(pivots.back() == (eigenvalues.array() < 0).count());
    Index changes = 0;
    for (std::size_t k = 0; k < pivots.size(); ++k) changes += pivots[k] != (k > 0 ? pivots[k - 1] : 0) ? 1 : 0;
    if (changes > 0) {
      REQUIRE(march.warnings().size() == 1);
      CHECK(march.warnings()[0].name == "pivots_changed");
      CHECK(march.warnings()[0].count == changes);
      CHECK(march.warnings()[0].text.find("from 0 to") != std::string::npos);
    } else {
      CHECK(march.warnings().empty());
    }
    return pivots;
  };
  CHECK(strip(0.2, 4) == std::vector<Index>{0, 0, 0, 0});
  CHECK(strip(700, 1).back() > 10);
  const std::vector<Index> pivots = strip(700, 20);
  CHECK(pivots.back() > 10);
  CHECK(std::is_sorted(pivots.begin(), pivots.end()));
}

}  // namespace failure
