// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_direct.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>

#include <doctest/doctest.h>

namespace cross_plasticity {

using namespace scene;

// The hemispherical punch of examples/osu_punch.cpp: its force and the largest plastic strain, every 10 mm.
template <class Material>
std::vector<std::array<Real, 2>> punch() {
  using M = Model<EigenDirect, QuasiCoulomb, Material, Axisymmetric>;
  const Real travel = 40;
  const Penalty penalty{.normal = 1e5, .tangential = 1e4};
  Problem<M> sheet(
      {.body = mesh::rectangle({.size = {59.18, 1}, .cells = {14, 2}}),
       .material = material<Material>(),
       .contacts = {{.side = "top",
                     .tool = rigid::path({50.8, 51.8}, {0, -1}).right(50.8, pi),
                     .motion = [&](Real t) { return V(0, -travel * t); },
                     .friction = {.mu = 0.15},
                     .enforcement = penalty},
                    {.side = "bottom",
                     .tool = rigid::path({52.83, -100}, {0, 1}).straight(93.65).right(6.35, pi / 2).straight(40),
                     .friction = {.mu = 0.15},
                     .enforcement = penalty}}});
  sheet.hold("left", 0).hold("right", 0).hold("right", 1);
  auto march = sheet.march({.end = 1, .initial = 0.1 / travel, .largest = 0.8 / travel, .stops = {0.25, 0.5, 0.75}});
  std::vector<std::array<Real, 2>> marks;
  for (const StepReport& step : march)
    if (step.time == 0.25 * double(marks.size() + 1))
      marks.push_back({sheet.contact_force("top")[1], sheet.max_plastic_strain()});
  REQUIRE_MESSAGE(march.outcome(), march.outcome().message());
  return marks;
}
TEST_CASE("the two plasticity models agree within 0.5 % on the punch") {
  const auto finite = punch<FiniteJ2<PowerHardening>>(), rate = punch<HypoelasticJ2<PowerHardening>>();
  REQUIRE(finite.size() == 4);
  REQUIRE(rate.size() == 4);
  CHECK(finite.back()[1] > 0.3);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      const Real difference = rate[k][i] / finite[k][i] - 1;
      CHECK(std::abs(difference) < 0.005);
      MESSAGE("after ", 10 * (k + 1), " mm, ", std::string(i == 0 ? "force " : "plastic strain "), finite[k][i],
              ", difference ", difference);
    }
}

}  // namespace cross_plasticity
