// SPDX-License-Identifier: BSL-1.0
// A round sheet under a hemispherical punch, as a section that turns about the axis and as a quarter in space: what is
// known of the symmetry in the one must come out of the other.
#include <stickslip/stickslip.hpp>

#include <doctest/doctest.h>

#include <map>

namespace sheet {

using namespace stickslip;

struct Section : QuasistaticDefaults {
  using Kinematics = Axisymmetric;
  using Material = FiniteJ2<PowerHardening>;
  using Friction = QuasiCoulomb;
};
struct Quarter : Section {
  using Kinematics = ThreeDimensional;
  using Element = MeanDilatation<Hex8>;
  using Tool = rigid::Revolution;
};

constexpr Real rim = 59.18, travel = 8;
const Penalty penalty{.normal = 850, .tangential = 85, .per = PenaltyPer::area};
const rigid::Profile sphere = rigid::path({50.8, 51.8}, {0, -1}).right(50.8, pi),
                     die = rigid::path({52.83, -106.35}, {0, 1}).straight(100).right(6.35, pi / 2).straight(40);

template <class Model, class ToolOfProfile>
Problem<Model> make_sheet(typename Body<Model>::MeshType mesh, ToolOfProfile&& tool) {
  constexpr int dim = Model::Kinematics::dim;
  return Problem<Model>{{
      .body = std::move(mesh),
      .material = {.young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 0.0001, .exponent = 0.216}},
      .contacts =
          {{.side = "top",
            .tool = tool(sphere),
            .motion = [](Real t) { return Vec<Real, dim>(-travel * t * Vec<Real, dim>::Unit(dim - 1)); },
            .friction = {.mu = 0.15},
            .enforcement = penalty,
            .name = "punch"},
           {.side = "bottom", .tool = tool(die), .friction = {.mu = 0.15}, .enforcement = penalty, .name = "die"}},
  }};
}

template <class Model>
void run(Problem<Model>& sheet) {
  auto march = sheet.march({.end = 1, .initial = 0.1 / travel, .largest = 0.5 / travel, .tolerance = 1e-8});
  REQUIRE(march.finish());
}

TEST_CASE("a quarter of a round sheet in space has the forces of the axisymmetric sheet") {
  Problem<Section> section = make_sheet<Section>(mesh::rectangle({.size = {rim, 1}, .cells = {14, 2}}),
                                                 [](const rigid::Profile& p) { return p; });
  section.hold("left", 0).hold("right", 0).hold("right", 1);
  run(section);
  Problem<Quarter> quarter = make_sheet<Quarter>(mesh::extrude(mesh::quarter_disc({.radius = rim, .cells = {7, 7}}),
                                                               {.layers = 2, .low = "bottom", .high = "top"}),
                                                 [](const rigid::Profile& p) {
                                                   return rigid::Revolution(p, {0, 0, 0}, {0, 0, 1});
                                                 });
  quarter.hold("x=0", 0).hold("y=0", 1).hold("rim", 0).hold("rim", 1).hold("rim", 2);
  run(quarter);

  // Elements of 4 mm in a sheet of 1 mm lock as it bends, those of the block otherwise than rings: 28 % too much at
  // 2 mm of travel, 9 % at 4 mm. From 6 mm on, where the sheet bears by its membrane, it is 2.4 % at most; 3 % is the
  // bound here.
  const Real force = section.contact_force("punch")[1];
  const Vec<Real, 3> in_space = quarter.contact_force("punch");
  MESSAGE("section ", force, " N, quarter ", 4 * in_space[2], " N");
  CHECK(force > 5000);
  CHECK(4 * in_space[2] == doctest::Approx(force).epsilon(0.03));
  // The mesh is its own mirror image about the diagonal.
  CHECK(in_space[0] == doctest::Approx(in_space[1]).epsilon(1e-6));

  // Along both straight sides the nodes lie at the radii of the section's nodes, and move as these do.
  std::map<std::pair<Index, Index>, Vec<Real, 2>> expected;
  const auto key = [](Real r, Real z) {
    return std::pair(Index(std::lround(r * 14 / rim)), Index(std::lround(2 * z)));
  };
  for (Index n = 0; n < section.body().mesh().node_count(); ++n) {
    const auto& X = section.body().mesh().nodes[std::size_t(n)];
    expected[key(X[0], X[1])] = section.displacement(n);
  }
  Real largest = 0;
  for (const int along : {0, 1})
    for (const Index n : quarter.body().mesh().side(along == 0 ? "y=0" : "x=0").nodes) {
      const auto& X = quarter.body().mesh().nodes[std::size_t(n)];
      const Vec<Real, 3> u = quarter.displacement(n);
      CHECK(u[1 - along] == 0);
      largest = std::max(largest, (Vec<Real, 2>(u[along], u[2]) - expected.at(key(X[along], X[2]))).norm());
    }
  MESSAGE("largest difference of a displacement ", largest, " mm");
  CHECK(largest < 0.02 * travel);
}

}  // namespace sheet
