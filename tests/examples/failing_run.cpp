// SPDX-License-Identifier: BSL-1.0
// A benchmark program whose tool is lost half-way: for the test of what a failed run leaves behind.
#include "common/benchmark.hpp"

#include <stickslip/stickslip.hpp>

#include <limits>

using namespace stickslip;

struct Press : QuasistaticDefaults {
  using Friction = QuasiCoulomb;
  using LinearSolver = EigenLdlt;
};

int main(int argc, char** argv) {
  const examples::Program program{.name = "failing_run",
                                  .title = "a block whose press is lost half-way",
                                  .frictions = {"quasi-coulomb"},
                                  .solvers = {"eigen-ldlt"}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    const auto lost = [](Real t) {
      return Vec<Real, 2>(0, t > 0.5 ? std::numeric_limits<Real>::quiet_NaN() : -0.1 * t);
    };
    Problem<Press> block{{.body = mesh::rectangle({.cells = {2, 2}}),
                          .material = {.young = 1000, .poisson = 0.3},
                          .contacts = {{.side = "top",
                                        .tool = rigid::line({0, 1}, {-1, 0}),
                                        .motion = lost,
                                        .friction = {.mu = 0.1},
                                        .enforcement = {.normal = 1e5, .tangential = 1e5}}}}};
    block.hold("bottom", 0).hold("bottom", 1);
    return examples::run<Press>(*options, block,
                                {.labels = {.name = "failing_run",
                                            .kinematics = "plane strain",
                                            .material = "Hencky",
                                            .travel = "travel",
                                            .force = "force",
                                            .view = ""},
                                 .march = {.end = 1, .initial = 0.1, .smallest = 1e-4},
                                 .travel_mm = [](const auto& p) { return 0.1 * p.time(); },
                                 .force_N = [](const auto& p) { return p.contact_force("top")[1]; },
                                 .reach_mm = 2});
  });
}
