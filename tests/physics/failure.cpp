// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/element/assumed_strain.hpp>
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
using Bends = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<PowerHardening>, PlaneStrain, AssumedStrain<Quad4>>;
constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();

// A block pressed by a disc whose motion fails when `broken` says so.
template <class Chosen = M>
std::unique_ptr<Problem<Chosen>> block(std::function<bool(Real)> broken) {
  auto p = std::make_unique<Problem<Chosen>>(typename Problem<Chosen>::Parameters{
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

TEST_CASE("a run that fails keeps its last converged state and can be continued") {
  bool broken = true;
  auto p = block([&](Real t) { return broken && t > 0.5; });
  auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  Field last;
  V force(0, 0);
  Real slip = 0;
  for (const auto& step : march) {
    last = p->displacement();
    force = p->contact_force("punch");
    slip = p->contact("punch").states()[3].accumulated_slip;
    CHECK(step.time <= 0.5 + 1e-12);
  }
  const Outcome outcome = march.outcome();
  CHECK_FALSE(bool(outcome));
  CHECK(outcome.failure.cause == FailureCause::not_finite);
  CHECK(outcome.failure.location.kind == Location::Kind::contact_node);
  CHECK(outcome.step == march.report().steps + 1);
  CHECK(outcome.time == p->time());
  CHECK(outcome.time >= 0.5 - 1e-8);
  CHECK(outcome.attempts > 3);
  CHECK(outcome.tried_step < 1e-6);
  CHECK(outcome.message().find("not finite") != std::string::npos);
  // The last converged state stands: displacements and what the tool feels.
  CHECK(last == p->displacement());
  CHECK(force == p->contact_force("punch"));
  CHECK(slip == p->contact("punch").states()[3].accumulated_slip);
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

// Material memory and condensed unknowns.
template <class March>
std::vector<Section> body_of(March& march) {
  std::vector<Section> all = Archive::of(march).sections;
  std::erase_if(all, [](const Section& s) { return s.name.rfind("body", 0) != 0; });
  return all;
}
TEST_CASE_TEMPLATE("a rejected step leaves no trace", Chosen, M, Bends) {
  // The motion fails late in the first attempt at the fourth step, when all trial memory has been written to.
  int calls = 0;
  bool recovered = false;
  auto p = block<Chosen>([&](Real t) {
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

  auto q = block<Chosen>([](Real) { return false; });
  auto direct = q->march({.end = 1, .steps = 10, .tolerance = 1e-10, .stops = times});
  std::vector<Real> direct_times;
  for (const auto& step : direct) direct_times.push_back(step.time);
  CHECK(direct.report().rejected_steps == 0);
  CHECK(direct_times == times);
  CHECK(q->displacement() == p->displacement());  // to the bit
  CHECK(q->contact_force("punch") == p->contact_force("punch"));
  CHECK(q->max_plastic_strain() == p->max_plastic_strain());
  const auto kept = body_of(march), kept_direct = body_of(direct);
  REQUIRE(kept.size() == 3);
  CHECK(kept[1].name == "body, condensed unknowns");
  CHECK(kept[2].name == "body, condensed unknowns, last increment");
  CHECK(kept[1].bytes.size() == 18 * condensed_unknowns<typename Chosen::Element> * sizeof(Real));
  for (std::size_t k = 0; k < 3; ++k) CHECK(kept[k].bytes == kept_direct[k].bytes);
}

TEST_CASE("equal steps cut to a millionth return to their grid within a few steps") {
  // What happens at 0.5501 only steps below 1e-7 get over.
  const Problem<M>* scene = nullptr;
  auto p = block([&](Real t) { return scene && scene->time() < 0.5501 && t >= 0.5501 && t - scene->time() > 1e-7; });
  scene = p.get();
  auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  std::vector<Real> times;
  for (const auto& step : march) times.push_back(step.time);
  CHECK(bool(march.outcome()));
  CHECK(march.report().steps < 100);
  MESSAGE(march.report().steps << " steps, " << march.report().rejected_steps << " cut");
  for (int k = 1; k <= 10; ++k) CHECK(std::find(times.begin(), times.end(), k / 10.0) != times.end());
  auto q = block([](Real) { return false; });
  CHECK(bool(q->march({.end = 1, .steps = 10, .tolerance = 1e-10}).finish()));
  CHECK((p->displacement() - q->displacement()).norm() < 0.02 * q->displacement().norm());  // less lags in short steps
}

TEST_CASE("a drive that inverts elements is refused as element_inverted") {
  using Body = Lone<EigenLdlt>;
  Problem<Body> p({.body = mesh::rectangle({.cells = {3, 3}}), .material = material<Hencky>()});
  p.hold("bottom", 0).hold("bottom", 1).hold("top", 0).drive("top", 1, [](Real t) {
    return t < 0.5 ? -0.2 * t : -3.0;
  });
  auto march = p.march({.end = 1, .steps = 10});
  CHECK_FALSE(bool(march.finish()));
  CHECK(march.outcome().failure.cause == FailureCause::element_inverted);
  CHECK(march.outcome().failure.location.kind == Location::Kind::element);
  CHECK(p.time() > 0.39);
  CHECK(p.time() < 0.5);
  CHECK(p.displacement(p.body().mesh().side("top").nodes[1])[1] == doctest::Approx(-0.2 * p.time()).epsilon(1e-12));
}

TEST_CASE("a drive or load that is not finite is refused with its node") {
  using Body = Lone<EigenLdlt>;
  const auto run = [](auto prepare) {
    Problem<Body> p({.body = mesh::rectangle({.cells = {1, 1}}), .material = material<Hencky>()});
    prepare(p);
    auto march = p.march({.end = 1, .steps = 2});
    (void)march.finish();
    CHECK(p.displacement().norm() == 0);
    return march.outcome().failure;
  };
  const auto driven =
      run([](auto& p) { p.hold("bottom", 0).hold("bottom", 1).drive("top", 1, [](Real) { return nan; }); });
  CHECK(driven.cause == FailureCause::not_finite);
  CHECK(driven.location.kind == Location::Kind::node);
  const auto loaded =
      run([](auto& p) { p.hold("bottom", 0).hold("bottom", 1).load("top", 1, [](Real) { return nan; }); });
  CHECK(loaded.cause == FailureCause::not_finite);
  CHECK(loaded.location.kind == Location::Kind::node);
}

// A block of 4 x 2 between a held bottom and a driven top.
using Plain = Lone<EigenLdlt>;
std::unique_ptr<Problem<Plain>> column(Mesh<2, 4> body = mesh::rectangle({.size = {4, 2}, .cells = {6, 3}})) {
  auto p = std::make_unique<Problem<Plain>>(
      Problem<Plain>::Parameters{.body = std::move(body), .material = material<Hencky>()});
  p->hold("bottom", 0).hold("bottom", 1).drive("top", 1, [](Real t) { return -0.2 * t; });
  return p;
}

TEST_CASE("contact forces are those of the converged state, not of a failed attempt") {
  bool broken = true;
  // The tool is moved by a length at which elements turn inside out, when all nodes have been looked at.
  auto p = std::make_unique<Problem<M>>(
      Problem<M>::Parameters{.body = mesh::rectangle({.size = {4, 2}, .cells = {6, 3}}),
                             .material = material<FiniteJ2<PowerHardening>>(),
                             .contacts = {{.side = "top",
                                           .tool = rigid::disc({2, 7}, 5),
                                           .motion = [&](Real t) { return V(0, broken && t > 0.5 ? -3 : -0.2 * t); },
                                           .friction = {.mu = 0.2},
                                           .enforcement = {.normal = 1e5, .tangential = 1e4},
                                           .name = "punch"}}});
  p->hold("bottom", 0).hold("bottom", 1);
  auto march = p->march({.end = 1, .steps = 10, .smallest = 0.01});
  ContactSummary last, reported;
  for (const auto& step : march) {
    last = p->contact("punch").summary();
    reported = step.contact;
  }
  CHECK_FALSE(bool(march.outcome()));
  CHECK(last.touching > 0);
  const ContactSummary& now = p->contact("punch").summary();
  CHECK(now.touching == last.touching);
  CHECK(now.sliding == last.sliding);
  CHECK(now.max_penetration == last.max_penetration);
  CHECK(now.friction_capacity == last.friction_capacity);
  CHECK(now.penalty_work == last.penalty_work);
  CHECK(reported.max_penetration == last.max_penetration);
  Index touching = 0;
  Real deepest = 0;
  for (const auto& node : p->contact("punch").states()) {
    touching += node.touching ? 1 : 0;
    if (node.touching) deepest = std::max(deepest, -node.gap);
  }
  CHECK(now.touching == touching);
  CHECK(now.max_penetration == deepest);
}

TEST_CASE("supports and loads given between the steps of a march act from the next step on") {
  const auto pull = [](Real t) { return 500 * t; };
  const auto change = [&](Problem<Plain>& p) { p.hold("left", 0).hold("top", 0).load("right", 1, pull); };
  auto between = column();
  CHECK(bool(between->march({.end = 0.5, .steps = 5, .tolerance = 1e-10}).finish()));
  change(*between);
  CHECK(bool(between->march({.end = 1, .steps = 5, .tolerance = 1e-10}).finish()));

  auto within = column();
  auto march = within->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  const Index unknowns = within->unknowns();
  for (const auto& step : march)
    if (step.number == 5) {
      const Real reaction = within->reaction("bottom", 1);
      CHECK(reaction > 0);
      change(*within);
      CHECK(within->reaction("bottom", 1) == reaction);  // of the converged state, still
    }
  CHECK(bool(march.outcome()));
  CHECK(march.report().steps == 10);
  CHECK(within->unknowns() == unknowns - 9);  // of the top's seven nodes, and of the left side's other two
  CHECK((within->displacement() - between->displacement()).norm() < 1e-12 * between->displacement().norm());
  CHECK(within->reaction("left", 0) == doctest::Approx(between->reaction("left", 0)).epsilon(1e-10));
  CHECK(march.report().timings.assembly > 0);

  // Before the first step it is as before the march.
  auto early = column(), before = column();
  auto begun = early->march({.end = 1, .steps = 2, .tolerance = 1e-10});
  early->load("top", 0, pull);
  before->load("top", 0, pull);
  CHECK(bool(begun.finish()));
  CHECK(bool(before->march({.end = 1, .steps = 2, .tolerance = 1e-10}).finish()));
  CHECK(early->displacement() == before->displacement());
}

TEST_CASE("a support released within a march no longer acts") {
  const auto pull = [](Real t) { return 500 * t; };
  auto p = column();
  p->load("right", 0, pull);
  auto march = p->march({.end = 1, .steps = 4, .tolerance = 1e-10});
  for (const auto& step : march)
    if (step.number == 2) p->release("top", 1);
  CHECK(bool(march.outcome()));
  // Elastic: nothing of what it did is left.
  Problem<Plain> never({.body = p->body().mesh(), .material = material<Hencky>()});
  never.hold("bottom", 0).hold("bottom", 1).load("right", 0, pull);
  CHECK(bool(never.march({.end = 1, .steps = 4, .tolerance = 1e-10}).finish()));
  CHECK((p->displacement() - never.displacement()).norm() < 1e-8 * never.displacement().norm());
  CHECK(std::abs(p->reaction("bottom", 1)) < 1e-5);
  CHECK_THROWS_WITH_AS(p->release("top", 1), "release of side \"top\": it has no support in component 1",
                       std::invalid_argument);
  // And the last one leaves a body that nothing holds.
  auto rest = p->march({.end = 2, .steps = 4});
  for (const auto& step : rest)
    if (step.number == 2) p->release("bottom", 1);
  CHECK(rest.outcome().failure.cause == FailureCause::unsupported);
  CHECK(rest.report().steps == 2);
}

TEST_CASE("a march that another march has overtaken refuses to continue") {
  const auto throws = [](auto&& advance) {
    CHECK_THROWS_WITH_AS(advance(), doctest::Contains("another march has moved it"), std::invalid_argument);
  };
  auto p = column();
  // Advanced in turns.
  auto one = p->march({.end = 1, .steps = 4}), other = p->march({.end = 1, .steps = 4});
  auto it = one.begin();
  throws([&] { (void)other.begin(); });
  CHECK(p->time() == 0.25);
  ++it;
  CHECK(p->time() == 0.5);
  throws([&] { (void)other.finish(); });
  CHECK(bool(one.finish()));
  CHECK(p->time() == 1);
  CHECK(bool(one.finish()));  // it has ended, and that is no step
  // Begun before another one has moved the time.
  auto stale = p->march({.end = 2, .steps = 4});
  CHECK(bool(p->march({.end = 3, .steps = 4}).finish()));
  throws([&] { (void)stale.finish(); });
  CHECK(p->time() == 3);
  static_assert(!std::is_move_constructible_v<March<Plain>>);  // a march that was moved from would be one
}

TEST_CASE("supports that contradict each other are refused with their names") {
  const auto complains = [](auto&& f, std::initializer_list<const char*> parts) {
    std::string text;
    try {
      f();
    } catch (const std::invalid_argument& error) {
      text = error.what();
    }
    for (const char* part : parts) CHECK_MESSAGE(text.find(part) != std::string::npos, text);
  };
  const auto after = [](Real rate) { return [rate](Real t) { return rate * t; }; };
  auto p = column();
  const auto& left = p->body().mesh().side("left").nodes;  // from the top
  const std::string upper = "node " + std::to_string(left.front()), corner = "node " + std::to_string(left.back());
  // Now: at once.
  complains([&] { p->drive("left", 1, [](Real) { return 0.1; }); },
            {"contradict", upper.c_str(), "component 1", "side \"top\" is at 0 ", "side \"left\" at 0.1"});
  // Later, as far as can be seen when the march begins: hold and drive of one component, and of a corner.
  p->drive("bottom", 0, after(0.1));
  complains([&] { (void)p->march({.end = 1}); }, {"component 0", "side \"bottom\" is at 0 and", "release"});
  p->release("bottom", 0).drive("bottom", 0, after(0.1)).drive("left", 0, after(0.2));
  complains([&] { (void)p->march({.end = 1}); }, {corner.c_str(), "side \"bottom\"", "side \"left\"", "component 0"});
  CHECK(p->time() == 0);
  // Equal values are none, round-off or not.
  p->release("left", 0).drive("left", 0, [](Real t) { return t / 10; });
  CHECK(bool(p->march({.end = 1, .steps = 2}).finish()));
  // What begins only within a step, and between the times looked at, ends the run by name.
  auto q = column();
  q->drive("left", 0, [](Real t) { return t > 0.501 && t < 0.502 ? 0.01 : 0; });
  auto march = q->march({.end = 1, .initial = 0.5005, .stops = {0.5005, 0.5015}});
  CHECK_FALSE(bool(march.finish()));
  CHECK(march.outcome().failure.cause == FailureCause::contradicting_supports);
  CHECK(march.outcome().failure.location.kind == Location::Kind::node);
  for (const char* part : {"contradict", "component 0", "side \"bottom\"", "side \"left\" at 0.01"})
    CHECK_MESSAGE(march.outcome().message().find(part) != std::string::npos, march.outcome().message());
  CHECK(q->time() < 0.502);
}

// Two blocks side by side in one mesh, not joined; the second one's sides are called as the first one's and "2".
Mesh<2, 4> two_blocks(bool named) {
  auto both = mesh::rectangle({.size = {1, 1}, .cells = {2, 2}});
  const auto second = mesh::rectangle({.origin = {3, 0}, .size = {1, 1}, .cells = {2, 2}});
  const Index first = both.node_count();
  both.nodes.insert(both.nodes.end(), second.nodes.begin(), second.nodes.end());
  for (auto cell : second.cells) {
    for (Index& n : cell) n += first;
    both.cells.push_back(cell);
  }
  for (auto [name, side] : second.sides) {
    for (Index& n : side.nodes) n += first;
    for (auto& facet : side.facets)
      for (Index& n : facet) n += first;
    if (named) both.sides[name + "2"] = side;
    // Sides over both parts do not tell them apart.
    Side<2>& joined = both.sides[name + " of both"];
    joined = both.sides[name];
    joined.nodes.insert(joined.nodes.end(), side.nodes.begin(), side.nodes.end());
    joined.facets.insert(joined.facets.end(), side.facets.begin(), side.facets.end());
  }
  return both;
}

TEST_CASE("a part of the body without any support is named before the first step") {
  const auto refused = [](Problem<Plain>& p, const char* part) {
    auto march = p.march({.end = 1, .steps = 40});
    CHECK_FALSE(bool(march.finish()));
    CHECK(march.outcome().failure.cause == FailureCause::unsupported);
    CHECK_MESSAGE(march.outcome().message().find(part) != std::string::npos, march.outcome().message());
    CHECK(march.report().steps == 0);
    CHECK(p.displacement().isZero(0));
    CHECK(march.outcome().message().find("tried") == std::string::npos);  // it was not
  };
  const auto force = [](Real t) { return 10 * t; };
  const auto back = [](Real t) { return -10 * t; };
  const auto named = "the part of the mesh with side \"bottom2\"";
  refused(*column(two_blocks(true)), named);
  refused(*column(two_blocks(false)), "the part of the mesh with node 9");
  auto pushed = column(two_blocks(true)), balanced = column(two_blocks(true)), half = column(two_blocks(true));
  pushed->load("right2", 0, force);
  refused(*pushed, named);
  balanced->load("right2", 0, force).load("left2", 0, back);
  refused(*balanced, named);
  half->hold("bottom2", 1).load("right2", 0, force).load("left2", 0, back);
  refused(*half, named);
}

TEST_CASE("a part that can only rotate is named after its first step, a supported one is not") {
  auto mesh = two_blocks(true);
  mesh.sides["pin"].nodes = {mesh.side("left2").nodes[1]};
  const auto force = [](Real t) { return 10 * t; };
  auto turning = column(mesh);
  turning->hold("pin", 0).hold("pin", 1).load("top2", 1, force);
  auto march = turning->march({.end = 1, .steps = 4});
  CHECK_FALSE(bool(march.finish()));
  CHECK(march.outcome().failure.cause == FailureCause::unsupported);
  CHECK(march.outcome().message().find("\"bottom2\"") != std::string::npos);
  CHECK(march.report().steps == 0);

  auto held = column(mesh);
  held->hold("bottom2", 0).hold("bottom2", 1).load("top2", 1, force);
  CHECK(bool(held->march({.end = 1, .steps = 4, .tolerance = 1e-9}).finish()));
  CHECK(held->reaction("bottom2", 1) == doctest::Approx(-10).epsilon(1e-6));
}

TEST_CASE("a part that a tool supports is refused only when the tool leaves it") {
  // The second block lies on a floor between two walls' worth of friction-free tool: a groove that holds it both ways.
  using Touching = Model<EigenLdlt, Frictionless>;
  auto body = two_blocks(true);
  mesh::join(body, "below", {"left2", "bottom2", "right2"});
  const auto scene = [&](std::function<Real(Real)> drop) {
    auto p = std::make_unique<Problem<Touching>>(Problem<Touching>::Parameters{
        .body = body,
        .material = material<Hencky>(),
        .contacts = {
            {.side = "below",
             .tool = rigid::path({3, 2}, {0, -1}).straight(2).corner(pi / 2).straight(1).corner(pi / 2).straight(2),
             .motion = [drop](Real t) { return V(0, drop(t)); },
             .enforcement = {.normal = 1e5},
             .name = "groove"}}});
    p->hold("bottom", 0).hold("bottom", 1).drive("top", 1, [](Real t) { return -0.2 * t; });
    return p;
  };
  auto held = scene([](Real t) { return 1e-3 * t; });
  held->hold("top2", 1).hold("top2", 0);
  CHECK(bool(held->march({.end = 1, .steps = 4}).finish()));
  auto loose = scene([](Real t) { return -0.2 * t; });
  loose->load("top2", 1, [](Real t) { return 10 * t; });  // lifts it off
  auto march = loose->march({.end = 1, .steps = 4, .smallest = 1e-3});
  CHECK_FALSE(bool(march.finish()));
  CHECK(march.outcome().failure.cause == FailureCause::unsupported);
  CHECK(march.outcome().message().find("with side \"below\"") != std::string::npos);
  CHECK(loose->displacement().norm() < 10);
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
      CHECK(outcome.failure.cause == FailureCause::digits_lost);
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
TEST_CASE("forces are right to the tolerance for every penalty") {
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
TEST_CASE("forces at stiff penalties on an inclined tool are right, whatever the round-off") {
  for (unsigned seed = 0; seed < 10; ++seed)
    for (Real penalty = 1e12; penalty < 1e22; penalty *= 1e3) {
      CAPTURE(penalty);
      CAPTURE(seed);
      Problem<Model<EigenLdlt>> p({.body = disturbed(mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}), seed),
                                   .material = {.young = 1000, .poisson = 0.3},
                                   .contacts = {{.side = "bottom",
                                                 .tool = rigid::line({2, 0}, {1, 0.3}),
                                                 .enforcement = {.normal = penalty, .tangential = 1000},
                                                 .name = "slope"}}});
      p.hold("top", 0).drive("top", 1, [](Real t) { return -0.4 * t; });
      auto march = p.march({.end = 1, .steps = 10, .smallest = 1e-4, .tolerance = 1e-7});
      CHECK(march.finish().message() == "completed");
      CHECK(march.report().rejected_steps == 0);
      CHECK(p.contact_force("slope")[1] == doctest::Approx(-1851.13766).epsilon(1e-7));
      CHECK(p.reaction("top", 1) == doctest::Approx(-1851.13766).epsilon(1e-7));
    }
}
TEST_CASE("a block wedged between two inclined tools, at one node by both, is right at stiff penalties") {
  const auto force = [](Real penalty, unsigned seed) {
    Problem<Model<EigenLdlt>> p({.body = disturbed(mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}), seed),
                                 .material = {.young = 1000, .poisson = 0.3},
                                 .contacts = {{.side = "bottom",
                                               .tool = rigid::line({0, 0}, {1, 0.1}),
                                               .enforcement = {.normal = penalty},
                                               .name = "slope"},
                                              {.side = "left",
                                               .tool = rigid::line({0, 0}, {0.1, -1}),
                                               .enforcement = {.normal = penalty},
                                               .name = "wall"}}});
    p.drive("top", 0, [](Real t) { return -0.1 * t; }).drive("top", 1, [](Real t) { return -0.2 * t; });
    auto march = p.march({.end = 1, .steps = 5, .smallest = 1e-3});
    CHECK(march.finish().message() == "completed");
    CHECK(p.contact("slope").states().front().touching);
    CHECK(p.contact("wall").states().back().touching);
    return p.contact_force("slope")[1];
  };
  const Real soft = force(1e9, 0);
  for (unsigned seed = 1; seed < 4; ++seed)
    for (const Real penalty : {1e14, 1e17, 1e20}) CHECK(force(penalty, seed) == doctest::Approx(soft).epsilon(1e-5));
}
TEST_CASE("a body that no tool touches is in balance, however stiff sticking would be") {
  const auto bent = [](Real tangential) {
    Problem<M> p({.body = mesh::rectangle({.size = {4, 2}, .cells = {6, 3}}),
                  .material = material<FiniteJ2<PowerHardening>>(),
                  .contacts = {{.side = "right",
                                .tool = rigid::line({50, 0}, {0, 1}),
                                .friction = {.mu = 0.2},
                                .enforcement = {.normal = 1e5, .tangential = tangential},
                                .name = "far"}}});
    p.hold("bottom", 0).hold("bottom", 1).drive("top", 0, [](Real t) { return 0.5 * t; });
    auto march = p.march({.end = 1, .steps = 4, .tolerance = 1e-9});
    CHECK(march.finish().message() == "completed");
    CHECK(p.contact("far").summary().touching == 0);
    return Field(p.displacement());
  };
  const Field soft = bent(1e4);
  for (const Real tangential : {1e16, 1e24}) CHECK((bent(tangential) - soft).norm() < 1e-7 * soft.norm());
}
// Breaks, without a word, where it has been strained.
struct Brittle : Hencky {
  using Hencky::respond;
  template <class S, class TensorPattern>
  auto respond(const Deformation<S, TensorPattern>& deformation, const State<S, TensorPattern>& old, Real dt) const {
    Hencky law = *this;
    if (deformation.log_J != 0) law.young = nan;
    return law.respond(deformation, old, dt);
  }
};
TEST_CASE("what is not finite only on the way to a solution is told as digits_lost where sticking leaves none") {
  const auto fails = [](Real tangential, bool breaks) {
    auto p = std::make_unique<Problem<Model<EigenLdlt, QuasiCoulomb, Brittle>>>(
        Problem<Model<EigenLdlt, QuasiCoulomb, Brittle>>::Parameters{
            .body = mesh::rectangle({.size = {4, 2}, .cells = {6, 3}}),
            .material = {{.young = 69004, .poisson = 0.3}},
            .contacts = {{.side = "top",
                          .tool = rigid::disc({2, 7}, 5),
                          .motion = [=](Real t) { return V(!breaks && t > 0 ? nan : 0.3 * t, -0.4 * t); },
                          .friction = {.mu = 0.2},
                          .enforcement = {.normal = 1e5, .tangential = tangential},
                          .name = "punch"}}});
    p->hold("bottom", 0).hold("bottom", 1);
    auto march = p->march({.end = 1, .steps = 10, .smallest = 0.01});
    CHECK_FALSE(bool(march.finish()));
    return march.outcome();
  };
  CHECK(fails(1e4, true).failure.cause == FailureCause::not_finite);
  CHECK(fails(1e4, false).failure.cause == FailureCause::not_finite);
  CHECK(fails(1e20, false).failure.cause == FailureCause::not_finite);
  const Outcome lost = fails(1e20, true);
  CHECK(lost.failure.cause == FailureCause::digits_lost);
  CHECK(lost.detail.find("the tangential penalty of contact \"punch\"") != std::string::npos);
}
TEST_CASE("a body without strain is not refused as digits_lost") {
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
TEST_CASE("a body that springs back is at rest without iterations on its round-off") {
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
TEST_CASE("a straight strip at 700 times Euler's load reports its negative pivots and warns") {
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
    const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                                            verify::dense(p->system().tangent().stored), Eigen::EigenvaluesOnly)
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
