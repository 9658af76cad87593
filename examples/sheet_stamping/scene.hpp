// SPDX-License-Identifier: BSL-1.0
// The scene of sheet_stamping.cpp, for any law of friction and solver.
#pragma once

#include "common/benchmark.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/mesh/extrude.hpp>
#include <stickslip/mesh/quarter_disc.hpp>
#include <stickslip/stickslip.hpp>

// What the sheet is made of, decided at compile time.
template <class Friction_, class Solver, class Element_ = stickslip::MeanDilatation<stickslip::Hex8>>
struct Stamping : stickslip::QuasistaticDefaults {
  using Kinematics = stickslip::ThreeDimensional;
  using Element = Element_;
  using Material = stickslip::FiniteJ2<stickslip::PowerHardening>;
  using Friction = Friction_;
  using LinearSolver = Solver;
  using Tool = stickslip::rigid::Revolution;
};

// All solvers; the first is the default.
struct SheetSolvers {
  static const stickslip::run_time::SolverList& solvers() {
    static const stickslip::run_time::SolverList all = examples::AllSolvers::solvers().only(
        {"mumps", "cholmod", "umfpack", "banded", "eigen-ldlt", "eigen-lu", "conjugate-gradients", "bicgstab",
         "corrected-cholmod", "corrected-banded", "corrected-eigen-ldlt"});
    return all;
  }
};
template <class Friction, stickslip::run_time::Takes matrix, class Element = stickslip::MeanDilatation<stickslip::Hex8>>
using SolvedStamping = Stamping<Friction, stickslip::run_time::SolverByName<SheetSolvers, matrix>, Element>;

template <class Model>
int stamp(const examples::Options& options) {
  using namespace stickslip;
  constexpr Real punch_radius = 50.8, die_fillet = 6.35, rim = 59.18, thickness = 1.0;
  // The penalties of osu_punch, 1e5 and 1e4 N/mm for each of 15 nodes and a radian, spread over the sheet. By area they
  // do not depend on the mesh.
  constexpr Real per_area = 15 / (0.5 * rim * rim);
  const Penalty penalty{.normal = 1e5 * per_area, .tangential = 1e4 * per_area, .per = PenaltyPer::area};

  // The profiles of osu_punch, turned about the axis of z.
  const Vec<Real, 3> origin(0, 0, 0), axis(0, 0, 1);
  const rigid::Revolution sphere(rigid::path({punch_radius, thickness + punch_radius}, {0, -1}).right(punch_radius, pi),
                                 origin, axis);
  const rigid::Revolution die(
      rigid::path({rim - die_fillet, -100}, {0, 1}).straight(100 - die_fillet).right(die_fillet, pi / 2).straight(40),
      origin, axis);
  const Real travel = options.parameters.at("travel");
  const auto downwards = [travel](Real t) { return Vec<Real, 3>(0, 0, -travel * t); };

  Contact<Model> on_punch{.side = "top", .tool = sphere, .motion = downwards, .enforcement = penalty, .name = "punch"};
  Contact<Model> on_die{.side = "bottom", .tool = die, .enforcement = penalty, .name = "die"};
  if constexpr (has_friction<Model>) on_punch.friction = on_die.friction = {.mu = options.mu};

  const Index n = 7 * options.refine;
  Problem<Model> sheet{{
      .body = mesh::extrude(mesh::quarter_disc({.radius = rim, .cells = {n, n}}),
                            {.thickness = thickness, .layers = 2 * options.refine, .low = "bottom", .high = "top"}),
      .material = {.young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 0.0001, .exponent = 0.216}},
      .contacts = {on_punch, on_die},
  }};
  sheet.hold("x=0", 0).hold("y=0", 1);
  for (const Index component : {0, 1, 2}) sheet.hold("rim", component);

  const MarchOptions march{
      .end = 1, .initial = 0.1 / travel, .largest = 0.8 / travel, .stops = {10 / travel, 20 / travel, 30 / travel}};
  return examples::run<Model>(options, sheet,
                              {.labels = {.name = "sheet_stamping",
                                          .kinematics = "three-dimensional",
                                          .material = "finite J2, power hardening",
                                          .travel = "punch travel",
                                          .force = "punch force",
                                          .view = "set xrange [0:75]\nset yrange [-50:20]"},
                               .march = march,
                               .travel_mm = [&] { return travel * sheet.time(); },
                               .force_N = [&] { return 4 * sheet.contact_force("punch")[2]; },
                               .reach_mm = 60,
                               .section = "y=0"});
}
