// SPDX-License-Identifier: BSL-1.0
// A benchmark program that says on standard error after which times it has converged, and whose tool can be lost: for
// the tests of what a killed run and a failed one leave behind. Its march has books, an output, inertia and a tool that
// some steps are cut for.
#include "common/benchmark.hpp"

#include <stickslip/stickslip.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>

#include <cstdio>
#include <limits>

using namespace stickslip;

struct Press : QuasistaticDefaults {
  using Material = FiniteJ2<LinearHardening>;
  using Friction = ExtrapolatedCoulomb;
  using TimeIntegration = GeneralizedAlpha;
  using LinearSolver = EigenLdlt;
};

int main(int argc, char** argv) {
  const examples::Program program{
      .name = "pressed_block",
      .title = "a block that is pressed and dragged",
      .frictions = {"extrapolated-quasi-coulomb"},
      .solvers = {"eigen-ldlt"},
      .mu = 0.2,
      .parameters = {
          {.name = "lost-after", .about = "the time from which on the tool is nowhere", .value = 1, .high = 1},
          {.name = "radius", .about = "of the tool", .value = 3, .low = 0.01, .high = 10}}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    const double radius = options->parameters.at("radius");
    const auto motion = [last = options->parameters.at("lost-after")](Real t) {
      if (t > last) return Vec<Real, 2>(0, std::numeric_limits<Real>::quiet_NaN());
      return Vec<Real, 2>(std::max(0.0, t - 0.3), -0.3 * std::min(t, 0.3));
    };
    Problem<Press> block{
        {.body =
             mesh::rectangle({.origin = {1, 0}, .size = {3, 1}, .cells = {18 * options->refine, 6 * options->refine}}),
         .material = {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 50}},
         .density = 0.1,
         .contacts = {{.side = "top",
                       .tool = rigid::disc({2, 1.02 + radius}, radius),
                       .motion = motion,
                       .friction = {.mu = options->mu},
                       .enforcement = {.normal = 20, .tangential = 2, .per = PenaltyPer::stiffness}}}}};
    block.hold("bottom", 0).hold("bottom", 1);
    return examples::run<Press, examples::Books::kept>(
        *options, block,
        {.labels = {.name = "pressed_block",
                    .kinematics = "plane strain",
                    .material = "finite J2, linear hardening",
                    .travel = "travel",
                    .force = "force",
                    .view = ""},
         .march = {.end = 1, .initial = 0.002, .largest = 0.004, .stops = {0.3}},
         .travel_mm =
             [&] {
               std::fprintf(stderr, "%.17g\n", block.time());
               return block.time();
             },
         .force_N = [&] { return block.contact_force("top")[1]; },
         .reach_mm = 2});
  });
}
