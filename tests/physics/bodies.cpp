// SPDX-License-Identifier: BSL-1.0
// Several bodies in one problem, without contact between them: each is what it is alone, blocks that share nodes act as
// one mesh, and everything has a name.
#include "scene.hpp"

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/io/checkpoint.hpp>
#include <stickslip/io/vtu.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/verify/energy.hpp>

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace several {
using namespace scene;

struct Metal {
  using Element = MeanDilatation<Quad4>;
  using Material = FiniteJ2<LinearHardening>;
};
struct Elastic {
  using Element = FullyIntegrated<Quad4>;
  using Material = Hencky;
};
// A lagging bound: what a first contact takes must not depend on the other body.
struct Two : Model<EigenLdlt, QuasiCoulomb> {
  using Bodies = BodyTypes<Metal, Elastic>;
};
struct Blocks : Model<EigenLdlt, Frictionless> {
  using Bodies = BodyTypes<Elastic>;
  using Enforcement = NoContact;
};
struct Flying : Two {
  using TimeIntegration = GeneralizedAlpha;
};
using Alone = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>>;
struct AloneElastic : Model<EigenLdlt, QuasiCoulomb, Hencky, PlaneStrain, FullyIntegrated<Quad4>> {};

static_assert(valid_model<Two> && system_symmetry<Blocks> == Symmetry::symmetric);
// One body costs what it costs without the types.
static_assert(std::is_same_v<Body<Alone>, detail::BodyOfType<Two, Metal>>);

mesh::Rectangle at(Real x) {
  return {.origin = {x, 0}, .size = {10, 5}, .cells = {8, 4}};
}
template <class M, class F = typename M::Friction>
Contact<M> under(const std::string& side, Real x, const std::string& name, const V& shift = V::Zero()) {
  return {.side = side,
          .tool = rigid::disc(V(x + 5, -20) + shift, 20),
          .friction = {.mu = 0.2},
          .enforcement = {.normal = 1e6, .tangential = 1e5},
          .name = name};
}
const auto down = [](Real t) { return -0.3 * t; };
// The first body touches its tool, on a slope, when the stiffer second one is pressed already.
const V late(4, -0.1);

Problem<Two>::Parameters pair() {
  return {
      .bodies = {{{.name = "blank", .mesh = mesh::rectangle(at(0)), .material = material<FiniteJ2<LinearHardening>>()}},
                 {{.name = "die", .mesh = mesh::rectangle(at(30)), .material = material<Hencky>()}}},
      .contacts = {under<Two>("blank.bottom", 0, "first", late), under<Two>("die.bottom", 30, "second")}};
}
template <class P>
void press(P& problem, const std::string& body) {
  problem.hold(body + "top", 0).drive(body + "top", 1, down);
}

TEST_CASE("two bodies of different materials in one problem are what each is alone") {
  Problem<Two> both(pair());
  press(both, "blank.");
  press(both, "die.");
  Problem<Alone> blank{{.body = mesh::rectangle(at(0)),
                        .material = material<FiniteJ2<LinearHardening>>(),
                        .contacts = {under<Alone>("bottom", 0, "first", late)}}};
  Problem<AloneElastic> die{{.body = mesh::rectangle(at(30)),
                             .material = material<Hencky>(),
                             .contacts = {under<AloneElastic>("bottom", 30, "second")}}};
  press(blank, "");
  press(die, "");
  const MarchOptions options{.end = 1, .steps = 8, .tolerance = 1e-10};
  REQUIRE(bool(both.march(options).finish()));
  REQUIRE(bool(blank.march(options).finish()));
  REQUIRE(bool(die.march(options).finish()));
  const Index nodes = blank.body().mesh().node_count();
  CHECK(both.unknowns() == blank.unknowns() + die.unknowns());
  CHECK((both.displacement().head(2 * nodes) - blank.displacement()).norm() < 1e-9 * blank.displacement().norm());
  CHECK((both.displacement().tail(2 * nodes) - die.displacement()).norm() < 1e-9 * die.displacement().norm());
  CHECK((both.contact_force("first") - blank.contact_force("first")).norm() <
        1e-7 * blank.contact_force("first").norm());
  CHECK((both.contact_force("second") - die.contact_force("second")).norm() <
        1e-7 * die.contact_force("second").norm());
  CHECK(both.reaction("blank.top", 1) == doctest::Approx(blank.reaction("top", 1)).epsilon(1e-7));
  CHECK(both.reaction("die.top", 1) == doctest::Approx(die.reaction("top", 1)).epsilon(1e-7));
  CHECK(both.max_plastic_strain() == doctest::Approx(blank.max_plastic_strain()).epsilon(1e-7));
  CHECK(both.max_plastic_strain() > 1e-3);
}

// A column of two blocks, the lower one ten times as soft; without lateral strain at a Poisson's ratio of 0.
auto column() {
  auto whole = mesh::rectangle({.size = {2, 4}, .cells = {2, 8}});
  for (Index e = 0; e < whole.cell_count(); ++e) {
    const auto& cell = whole.cells[static_cast<std::size_t>(e)];
    Real y = 0;
    for (const Index n : cell) y += whole.nodes[static_cast<std::size_t>(n)][1] / 4;
    whole.blocks[y < 1.5 ? "low" : "high"].push_back(e);
  }
  return whole;
}
Problem<Blocks>::Parameters blocks(Real low, Real high) {
  const auto whole = column();
  return {.bodies = {{.name = "low", .mesh = mesh::block(whole, "low"), .material = {.young = low, .poisson = 0}},
                     {.name = "high",
                      .mesh = mesh::block(whole, "high"),
                      .material = {.young = high, .poisson = 0},
                      .nodes_of = "low"}}};
}

TEST_CASE("blocks that share nodes carry one force, each with its own stiffness") {
  Problem<Blocks> p(blocks(100, 1000));
  p.hold("low.bottom", 1).hold("low.left", 0).hold("high.left", 0).drive("high.top", 1, [](Real t) {
    return -0.4 * t;
  });
  REQUIRE(bool(p.march({.end = 1, .steps = 4, .tolerance = 1e-12}).finish()));
  // P = E ln(lambda) / lambda in both, and 1.5 lambda_low + 2.5 lambda_high = 3.6: Hencky's law along one axis.
  const auto stress = [](Real young, Real lambda) { return young * std::log(lambda) / lambda; };
  Real a = 0.7, b = 1;  // of lambda_low
  for (int k = 0; k < 200; ++k) {
    const Real middle = 0.5 * (a + b), other = (3.6 - 1.5 * middle) / 2.5;
    (stress(100, middle) < stress(1000, other) ? a : b) = middle;
  }
  CHECK(p.reaction("high.top", 1) == doctest::Approx(2 * stress(100, a)).epsilon(1e-9));
  CHECK(p.reaction("low.bottom", 1) == doctest::Approx(-2 * stress(100, a)).epsilon(1e-9));
}

TEST_CASE("blocks of one material act as the mesh that they are of") {
  Problem<Blocks> parts(blocks(500, 500));
  using One = Lone<EigenLdlt, Hencky, PlaneStrain, FullyIntegrated<Quad4>>;
  Problem<One> whole{{.body = column(), .material = {.young = 500, .poisson = 0}}};
  parts.hold("low.bottom", 0).hold("low.bottom", 1).drive("high.top", 0, [](Real t) { return 0.5 * t; });
  whole.hold("bottom", 0).hold("bottom", 1).drive("top", 0, [](Real t) { return 0.5 * t; });
  REQUIRE(bool(parts.march({.end = 1, .steps = 4, .tolerance = 1e-12}).finish()));
  REQUIRE(bool(whole.march({.end = 1, .steps = 4, .tolerance = 1e-12}).finish()));
  CHECK(parts.unknowns() == whole.unknowns());
  CHECK((parts.displacement() - whole.displacement()).norm() < 1e-10 * whole.displacement().norm());
}

TEST_CASE("the body that nothing holds is named") {
  auto parameters = pair();
  parameters.contacts.pop_back();
  Problem<Two> both(std::move(parameters));
  press(both, "blank.");
  both.hold("die.top", 0);
  auto march = both.march({.end = 1, .steps = 2});
  CHECK_FALSE(bool(march.finish()));
  CHECK(march.outcome().failure.cause == FailureCause::unsupported);
  CHECK(march.outcome().detail == "body \"die\"");
}

TEST_CASE("masses and energies of several bodies add up, each with its own density") {
  Problem<Flying>::Parameters parameters{.contacts = {}};
  parameters.bodies = {
      {{.name = "blank",
        .mesh = mesh::rectangle(at(0)),
        .material = {.young = 10, .poisson = 0.3, .hardening = {.yield = 1, .modulus = 1}},
        .density = 2}},
      {{.name = "die", .mesh = mesh::rectangle(at(30)), .material = {.young = 10, .poisson = 0.3}, .density = 3}}};
  Problem<Flying> p(std::move(parameters));
  p.start_velocity({0, 1});
  auto march = p.march({.end = 0.1, .steps = 4, .tolerance = 1e-10});
  verify::EnergyBalance<Flying> energy(p);
  for (const StepReport& step : march) energy.update(step);
  REQUIRE(bool(march.outcome()));
  CHECK(p.inertia().kinetic_energy() == doctest::Approx(0.5 * 50 * (2 + 3)).epsilon(1e-12));
  CHECK(std::abs(energy.energies().unbalanced()) < 1e-10 * 125);
}

// The numbers of an array of a VTU file: base64 of their count in bytes and of themselves.
std::vector<Real> decoded(const std::string& text, const std::string& name) {
  const auto begin = text.find(">", text.find("Name=\"" + name + "\"")) + 1, end = text.find("</DataArray>", begin);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : text.substr(begin, end - begin)) {
    const auto digit = digits.find(c);
    if (digit == digits.npos) continue;
    buffer = buffer << 6 | unsigned(digit);
    if ((bits += 6) >= 8) bytes.push_back(char(buffer >> (bits -= 8) & 0xff));
  }
  std::vector<Real> values(bytes.size() / sizeof(Real) - 1);
  std::memcpy(values.data(), bytes.data() + sizeof(Real), values.size() * sizeof(Real));
  return values;
}

TEST_CASE("a restart file and a picture know all bodies") {
  const auto folder = std::filesystem::temp_directory_path() / "stickslip_bodies";
  std::filesystem::create_directories(folder);
  const auto file = folder / "state", picture = folder / "bodies.vtu";
  Problem<Two> first(pair()), second(pair());
  for (Problem<Two>* p : {&first, &second}) {
    press(*p, "blank.");
    press(*p, "die.");
  }
  auto whole = first.march({.end = 1, .steps = 4});
  for (const StepReport& step : whole)
    if (step.number == 2) io::save(file, whole);
  auto rest = second.march({.end = 1, .steps = 4});
  io::load(file, rest);
  REQUIRE(bool(rest.finish()));
  CHECK(second.displacement() == first.displacement());  // to the bit
  io::write_vtu(picture, first);
  std::stringstream text;
  text << std::ifstream(picture).rdbuf();
  CHECK(text.str().find("NumberOfPoints=\"90\" NumberOfCells=\"64\"") != std::string::npos);
  const auto array = [&](const std::string& name) { return decoded(text.str(), name); };
  const std::vector<Real> body = array("body"), slip = array("slip"), mises = array("von_mises_stress"),
                          stress = array("cauchy_stress"), plastic = array("plastic_strain");
  CHECK(std::count(body.begin(), body.end(), 0.0) == 32);
  CHECK(std::count(body.begin(), body.end(), 1.0) == 32);
  CHECK(std::count_if(plastic.begin(), plastic.end(), [](Real p) { return std::isnan(p); }) == 32);
  Real largest = 0;
  for (const char* name : {"first", "second"})
    for (const auto& node : first.contact(name).states()) largest = std::max(largest, node.accumulated_slip);
  CHECK(largest > 0);
  CHECK(*std::max_element(slip.begin(), slip.end()) == largest);
  for (std::size_t e = 0; e < mises.size(); ++e) {
    // The mean of von Mises' stress is at least that of the mean stress.
    const Real *s = &stress[6 * e], mean = (s[0] + s[1] + s[2]) / 3;
    const Real of_mean = std::sqrt(1.5 * (std::pow(s[0] - mean, 2) + std::pow(s[1] - mean, 2) +
                                          std::pow(s[2] - mean, 2) + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])));
    CHECK(mises[e] >= of_mean * (1 - 1e-12));
    CHECK(mises[e] <= 2 * of_mean + 20);
  }
  auto other = pair();
  std::get<1>(other.bodies)[0].mesh = mesh::rectangle(at(31));
  Problem<Two> unlike(std::move(other));
  press(unlike, "blank.");
  press(unlike, "die.");
  auto wrong = unlike.march({.end = 1, .steps = 4});
  CHECK_THROWS_WITH_AS(io::load(file, wrong), doctest::Contains("mesh of body die"), std::runtime_error);
  std::filesystem::remove_all(folder);
}

template <class F>
std::string complaint(F&& f) {
  try {
    f();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "none";
}

TEST_CASE("faults of the description of bodies are named") {
  CHECK(complaint([] { Problem<Two> p(Problem<Two>::Parameters{}); }) == "bodies: there is none");
  auto twice = pair();
  std::get<1>(twice.bodies)[0].name = "blank";
  CHECK(complaint([&] { Problem<Two> p(std::move(twice)); }) == "bodies: two are called \"blank\"");
  auto nameless = pair();
  std::get<0>(nameless.bodies)[0].name = std::get<1>(nameless.bodies)[0].name = "";
  CHECK(complaint([&] { Problem<Two> p(std::move(nameless)); }) == "bodies: one of several has no name");
  Problem<Two> p(pair());
  CHECK(complaint([&] { p.hold("top", 0); }) ==
        "there is no side called \"top\": sides are named \"body.side\", and the bodies are blank, die");
  CHECK(complaint([&] { p.hold("die.lid", 0); }) ==
        "the mesh has no side called \"lid\"; it has: bottom, left, right, top");
  auto far = blocks(1, 1);
  far.bodies[1].nodes_of = "middle";
  CHECK(complaint([&] { Problem<Blocks> q(std::move(far)); }) ==
        "body \"high\": there is no body \"middle\" before it to share nodes with");
  auto unlike = blocks(1, 1);
  unlike.bodies[1].mesh.nodes[3][0] += 0.1;
  CHECK(complaint([&] { Problem<Blocks> q(std::move(unlike)); }) ==
        "body \"high\": its mesh does not have the nodes of body \"low\", which it is to share");
  auto half = blocks(1, 1);
  half.bodies.pop_back();
  CHECK(complaint([&] { Problem<Blocks> q(std::move(half)); }).find("of the mesh is in no cell") != std::string::npos);
  CHECK(complaint([] { (void)mesh::block(column(), "middle"); }) ==
        "the mesh has no block called \"middle\"; it has: high, low");
  Problem<Flying>::Parameters light;
  light.bodies = {
      {{.name = "blank", .mesh = mesh::rectangle(at(0)), .material = material<FiniteJ2<LinearHardening>>()}}, {}};
  CHECK(complaint([&] { Problem<Flying> q(std::move(light)); }) == "body \"blank\": the density must be positive");
}

}  // namespace several
