// SPDX-License-Identifier: BSL-1.0
// Deflections of thin bodies with one or two elements across, over those of beam and plate theory: AssumedStrain bends,
// MeanDilatation does not, and where its edges are not parallel neither does.
#include "scene.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/mesh/extrude.hpp>

#include <doctest/doctest.h>

namespace bending {

using namespace scene;
using Bends = AssumedStrain<Quad4>;
using Mean = MeanDilatation<Quad4>;
using BendsInSpace = AssumedStrain<Hex8>;
using MeanInSpace = MeanDilatation<Hex8>;
constexpr Real nearly = 0.4999;  // incompressible

constexpr Real young = 1e5;
Real shear_modulus(Real poisson) {
  return young / 2 / (1 + poisson);
}
Real plate_stiffness(Real poisson) {  // of unit thickness
  return young / 12 / (1 - poisson * poisson);
}

// Displacements under a load so small that they are linear.
template <class Element, class Kinematics, class Hold>
Field loaded(const Mesh<Element::dim, Element::nodes>& mesh, const Hencky& material, const char* side, int component,
             Real load, Hold hold) {
  Problem<Lone<EigenLdlt, Hencky, Kinematics, Element>> p({.body = mesh, .material = material});
  hold(p);
  p.load(side, component, [load](Real t) { return load * t; });
  auto march = p.march({.end = 1, .steps = 1, .tolerance = 1e-7});
  const Outcome outcome = march.finish();
  CHECK_MESSAGE(outcome, outcome.message());
  return p.displacement();
}

// A strip of 40 x 1, one end clamped, a force across the other; the edges between cells tilted in turns. Length over
// thickness is 40, so that shear adds a thousandth to the deflection, and the wedge of clamping less.
template <class Element>
Real strip(std::array<Index, 2> cells, Real poisson, Real slope = 0) {
  auto mesh = mesh::rectangle({.size = {40, 1}, .cells = cells});
  for (auto& x : mesh.nodes) {
    const long column = std::lround(x[0] / 40 * Real(cells[0]));
    if (column > 0 && column < cells[0]) x[0] += (column % 2 == 1 ? slope : -slope) * (x[1] - 0.5);
  }
  const Real load = 1e-4;
  const Field u = loaded<Element, PlaneStrain>(mesh, {.young = young, .poisson = poisson}, "right", 1, load,
                                               [](auto& p) { p.hold("left", 0).hold("left", 1); });
  const Real theory = load * (40 * 40 * 40 / 3. / plate_stiffness(poisson) + 40 / (5. / 6 * shear_modulus(poisson)));
  return u[2 * mesh.side("right").nodes.back() + 1] / theory;
}

TEST_CASE("a strip of cells five times as long as thick deflects as a beam does") {
  for (const Real poisson : {0.3, nearly}) {
    CAPTURE(poisson);
    CHECK(std::abs(strip<Bends>({8, 1}, poisson) - 0.996) < 0.002);
    CHECK(std::abs(strip<Bends>({16, 2}, poisson) - (poisson == nearly ? 0.953 : 0.991)) < 0.002);
    CHECK(std::abs(strip<Bends>({64, 4}, poisson) - (poisson == nearly ? 0.986 : 0.9975)) < 0.002);
  }
  CHECK(std::abs(strip<Mean>({8, 1}, 0.3) - 0.1085) < 0.002);
  CHECK(std::abs(strip<Mean>({16, 2}, 0.3) - 0.327) < 0.002);
  CHECK(std::abs(strip<Mean>({8, 1}, nearly) - 0.152) < 0.002);
}

TEST_CASE("a strip of trapezoids does not bend: tilted by 17 degrees 0.42, by 45 degrees 0.09 of the deflection") {
  const Real tilt = std::tan(17 * pi / 180);
  CHECK(std::abs(strip<Bends>({16, 2}, 0.3, tilt) - 0.423) < 0.002);
  CHECK(std::abs(strip<Bends>({16, 2}, 0.3, 1) - 0.087) < 0.002);
  CHECK(std::abs(strip<Bends>({16, 2}, nearly, tilt) - 0.398) < 0.002);
  CHECK(std::abs(strip<Bends>({16, 2}, nearly, 1) - 0.077) < 0.002);
  CHECK(std::abs(strip<Mean>({16, 2}, 0.3, tilt) - 0.230) < 0.002);
  CHECK(std::abs(strip<Mean>({16, 2}, 0.3, 1) - 0.072) < 0.002);
}

TEST_CASE("a strip of parallelograms bends nearly as one of rectangles") {
  // All edges leant to one side by 17 degrees, the ends as well: 2.4 % are lost.
  const auto leant = [](auto tag) {
    using Element = typename decltype(tag)::type;
    auto mesh = mesh::rectangle({.size = {40, 1}, .cells = {16, 2}});
    for (auto& x : mesh.nodes) x[0] += std::tan(17 * pi / 180) * (x[1] - 0.5);
    const Real load = 1e-4;
    const Field u = loaded<Element, PlaneStrain>(mesh, {.young = young, .poisson = 0.3}, "right", 1, load,
                                                 [](auto& p) { p.hold("left", 0).hold("left", 1); });
    return u[2 * mesh.side("right").nodes.back() + 1] / (load * 40 * 40 * 40 / 3 / plate_stiffness(0.3));
  };
  CHECK(std::abs(leant(std::type_identity<Bends>{}) - 0.967) < 0.002);
  CHECK(leant(std::type_identity<Mean>{}) < 0.35);
}

// A round plate of radius 20 and thickness 1, its rim clamped, under uniform pressure: deflection of the middle.
template <class Element>
Real round_plate(std::array<Index, 2> cells, Real poisson) {
  const auto mesh = mesh::rectangle({.size = {20, 1}, .cells = cells});
  const Real pressure = 1e-5, R = 20;
  const Field u =
      loaded<Element, Axisymmetric>(mesh, {.young = young, .poisson = poisson}, "top", 1, -pressure * pi * R * R,
                                    [](auto& p) { p.hold("right", 0).hold("right", 1).hold("left", 0); });
  const Real theory =
      pressure * R * R * (R * R / 64 / plate_stiffness(poisson) + 1 / (4 * 5. / 6 * shear_modulus(poisson)));
  return -u[2 * mesh.side("left").nodes.front() + 1] / theory;
}

TEST_CASE("a clamped round plate deflects as plate theory with shear says") {
  const Real fine = round_plate<Bends>({64, 8}, 0.3);
  CHECK(std::abs(fine - 0.995) < 0.002);
  CHECK(std::abs(round_plate<Mean>({128, 16}, 0.3) - fine) < 0.003);
  // One element across errs by 1.5 % of the fine mesh's, two by 0.5 %.
  CHECK(std::abs(round_plate<Bends>({8, 1}, 0.3) - 1.010) < 0.002);
  CHECK(std::abs(round_plate<Bends>({8, 2}, 0.3) - 0.991) < 0.002);
  CHECK(std::abs(round_plate<Bends>({16, 2}, 0.3) - 0.992) < 0.002);
  CHECK(std::abs(round_plate<Bends>({8, 1}, nearly) - 1.010) < 0.002);
  CHECK(std::abs(round_plate<Bends>({8, 2}, nearly) - 0.891) < 0.002);
  CHECK(std::abs(round_plate<Bends>({16, 2}, nearly) - 0.940) < 0.002);
  CHECK(std::abs(round_plate<Bends>({64, 8}, nearly) - 0.977) < 0.002);
  CHECK(std::abs(round_plate<Mean>({8, 1}, 0.3) - 0.616) < 0.002);
  CHECK(std::abs(round_plate<Mean>({8, 2}, 0.3) - 0.489) < 0.002);
  CHECK(std::abs(round_plate<Mean>({16, 2}, 0.3) - 0.84) < 0.01);
}

// Cook's membrane in plane strain: deflection of the upper corner for a load of 100 and a Young's modulus of 240.565.
template <class Element>
Real cook(Index n, Real poisson) {
  auto mesh = mesh::rectangle({.cells = {n, n}});
  for (auto& x : mesh.nodes) x = V(48 * x[0], 44 * x[0] + x[1] * (44 * (1 - x[0]) + 16 * x[0]));
  const Field u = loaded<Element, PlaneStrain>(mesh, {.young = 240.565, .poisson = poisson}, "right", 1, 0.1,
                                               [](auto& p) { p.hold("left", 0).hold("left", 1); });
  return u[2 * mesh.side("right").nodes.back() + 1] * 1e3;
}

TEST_CASE("Cook's membrane of few cells that bend is nearer to that of many") {
  CHECK(std::abs(cook<Bends>(2, nearly) / 6.153 - 1) < 0.002);
  CHECK(std::abs(cook<Bends>(4, nearly) / 7.139 - 1) < 0.002);
  CHECK(std::abs(cook<Bends>(8, nearly) / 7.649 - 1) < 0.002);
  CHECK(std::abs(cook<Bends>(32, nearly) / 7.99 - 1) < 0.005);
  CHECK(std::abs(cook<Mean>(2, nearly) / 4.937 - 1) < 0.002);
  CHECK(std::abs(cook<Mean>(4, nearly) / 6.801 - 1) < 0.002);
  CHECK(std::abs(cook<Bends>(2, 0.3) / 7.410 - 1) < 0.002);
  CHECK(std::abs(cook<Bends>(8, 0.3) / 9.224 - 1) < 0.002);
  CHECK(std::abs(cook<Mean>(2, 0.3) / 5.682 - 1) < 0.002);
}

// A square plate of 40 x 40 x 1, all edges clamped, under uniform pressure, a quarter of it: deflection of the middle
// over that of a thin plate.
template <class Element>
Real square_plate(Index n, Index layers, Real poisson) {
  const auto mesh =
      mesh::extrude(mesh::rectangle({.size = {20, 20}, .cells = {n, n}}), {.thickness = 1, .layers = layers});
  const Real pressure = 1e-5;
  const Field u = loaded<Element, ThreeDimensional>(mesh, {.young = young, .poisson = poisson}, "back", 2,
                                                    -pressure * 20 * 20, [](auto& p) {
                                                      for (int i = 0; i < 3; ++i) p.hold("right", i).hold("top", i);
                                                      p.hold("left", 0).hold("bottom", 1);
                                                    });
  return -u[2] / (0.00126532 * pressure * std::pow(40, 4) / plate_stiffness(poisson));
}

TEST_CASE("a clamped square plate of hexahedra deflects as plate theory says") {
  CHECK(std::abs(square_plate<BendsInSpace>(4, 1, 0.3) - 1.009) < 0.002);
  CHECK(std::abs(square_plate<BendsInSpace>(8, 1, 0.3) - 1.010) < 0.002);
  CHECK(std::abs(square_plate<BendsInSpace>(8, 2, 0.3) - 0.991) < 0.002);
  CHECK(std::abs(square_plate<BendsInSpace>(4, 1, nearly) - 1.015) < 0.002);
  CHECK(std::abs(square_plate<BendsInSpace>(8, 1, nearly) - 1.015) < 0.002);
  CHECK(std::abs(square_plate<BendsInSpace>(8, 2, nearly) - 0.894) < 0.002);
  CHECK(std::abs(square_plate<MeanInSpace>(4, 1, 0.3) - 0.146) < 0.002);
  CHECK(std::abs(square_plate<MeanInSpace>(8, 2, 0.3) - 0.400) < 0.002);
}

// A beam of 40 x 1 x 1, one end clamped, a force across the other.
template <class Element>
Real beam(Index n, Index across, Real poisson) {
  const auto mesh =
      mesh::extrude(mesh::rectangle({.size = {40, 1}, .cells = {n, across}}), {.thickness = 1, .layers = across});
  const Real load = 1e-4;
  const Field u =
      loaded<Element, ThreeDimensional>(mesh, {.young = young, .poisson = poisson}, "right", 1, load, [](auto& p) {
        for (int i = 0; i < 3; ++i) p.hold("left", i);
      });
  const Real theory = load * (40 * 40 * 40 / 3. / (young / 12) + 40 / (5. / 6 * shear_modulus(poisson)));
  return u[3 * mesh.side("right").nodes.back() + 1] / theory;
}

TEST_CASE("a beam of hexahedra deflects as beam theory says") {
  CHECK(std::abs(beam<BendsInSpace>(8, 1, 0.3) - 0.989) < 0.002);
  CHECK(std::abs(beam<BendsInSpace>(16, 2, 0.3) - 0.988) < 0.002);
  CHECK(std::abs(beam<BendsInSpace>(8, 1, nearly) - 0.978) < 0.002);
  CHECK(std::abs(beam<BendsInSpace>(16, 2, nearly) - 0.952) < 0.002);
  CHECK(std::abs(beam<MeanInSpace>(8, 1, 0.3) - 0.099) < 0.002);
}

}  // namespace bending
