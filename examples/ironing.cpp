// SPDX-License-Identifier: BSL-1.0
//
// Ironing: a rigid cylinder is pressed into a block of aluminium and drawn along it, in three dimensions.
//
// The block is narrower than the cylinder, so what is pushed aside bulges out at its flanks, and a wave of metal runs
// before the tool. Friction has two components: along the way, and across, where the metal flows to the sides.
//
//        z |   .---.                      The plane of symmetry, y = 0; y points away from the viewer, and so does the
//          |  (  +  ) -> after the press   axis of the cylinder. Half of the block, 0 < y < 3, is meshed; it stands on
//          |___'-_-'_________________      its base, z = 0.
//    block |                         |
//          |                         |     Lengths in mm, stresses in MPa; forces are those of the whole block.
//          +-------------------------+- x

#include "common/benchmark.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/stickslip.hpp>

using namespace stickslip;

struct Ironing : QuasistaticDefaults {
  using Kinematics = ThreeDimensional;
  using Element = MeanDilatation<Hex8>;
  using Material = FiniteJ2<LinearHardening>;
  using Tool = rigid::Revolution;
};

template <class Model>
int iron(const examples::Options& options) {
  const Real depth = options.parameters.at("depth"), way = options.parameters.at("way");
  constexpr Real length = 20, half_width = 3, height = 4, radius = 3, start = 5;
  // The cylinder goes down in the first part of the time and along in the second, at one speed.
  const Real along = way / (way + depth);
  const auto path = [=](Real t) {
    const Real gone = t * (way + depth);
    return Vec<Real, 3>(std::max(0.0, gone - depth), 0, -std::min(gone, depth));
  };
  Contact<Model> roller{.side = "front",  // the upper face, z = height
                        .tool = rigid::cylinder({start, 0, height + radius}, {0, 1, 0}, radius),
                        .motion = path,
                        .enforcement = {.normal = 5, .tangential = 0.5, .per = PenaltyPer::stiffness},
                        .name = "cylinder"};
  if constexpr (has_friction<Model>) roller.friction = {.mu = options.mu};
  const Index n = options.refine;
  Problem<Model> block{{
      .body = mesh::box({.size = {length, half_width, height}, .cells = {40 * n, 4 * n, 6 * n}}),
      .material = {.young = 68956, .poisson = 0.32, .hardening = {.yield = 31, .modulus = 261.2}},
      .contacts = {roller},
  }};
  block.hold("bottom", 1);                                                // y = 0, the plane of symmetry
  for (const Index component : {0, 1, 2}) block.hold("back", component);  // z = 0, on its base

  const MarchOptions march{
      .end = 1, .initial = 0.02 * (1 - along), .largest = 0.15 / (way + depth), .stops = {1 - along}};
  return examples::run<Model>(options, block,
                              {.labels = {.name = "ironing",
                                          .kinematics = "three-dimensional",
                                          .material = "finite J2, linear hardening",
                                          .travel = "way of the cylinder",
                                          .force = "force against the way",
                                          .view = "set xrange [-1:21]\nset yrange [-1:8]"},
                               .march = march,
                               .travel_mm = [&] { return block.time() * (way + depth); },
                               .force_N = [&] { return -2 * block.contact_force("cylinder")[0]; },
                               .reach_mm = 10,
                               .section = "bottom"});
}

// Those for a solid of medium size.
struct Offered {
  static const run_time::SolverList& solvers() {
    static const run_time::SolverList some =
        examples::AllSolvers::solvers().only({"mumps", "banded", "cholmod", "corrected-cholmod", "corrected-banded"});
    return some;
  }
};

int main(int argc, char** argv) {
  using run_time::Named;
  constexpr run_time::Choices frictions{Named<Coulomb>{"coulomb"}, Named<QuasiCoulomb>{"quasi-coulomb"}};
  const examples::Program program{
      .name = "ironing",
      .title = "a cylinder pressed into a block and drawn along it, in three dimensions",
      .frictions = frictions.list(),
      .solvers = Offered::solvers().names(),
      .mu = 0.2,
      .parameters = {
          {.name = "depth", .about = "of the press in mm", .value = 0.5, .low = 0.01, .high = 2},
          {.name = "way", .about = "of the cylinder along the block in mm", .value = 8, .low = 0, .high = 10}}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    if (options->list) return examples::print_list<Ironing, Offered>(frictions);
    return examples::dispatch<Ironing, Offered>(*options, frictions,
                                                [&]<class Model>() { return iron<Model>(*options); });
  });
}
