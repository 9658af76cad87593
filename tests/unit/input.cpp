// SPDX-License-Identifier: BSL-1.0
// Wrong input: std::invalid_argument before any work, and the message names the input.
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

#include <doctest/doctest.h>

#include <limits>

namespace {

using namespace stickslip;

template <class K, class H>
struct Model {
  using Kinematics = K;
  using Element = MeanDilatation<Quad4>;
  using Material = FiniteJ2<H>;
  using Friction = QuasiCoulomb;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = EigenLdlt;
};
using Plane = Model<PlaneStrain, LinearHardening>;
using Turned = Model<Axisymmetric, PowerHardening>;

constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();

// The message of the invalid_argument that f throws; empty if it throws none.
template <class F>
std::string complaint(F&& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}
#define COMPLAINS(part, ...) CHECK(complaint([&] { __VA_ARGS__; }).find(part) != std::string::npos)

Problem<Plane>::Parameters good() {
  return {.body = mesh::rectangle({.size = {1, 1}, .cells = {2, 2}}),
          .material = {.young = 1000, .poisson = 0.3, .hardening = {.yield = 10, .modulus = 1}},
          .contacts = {{.side = "top",
                        .tool = rigid::line({0, 1.1}, {-1, 0}),
                        .friction = {.mu = 0.1},
                        .enforcement = {.normal = 1e3, .tangential = 1e2}}}};
}
Problem<Turned>::Parameters good_turned() {
  return {.body = mesh::rectangle({.size = {1, 1}, .cells = {2, 2}}),
          .material = {.young = 1000, .poisson = 0.3, .hardening = {.strength = 10, .offset = 1e-3, .exponent = 0.2}}};
}
template <class M, class Change>
std::string after(typename Problem<M>::Parameters parameters, Change&& change) {
  change(parameters);
  return complaint([&] { const Problem<M> problem(parameters); });
}
bool says(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("valid input is accepted") {
  CHECK(complaint([] { const Problem<Plane> p(good()); }).empty());
  CHECK(complaint([] { const Problem<Turned> p(good_turned()); }).empty());
}

TEST_CASE("wrong profiles are refused by name") {
  using rigid::path;
  COMPLAINS("heading", (void)path({0, 0}, {0, 0}));
  COMPLAINS("start", (void)path({nan, 0}, {1, 0}));
  COMPLAINS("heading", (void)path({0, 0}, {infinity, 0}));
  COMPLAINS("length", path({0, 0}, {1, 0}).straight(0));
  COMPLAINS("length", path({0, 0}, {1, 0}).straight(-1));
  COMPLAINS("length", path({0, 0}, {1, 0}).straight(nan));
  COMPLAINS("radius", path({0, 0}, {1, 0}).right(0, 1));
  COMPLAINS("radius", path({0, 0}, {1, 0}).left(infinity, 1));
  COMPLAINS("angle", path({0, 0}, {1, 0}).right(1, 0));
  COMPLAINS("angle", path({0, 0}, {1, 0}).left(1, 7));
  COMPLAINS("angle", path({0, 0}, {1, 0}).left(1, nan));
  COMPLAINS("corner's angle", path({0, 0}, {1, 0}).straight(1).corner(nan));
  COMPLAINS("endless", path({0, 0}, {1, 0}).endless());
  COMPLAINS("endless", path({0, 0}, {1, 0}).right(1, 1).endless());
  COMPLAINS("end where it starts", path({0, 0}, {1, 0}).straight(1).close());
  COMPLAINS("end where it starts", path({0, 0}, {1, 0}).close());
  COMPLAINS("two points", (void)rigid::rounded({{0, 0}}, 0.1));
  COMPLAINS("radius", (void)rigid::rounded({{0, 0}, {1, 0}, {1, 1}}, -1));
  COMPLAINS("point 1", (void)rigid::rounded({{0, 0}, {1, 0}, {1, 1}}, 2));
  COMPLAINS("point 2", (void)rigid::rounded({{0, 0}, {5, 0}, {5, 1}, {0, 1}}, 0.9));
}

TEST_CASE("wrong parameters of mesh generators are refused by name") {
  COMPLAINS("cell", (void)mesh::rectangle({.cells = {0, 1}}));
  COMPLAINS("cell", (void)mesh::rectangle({.cells = {1, -1}}));
  COMPLAINS("size", (void)mesh::rectangle({.size = {0, 1}}));
  COMPLAINS("size", (void)mesh::rectangle({.size = {1, infinity}}));
  COMPLAINS("size", (void)mesh::rectangle({.size = {nan, 1}}));
  COMPLAINS("cell", (void)mesh::box({.cells = {1, 0, 1}}));
  COMPLAINS("size", (void)mesh::box({.size = {1, 1, 0}}));
  COMPLAINS("size", (void)mesh::box({.size = {1, nan, 1}}));
  COMPLAINS("size", (void)mesh::box({.origin = {infinity, 0, 0}}));
  COMPLAINS("back, bottom, front, left, right, top", (void)mesh::box({}).side("middle"));
  const auto m = mesh::rectangle({});
  COMPLAINS("\"front\"", (void)m.side("front"));
  COMPLAINS("bottom, left, right, top", (void)m.side("front"));
}

TEST_CASE("wrong cells and sides of a body are refused by name") {
  CHECK(says(after<Plane>(good(), [](auto& p) { p.body = {}; }), "no cells"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.body.cells[3][0] = 99; }), "cell 3"));
  CHECK(says(after<Plane>(good(),
                          [](auto& p) {
                            std::swap(p.body.cells[1][0], p.body.cells[1][2]),
                                std::swap(p.body.cells[1][0], p.body.cells[1][1]);
                          }),
             "cell 1"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.body.nodes[4][0] = nan; }), "cell 0"));
  CHECK(says(after<Turned>(good_turned(),
                           [](auto& p) {
                             for (auto& n : p.body.nodes) n[0] -= 5;
                           }),
             "positive radius"));
}

TEST_CASE("wrong parameters of material and kinematics are refused by name") {
  CHECK(says(after<Plane>(good(), [](auto& p) { p.kinematics.thickness = 0; }), "thickness"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.kinematics.thickness = nan; }), "thickness"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.young = 0; }), "Young"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.young = nan; }), "Young"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.young = infinity; }), "Young's modulus must be finite"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.kinematics.thickness = infinity; }), "thickness must be finite"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.hardening.yield = infinity; }), "yield stress must be f"));
  CHECK(says(after<Turned>(good_turned(), [](auto& p) { p.material.hardening.strength = infinity; }), "strength must"));
  CHECK(says(after<Turned>(good_turned(), [](auto& p) { p.material.hardening.offset = infinity; }), "offset must"));
  CHECK(says(after<Turned>(good_turned(), [](auto& p) { p.material.hardening.offset = nan; }), "offset must"));
  COMPLAINS("yield stress must be finite", PerfectPlasticity{.yield = infinity}.validate());
  COMPLAINS("saturation", (VoceHardening{.yield = 1, .saturation = infinity, .rate = 1}.validate()));
  COMPLAINS("rate", (VoceHardening{.yield = 1, .saturation = 2, .rate = infinity}.validate()));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.poisson = 0.5; }), "Poisson"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.poisson = -1; }), "Poisson"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.hardening.yield = 0; }), "yield"));
  CHECK(says(after<Plane>(good(), [](auto& p) { p.material.hardening.modulus = nan; }), "modulus"));
  CHECK(says(after<Turned>(good_turned(), [](auto& p) { p.material.hardening.strength = 0; }), "strength"));
  CHECK(says(after<Turned>(good_turned(), [](auto& p) { p.material.hardening.offset = 0; }), "offset"));
  CHECK(says(after<Turned>(good_turned(), [](auto& p) { p.material.hardening.exponent = 1.1; }), "exponent"));
}

TEST_CASE("wrong parameters of a contact are refused by name") {
  const auto contact = [](auto change) { return after<Plane>(good(), [&](auto& p) { change(p.contacts[0]); }); };
  CHECK(says(contact([](auto& c) { c.side = "lid"; }), "\"lid\""));
  CHECK(says(contact([](auto& c) { c.tool = rigid::path({0, 0}, {1, 0}); }), "contact \"top\""));
  CHECK(says(contact([](auto& c) { c.enforcement.normal = 0; }), "normal stiffness"));
  CHECK(says(contact([](auto& c) { c.enforcement.tangential = -1; }), "tangential stiffness"));
  CHECK(says(contact([](auto& c) { c.enforcement.tangential = 0; }), "contact \"top\": friction needs"));
  CHECK(says(contact([](auto& c) { c.friction.mu = -0.1; }), "mu"));
  CHECK(says(contact([](auto& c) { c.friction.mu = nan; }), "mu"));
  CHECK(says(contact([](auto& c) { c.friction.mu = infinity; }), "mu must be finite"));
  CHECK(says(contact([](auto& c) { c.enforcement.normal = infinity; }), "normal stiffness must be finite"));
  CHECK(says(contact([](auto& c) { c.enforcement.tangential = infinity; }), "tangential stiffness must be finite"));
  COMPLAINS("normal stiffness must be finite", AugmentedLagrangian{.normal = infinity}.validate());
  COMPLAINS("tangential stiffness must be finite", AugmentedLagrangian{.tangential = infinity}.validate());
  CHECK(says(after<Plane>(good(), [](auto& p) { p.contacts.push_back(p.contacts[0]); }), "\"top\""));
}

TEST_CASE("wrong parameters of friction laws are refused by name") {
  CappedCoulomb{.mu = 0.1, .tau_max = infinity}.validate();
  COMPLAINS("mu ", (CappedCoulomb{.mu = -0.1, .tau_max = 1}.validate()));
  COMPLAINS("tau_max", (CappedCoulomb{.mu = 0.1}.validate()));
  COMPLAINS("tau_max", (CappedCoulomb{.mu = 0.1, .tau_max = nan}.validate()));
  COMPLAINS("tau ", Tresca{.tau = -1}.validate());
  COMPLAINS("tau ", Tresca{.tau = nan}.validate());
  COMPLAINS("mu_dynamic", (SlipWeakeningCoulomb{.mu_static = 0.1, .mu_dynamic = 0.2, .length = 1}.validate()));
  COMPLAINS("mu_dynamic", (SlipWeakeningCoulomb{.mu_static = 0.1, .mu_dynamic = -0.2, .length = 1}.validate()));
  COMPLAINS("length", (SlipWeakeningCoulomb{.mu_static = 0.2, .mu_dynamic = 0.1}.validate()));
  COMPLAINS("mu_static", (Stribeck{.mu_static = nan, .speed = 1}.validate()));
  COMPLAINS("speed", Stribeck{.mu_static = 0.2}.validate());
  COMPLAINS("rounding", (Stribeck{.mu_static = 0.2, .speed = 1, .rounding = 0}.validate()));
  COMPLAINS("mu must be finite", (CappedCoulomb{.mu = infinity, .tau_max = 1}.validate()));
  COMPLAINS("tau must be finite", Tresca{.tau = infinity}.validate());
  COMPLAINS("mu_static must be finite", (SlipWeakeningCoulomb{.mu_static = infinity, .length = 1}.validate()));
  COMPLAINS("length must be finite", (SlipWeakeningCoulomb{.mu_static = 0.2, .length = infinity}.validate()));
  COMPLAINS("mu_static must be finite", (Stribeck{.mu_static = infinity, .speed = 1}.validate()));
  COMPLAINS("speed must be finite", (Stribeck{.mu_static = 0.2, .speed = infinity}.validate()));
  COMPLAINS("rounding must be finite", (Stribeck{.mu_static = 0.2, .speed = 1, .rounding = infinity}.validate()));
  COMPLAINS("mu_along must be finite", (AnisotropicCoulomb{.mu_along = infinity, .mu_across = 1}.validate()));
  COMPLAINS("mu_across must be finite", (AnisotropicCoulomb{.mu_along = 1, .mu_across = infinity}.validate()));
}

TEST_CASE("wrong parameters of generalised-alpha are refused by name") {
  COMPLAINS("density must be finite", GeneralizedAlpha{.density = infinity}.validate());
  COMPLAINS("density must be positive", GeneralizedAlpha{.density = nan}.validate());
  COMPLAINS("gamma", (GeneralizedAlpha{.density = 1, .scheme = {.gamma = nan}}.validate()));
  COMPLAINS("beta", (GeneralizedAlpha{.density = 1, .scheme = {.beta = infinity}}.validate()));
  COMPLAINS("alpha_m must be finite", (GeneralizedAlpha{.density = 1, .scheme = {.alpha_m = nan}}.validate()));
  COMPLAINS("alpha_f must be finite", (GeneralizedAlpha{.density = 1, .scheme = {.alpha_f = nan}}.validate()));
  COMPLAINS("below 1", (GeneralizedAlpha{.density = 1, .scheme = {.alpha_f = 1}}.validate()));
  COMPLAINS("Newmark", (void)newmark(infinity));
  COMPLAINS("Newmark", (void)newmark(0.25, infinity));
  COMPLAINS("spectral radius", (void)chung_hulbert(nan));
  COMPLAINS("alpha", (void)hht(nan));
}

TEST_CASE("unknown sides, components and contacts are refused by name") {
  Problem<Plane> p(good());
  COMPLAINS("\"lid\"", p.hold("lid", 0));
  COMPLAINS("component 2", p.hold("top", 2));
  COMPLAINS("component -1", p.drive("top", -1, [](Real t) { return t; }));
  COMPLAINS("\"top\"", p.load("top", 0, nullptr));
  COMPLAINS("\"lid\"", p.load("lid", 0, [](Real t) { return t; }));
  auto pointed = good();
  pointed.body.sides["point"].nodes = {0};
  Problem<Plane> point(pointed);
  COMPLAINS("\"point\"", point.load("point", 0, [](Real t) { return t; }));
  COMPLAINS("\"punch\"", (void)p.contact("punch"));
  COMPLAINS("\"lid\"", (void)p.reaction("lid", 0));
  COMPLAINS("component 2", (void)p.reaction("top", 2));
  auto parameters = good();
  parameters.contacts[0].motion = [](Real) { return Vec<Real, 2>(nan, 0); };
  Problem<Plane> nowhere(parameters);
  COMPLAINS("contact \"top\"", (void)nowhere.march({}));
}

TEST_CASE("nodes that start deep inside a tool are refused") {
  // A unit block of elements of a quarter, over a floor half its height below.
  const auto begins = [](rigid::Profile tool, Real start_depth = 0) {
    auto parameters = good();
    parameters.body = mesh::rectangle({.size = {1, 1}, .cells = {4, 4}});
    parameters.contacts[0].side = "bottom";
    parameters.contacts[0].tool = std::move(tool);
    parameters.contacts[0].start_depth = start_depth;
    parameters.contacts[0].name = "floor";
    return complaint([&] {
      Problem<Plane> p(parameters);
      p.hold("top", 0).hold("top", 1);
      (void)p.march({});
    });
  };
  CHECK(begins(rigid::line({0, -0.5}, {1, 0})).empty());
  // The wrong way round.
  for (const char* part :
       {"contact \"floor\": node ", " starts 0.5 deep inside the tool", "0.25 away", "wrong way round", "start_depth"})
    CHECK_MESSAGE(says(begins(rigid::line({0, -0.5}, {-1, 0})), part), begins(rigid::line({0, -0.5}, {-1, 0})));
  // A fit of up to an element; a deeper one where it is asked for.
  CHECK(begins(rigid::line({0, 0.25}, {1, 0})).empty());
  CHECK(says(begins(rigid::line({0, 0.26}, {1, 0})), "0.26 deep"));
  CHECK(begins(rigid::line({0, 0.26}, {1, 0}), 0.3).empty());
  CHECK(says(begins(rigid::line({0, 0.31}, {1, 0}), 0.3), "0.31 deep"));
  CHECK(begins(rigid::line({0, -0.5}, {-1, 0}), infinity).empty());
  // A wall that ends below the block's upper half: nodes past its open end see nothing, those behind its foot see its
  // back. The node at the origin is named, not the others.
  CHECK(says(begins(rigid::path({0.6, 0.5}, {0, -1}).straight(2)), "node 0 starts 0.6 deep"));
  // Side walls and base of a cup that the block stands in: no node is behind any of them.
  CHECK(begins(rigid::path({0, 1}, {0, -1}).straight(1).corner(pi / 2).straight(1).corner(pi / 2).straight(1)).empty());
  CHECK(says(begins(rigid::line({0, -0.5}, {1, 0}), nan), "start_depth"));
  CHECK(says(begins(rigid::line({0, -0.5}, {1, 0}), -1), "start_depth"));
}

TEST_CASE("a tool smaller than the mesh gives a warning with its size") {
  using rigid::path;
  const auto size = [](const rigid::Profile& p) { return p.smallest_size(); };
  CHECK(size(rigid::line({0, 0}, {1, 0})) == infinity);
  CHECK(size(rigid::disc({3, 4}, 0.05)) == doctest::Approx(0.05));
  CHECK(size(path({0, 0}, {1, 0}).straight(2)) == doctest::Approx(2));
  CHECK(size(path({0, 0}, {1, 1}).straight(2).right(0.2, pi / 2).straight(1)) == doctest::Approx(0.2));
  CHECK(size(path({0, 0}, {1, 1}).straight(2).left(0.2, pi / 2).straight(3)) > 2);  // re-entrant
  const auto bar = [](Real angle) {
    auto p = path({1, 2}, {std::cos(angle), std::sin(angle)});
    for (const Real side : {4.0, 0.5, 4.0, 0.5}) p.straight(side).corner(-pi / 2);
    return p.close();
  };
  for (const Real angle : {0.0, 0.3, 1.0}) CHECK(size(bar(angle)) == doctest::Approx(0.5).epsilon(1e-9));
  CHECK(size(path({0, 0}, {0, 1}).straight(5).corner(-pi / 2).straight(0.1).corner(-pi / 2).straight(5).endless()) ==
        doctest::Approx(0.1));  // a wall
  CHECK(size(path({0, 0}, {0, 1}).straight(5).corner(-pi / 4).straight(0.1).corner(-pi / 4).straight(5).endless()) ==
        infinity);  // a chamfer
  CHECK(rigid::plane({0, 0, 0}, {0, 0, 1}).smallest_size() == infinity);
  CHECK(rigid::sphere({1, 0, 0}, 0.3).smallest_size() == doctest::Approx(0.3));
  CHECK(rigid::cylinder({1, 0, 0}, {1, 2, 3}, 0.3).smallest_size() == doctest::Approx(0.3));
  CHECK(rigid::cone({1, 0, 0}, {1, 2, 3}, 0.3).smallest_size() == infinity);
  CHECK(rigid::torus({1, 0, 0}, {1, 2, 3}, 5, 0.3).smallest_size() == doctest::Approx(0.3));
  const rigid::Revolution pin(path({0, 0}, {-1, 0}).straight(0.2).corner(-pi / 2).straight(9), {0, 0, 0}, {0, 0, 1});
  CHECK(pin.smallest_size() == doctest::Approx(0.2));
  const rigid::Extruded rod(rigid::disc({0, 0}, 0.1), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK(rod.smallest_size() == doctest::Approx(0.1));
  CHECK(rigid::Tool<3>(rod).smallest_size() == doctest::Approx(0.1));

  const auto warnings = [](Real radius) {
    auto parameters = good();
    parameters.contacts[0].tool = rigid::disc({0.5, 1 + radius}, radius);
    Problem<Plane> p(parameters);
    p.hold("bottom", 0).hold("bottom", 1);
    auto march = p.march({.end = 1, .steps = 3});
    CHECK(bool(march.finish()));
    return march.warnings();
  };
  CHECK(warnings(0.2).empty());  // nodes are half a unit apart
  const auto told = warnings(0.15);
  REQUIRE(told.size() == 1);
  CHECK(told[0].name == "tool_smaller_than_mesh");
  CHECK(told[0].step == 0);
  CHECK(told[0].count == 1);
  for (const char* part : {"contact \"top\"", "0.15", "0.5"}) CHECK(says(told[0].text, part));
}

TEST_CASE("nodes that do not exist or are in no cell are refused by number") {
  const auto message = [](auto change) { return after<Plane>(good(), [&](auto& p) { change(p.body); }); };
  CHECK(says(message([](auto& m) { m.cells[3][0] = 99; }),
             "cell 3 names a node that does not exist, 99: the mesh has 9"));
  CHECK(says(message([](auto& m) { m.cells[2][1] = -7; }), "cell 2 names a node that does not exist, -7"));
  CHECK(says(message([](auto& m) { m.nodes.push_back({5, 5}); }), "node 9 of the mesh is in no cell"));
  CHECK(says(message([](auto& m) { m.sides["left"].nodes.push_back(9); }),
             "side \"left\" names a node that does not ex"));
  CHECK(says(message([](auto& m) { m.sides["left"].nodes[1] = -7; }),
             "side \"left\" names a node that does not exist, -7"));
  CHECK(says(message([](auto& m) { m.sides["left"].facets[1][0] = 1 << 30; }), "side \"left\", facet 1 names a node"));
  CHECK(says(message([](auto& m) { m.sides["left"].facets[1][0] = -7; }), "side \"left\", facet 1 names a node"));
  CHECK(says(message([](auto& m) { m.sides["left"].nodes.push_back(m.sides["left"].nodes[0]); }),
             "side \"left\" has node"));
  CHECK(says(message([](auto& m) {
               auto f = m.sides["left"].facets[0];
               std::swap(f[0], f[1]);
               m.sides["left"].facets.push_back(f);
             }),
             "side \"left\" has a facet twice: 2 joins the nodes of 0"));
}

TEST_CASE("wrong march options are refused by name") {
  Problem<Plane> p(good());
  COMPLAINS("end", (void)p.march({.end = 0}));
  COMPLAINS("end", (void)p.march({.end = infinity}));
  COMPLAINS("end", (void)p.march({.end = nan}));
  COMPLAINS("steps", (void)p.march({.steps = -1}));
  COMPLAINS("tolerance", (void)p.march({.tolerance = 0}));
  COMPLAINS("tolerance", (void)p.march({.tolerance = 1}));
  COMPLAINS("tolerance", (void)p.march({.tolerance = nan}));
  COMPLAINS("iteration", (void)p.march({.max_iterations = 0}));
  COMPLAINS("step sizes", (void)p.march({.initial = -1}));
  COMPLAINS("step sizes", (void)p.march({.largest = -1}));
  COMPLAINS("step sizes", (void)p.march({.smallest = -1}));
  for (const Real wrong : {nan, infinity}) {
    COMPLAINS("step size", (void)p.march({.initial = wrong}));
    COMPLAINS("step size", (void)p.march({.largest = wrong}));
    COMPLAINS("step size", (void)p.march({.smallest = wrong}));
    COMPLAINS("stop must be finite", (void)p.march({.stops = {0.5, wrong}}));
    COMPLAINS("pass tolerance", (void)p.march({.outer_tolerance = wrong}));
    COMPLAINS("time tolerance", (void)p.march({.time_tolerance = wrong}));
    COMPLAINS("lag tolerance", (void)p.march({.lag_tolerance = wrong}));
    COMPLAINS("step tolerance", (void)p.march({.step_tolerance = wrong}));
  }
  COMPLAINS("target_iterations", (void)p.march({.target_iterations = 0}));
  COMPLAINS("target_iterations", (void)p.march({.target_iterations = -4}));
  COMPLAINS("a first step of 1e-40 is below", (void)p.march({.initial = 1e-40}));
}

}  // namespace
