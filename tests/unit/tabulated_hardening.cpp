// SPDX-License-Identifier: BSL-1.0
#include <stickslip/io/flow_points.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/tabulated_hardening.hpp>
#include <stickslip/verify/material.hpp>

#include "hardening_check.hpp"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

namespace {

using namespace stickslip;

const std::vector<FlowPoint> points{{0, 100}, {0.01, 140}, {0.05, 190}, {0.2, 230}, {0.5, 231}, {1, 260}};
const TabulatedHardening flat(points), straight(points, BeyondTable::linear);

TEST_CASE("slope, dual derivative and work of a table agree with its flow stress") {
  const std::vector<Real> strains{1e-3, 0.02, 0.13, 0.3, 0.9};
  hardening_check::calculus(flat, strains);
  hardening_check::calculus(flat, {0.45, 1.5, 3});
  hardening_check::calculus(straight, {0.9, 1.5, 3});
}
TEST_CASE("a table is interpolated through its points with a continuous slope") {
  for (const FlowPoint& point : points) {
    CHECK(flat.flow(point.strain).value == doctest::Approx(point.stress).epsilon(1e-15));
    if (point.strain > 0 && point.strain < 1)
      CHECK(flat.flow(point.strain * (1 - 1e-10)).slope ==
            doctest::Approx(flat.flow(point.strain * (1 + 1e-10)).slope).epsilon(1e-6));
  }
}
TEST_CASE("a rising table is interpolated without an extremum, also beside a plateau") {
  const TabulatedHardening steps({{0, 100}, {0.1, 100}, {0.11, 300}, {0.12, 301}, {0.4, 301}, {0.5, 400}});
  for (const auto& law : {flat, steps}) {
    Real before = law.flow(0.0).value;
    for (int k = 1; k <= 10000; ++k) {
      const auto now = law.flow(k * 1e-4);
      CHECK(now.value >= before * (1 - 1e-15));
      CHECK(now.slope >= -1e-9);
      before = now.value;
    }
  }
  CHECK(steps.flow(0.05).value == doctest::Approx(100).epsilon(1e-14));
}
TEST_CASE("beyond its last point a table is constant or continues straight") {
  CHECK(flat.flow(1.0).value == 260);
  CHECK(flat.flow(5.0).value == 260);
  CHECK(flat.flow(5.0).slope == 0);
  CHECK(straight.flow(5.0).value == doctest::Approx(260 + 4 * 58).epsilon(1e-13));  // (260 - 231) / 0.5
  CHECK(straight.flow(5.0).slope == doctest::Approx(58).epsilon(1e-13));
}
TEST_CASE("a dense table of a smooth law gives the law's stress and work") {
  const auto smooth = [](Real p) { return 250 - 150 * std::exp(-8 * p); };
  std::vector<FlowPoint> table;
  for (int k = 0; k <= 200; ++k) table.push_back({k * 0.005, smooth(k * 0.005)});
  const TabulatedHardening law(table);
  for (Real p = 0.0123; p < 1; p += 0.0717) CHECK(law.flow(p).value == doctest::Approx(smooth(p)).epsilon(1e-5));
  CHECK(law.work(1) == doctest::Approx(250 - 150. / 8 * (1 - std::exp(-8.0))).epsilon(1e-5));
}
TEST_CASE("plastic flow along a table has an exact tangent and history") {
  const FiniteJ2<TabulatedHardening> metal{.young = 70e3, .poisson = 0.33, .hardening = flat};
  CHECK_NOTHROW(metal.validate());
  Tensor<Real, Planar> F;
  verify::DeformationPath<Planar> path;
  F.v << 1.05, 0.1, 0, 1, 1;
  path.push_back(F);
  F.v << 1.2, 0.3, -0.1, 0.9, 1.1;
  path.push_back(F);
  for (const auto& p : {path, {path[0]}, {path[1]}}) {
    const auto r = verify::material_tangent(metal, p);
    CHECK(r.by_duals < 1e-10);
    CHECK(r.by_differences < 1e-8);
    CHECK(r.asymmetry < 1e-13);
    CHECK(verify::material_memory(metal, p) < 1e-11);
  }
}
TEST_CASE("a table read from a file hardens as its points") {
  std::istringstream in("strain, stress\n0, 100\n0.01, 140\n0.05, 190\n0.2, 230\n");
  const FiniteJ2<TabulatedHardening> metal{
      .young = 70e3, .poisson = 0.33, .hardening = io::read_flow_points(in, "steel.csv")};
  CHECK_NOTHROW(metal.validate());
  CHECK(metal.hardening.flow(0.05).value == doctest::Approx(190).epsilon(1e-14));
}
TEST_CASE("a wrong table is refused in one sentence") {
  const auto refuses = [](const std::vector<FlowPoint>& table, const char* sentence) {
    CHECK_THROWS_WITH_AS(TabulatedHardening{table}, sentence, std::invalid_argument);
  };
  refuses({{0, 1}, {1, 2}, {2, 3}}, "tabulated hardening: the table needs at least four points");
  refuses({{0.1, 1}, {1, 2}, {2, 3}, {3, 4}}, "tabulated hardening: the first point must lie at zero plastic strain");
  refuses({{0, 1}, {1, 2}, {1, 3}, {3, 4}}, "tabulated hardening: the plastic strains must ascend, see point 3");
  refuses({{0, 1}, {1, 2}, {NAN, 3}, {3, 4}}, "tabulated hardening: the plastic strains must ascend, see point 3");
  refuses({{0, 1}, {1, 0}, {2, 3}, {3, 4}}, "tabulated hardening: the flow stresses must be positive, see point 2");
  // Slopes that no number can hold.
  refuses({{0, 1}, {1e-320, 2}, {2, 3}, {3, 4}},
          "tabulated hardening: plastic strains beyond 1e30 or steps of them below 1e-30 cannot be computed with, see "
          "point 2");
  // A material whose table was left out says so before any work.
  CHECK_THROWS_WITH_AS((FiniteJ2<TabulatedHardening>{.young = 1, .poisson = 0.3}.validate()),
                       "tabulated hardening: the table needs at least four points", std::invalid_argument);
}

}  // namespace
