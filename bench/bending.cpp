// SPDX-License-Identifier: BSL-1.0
// What an element makes of bending: strips, plates and Cook's membrane on several meshes, mean dilatation beside
// assumed strains. Prints CSV: the value that is compared (tip force of the plastic strip, deflections), iterations,
// and the median wall time of a run.
#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/mesh/extrude.hpp>
#include <stickslip/stickslip.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

using namespace stickslip;

template <class Kinematics_, class Element_, class Material_>
struct Bent : QuasistaticDefaults {
  using Kinematics = Kinematics_;
  using Element = Element_;
  using Material = Material_;
  using Friction = Frictionless;
  using Enforcement = NoContact;
  using LinearSolver = Cholmod;
};

// Runs a problem three times, prints its line.
template <class Make, class Value>
void line(const char* scene, const char* element, Index along, Index across, const MarchOptions& options, Make make,
          Value value) {
  std::array<double, 3> seconds{};
  double result = 0;
  Index iterations = 0, unknowns = 0;
  bool completed = true;
  for (double& s : seconds) {
    auto problem = make();
    const auto begin = std::chrono::steady_clock::now();
    auto march = problem->march(options);
    completed = bool(march.finish()) && completed;
    s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result = value(*problem);
    iterations = march.report().iterations;
    unknowns = problem->unknowns();
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%s,%s,%d,%d,%d,%s,%.8g,%d,%.3g\n", scene, element, along, across, unknowns,
              completed ? "completed" : "ended early", result, iterations, seconds[1]);
}

// A clamped strip of 40 x 1 in plane strain whose end is driven sideways by 10: force of the drive.
template <class Element>
void strip(const char* element, Index along, Index across) {
  using M = Bent<PlaneStrain, Element, FiniteJ2<PowerHardening>>;
  line(
      "plastic strip", element, along, across, {.end = 1, .initial = 0.01, .largest = 0.05},
      [&] {
        auto problem = std::make_unique<Problem<M>>(typename Problem<M>::Parameters{
            .body = mesh::rectangle({.size = {40, 1}, .cells = {along, across}}),
            .material = {
                .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}}});
        problem->hold("left", 0).hold("left", 1).drive("right", 1, [](Real t) { return 10 * t; });
        return problem;
      },
      [](auto& problem) { return problem.reaction("right", 1); });
}

// Cook's membrane, nearly incompressible, at a load so small that it is linear: deflection of its corner for a load of
// 100.
template <class Element>
void cook(const char* element, Index cells) {
  using M = Bent<PlaneStrain, Element, Hencky>;
  line(
      "Cook's membrane", element, cells, cells, {.end = 1, .steps = 1, .tolerance = 1e-6},
      [&] {
        auto mesh = mesh::rectangle({.cells = {cells, cells}});
        for (auto& x : mesh.nodes) x = Vec<Real, 2>(48 * x[0], 44 * x[0] + x[1] * (44 * (1 - x[0]) + 16 * x[0]));
        auto problem = std::make_unique<Problem<M>>(
            typename Problem<M>::Parameters{.body = mesh, .material = {.young = 240.565, .poisson = 0.4999}});
        problem->hold("left", 0).hold("left", 1).load("right", 1, [](Real t) { return 0.1 * t; });
        return problem;
      },
      [](auto& problem) { return 1e3 * problem.displacement(problem.body().mesh().side("right").nodes.back())[1]; });
}

// A quarter of a clamped square plate of 40 x 40 x 1 under a small pressure: deflection of its middle over that of a
// thin plate.
template <class Element>
void plate(const char* element, Index along, Index across) {
  using M = Bent<ThreeDimensional, Element, Hencky>;
  constexpr Real pressure = 1e-5, young = 1e5, poisson = 0.3;
  line(
      "square plate in space", element, along, across, {.end = 1, .steps = 1, .tolerance = 1e-6},
      [&] {
        auto problem = std::make_unique<Problem<M>>(typename Problem<M>::Parameters{
            .body = mesh::extrude(mesh::rectangle({.size = {20, 20}, .cells = {along, along}}),
                                  {.thickness = 1, .layers = across}),
            .material = {.young = young, .poisson = poisson}});
        for (const Index i : {0, 1, 2}) problem->hold("right", i).hold("top", i);
        problem->hold("left", 0).hold("bottom", 1).load("back", 2, [](Real t) { return -pressure * 400 * t; });
        return problem;
      },
      [](auto& problem) {
        const Real bending = young / 12 / (1 - poisson * poisson);
        return -problem.displacement(0)[2] / (0.00126532 * pressure * std::pow(40, 4) / bending);
      });
}

template <template <class> class Element>
void all(const char* name) {
  for (const Index n : {1, 2, 4, 8}) strip<Element<Quad4>>(name, 8 * n, 2 * n);
  for (const Index n : {2, 4, 8, 16, 32}) cook<Element<Quad4>>(name, n);
  for (const auto& [along, across] : {std::pair<Index, Index>{4, 1}, {8, 1}, {8, 2}, {16, 2}})
    plate<Element<Hex8>>(name, along, across);
}

int main() {
  std::puts("scene,element,along,across,unknowns,outcome,value,iterations,seconds");
  all<MeanDilatation>("mean-dilatation");
  all<AssumedStrain>("assumed-strain");
  // The references.
  strip<AssumedStrain<Quad4>>("reference", 160, 8);
  cook<AssumedStrain<Quad4>>("reference", 96);
  plate<AssumedStrain<Hex8>>("reference", 32, 3);
}
