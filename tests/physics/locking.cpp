// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>

#include <doctest/doctest.h>

namespace locking {

using namespace scene;

// Cook's membrane in plane strain, nearly incompressible, at a load so small that it is linear. Deflection of the upper
// corner for a load of 100.
template <class Element>
Real deflection(Index cells, Real poisson) {
  auto mesh = mesh::rectangle({.cells = {cells, cells}});
  for (auto& x : mesh.nodes) x = V(48 * x[0], 44 * x[0] + x[1] * (44 * (1 - x[0]) + 16 * x[0]));
  using M = Lone<EigenLdlt, Hencky, PlaneStrain, Element>;
  Problem<M> p({.body = mesh, .material = {.young = 240.565, .poisson = poisson}});
  p.hold("left", 0).hold("left", 1).load("right", 1, [](Real t) { return 0.1 * t; });
  auto march = p.march({.end = 1, .steps = 1, .tolerance = 1e-6});
  CHECK(bool(march.finish()));
  return p.displacement(mesh.side("right").nodes.back())[1] * 1e3;
}
using Mean = MeanDilatation<Quad4>;
using Plain = FullyIntegrated<Quad4>;

TEST_CASE("the compressible Cook's membrane has the tip displacement of other programs") {
  // Linear, plane strain, E = 70, nu = 1/3: 32.20 to 32.28 by CalculiX, Code_Aster and Elmer (CoFEA benchmarks).
  CHECK(deflection<Mean>(32, 1.0 / 3) * 240.565 / 70 == doctest::Approx(32.24).epsilon(0.01));
}

TEST_CASE("in the plane the mean dilatation does not lock where full integration does") {
  const Real reference = deflection<Mean>(32, 0.4999);
  const Real mean4 = deflection<Mean>(4, 0.4999), mean8 = deflection<Mean>(8, 0.4999),
             mean16 = deflection<Mean>(16, 0.4999);
  MESSAGE("Cook's membrane, 4, 8, 16, 32 cells: ", mean4, " ", mean8, " ", mean16, " ", reference);
  CHECK(std::abs(mean16 / reference - 1) < 0.02);
  CHECK(std::abs(mean8 / reference - 1) < 0.06);
  CHECK(std::abs(mean16 - reference) < 0.6 * std::abs(mean8 - reference));
  // The plain element at the same meshes.
  CHECK(deflection<Plain>(8, 0.4999) < 0.5 * reference);
  CHECK(deflection<Plain>(16, 0.4999) < 0.7 * reference);
  // Compressible, both are right.
  CHECK(deflection<Plain>(16, 0.3) == doctest::Approx(deflection<Mean>(16, 0.3)).epsilon(0.02));
}

TEST_CASE("the extrapolated displacement of a step is proportional to its size") {
  // Pressed so little that the path is straight, without variables of its own: where the first step leads, the guesses
  // of all others are right.
  using M = Lone<EigenLdlt, Hencky, PlaneStrain, Plain>;
  Problem<M> p({.body = mesh::rectangle({.cells = {3, 3}}), .material = material<Hencky>()});
  p.hold("bottom", 0).hold("bottom", 1).hold("top", 0).drive("top", 1, [](Real t) { return -1e-7 * t; });
  auto march = p.march({.end = 1, .tolerance = 1e-5, .stops = {0.1, 0.4, 0.45}});
  for (const StepReport& step : march) CHECK((step.iterations > 0) == (step.number == 1));
  CHECK(bool(march.outcome()));
  CHECK(march.report().steps > 5);
}

}  // namespace locking
