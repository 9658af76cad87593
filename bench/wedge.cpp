// SPDX-License-Identifier: BSL-1.0
// Up a wedge: every law of friction, at every strength of feedback (theory.md, section 5.4), against the exact ratio of
// the forces. Prints CSV.
#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/stickslip.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

using namespace stickslip;

constexpr Real slope = 0.115, force = 100;

template <class Friction_, class Solver>
struct Block : QuasistaticDefaults {
  using Friction = Friction_;
  using LinearSolver = Solver;
};

// The force is brought up while the block, whose front edge stands on the wedge, is held at its height. Then it rises.
template <class Friction, class Solver>
void climb(const char* name, Real mu, Index steps) {
  using M = Block<Friction, Solver>;
  Problem<M> block{{.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}),
                    .material = {.young = 2e5, .poisson = 0.3},
                    .contacts = {{.side = "bottom",
                                  .tool = rigid::line({0, 0}, {1, slope}),
                                  .motion = [](Real) { return Vec<Real, 2>(4, 0); },
                                  .friction = {.mu = mu},
                                  .enforcement = {.normal = 1e5, .tangential = 1e4, .per = PenaltyPer::area},
                                  .name = "wedge"}}}};
  block.drive("top", 1, [](Real t) { return 0.5 * std::max(0.0, t - 1); });
  block.load("left", 0, [](Real t) { return force * std::min(1.0, t); });
  MarchOptions options;
  options.end = 2;
  options.steps = steps;
  options.tolerance = 1e-8;
  options.outer_tolerance = 1e-6;
  options.max_outer = 60;
  const auto begin = std::chrono::steady_clock::now();
  auto march = block.march(options);
  Real lag = 0;
  for (const StepReport& step : march) lag = step.lag;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const Real exact = (slope + mu) / (1 - mu * slope);
  const bool completed = bool(march.outcome());
  std::printf("\"%s\",%g,%.2f,%d,\"%s\",", name, mu, mu / slope, steps,
              completed ? "completed" : describe(march.outcome().failure.cause));
  if (completed)
    std::printf("%.3g,%.3g", std::abs(force / -block.reaction("top", 1) / exact - 1), lag);
  else
    std::printf(",");
  std::printf(",%d,%d,%.2g\n", march.report().iterations, march.report().outer_iterations, seconds);
}

int main() {
  std::puts("law,mu,kappa,steps,outcome,error,lag,iterations,passes,seconds");
  for (const Real mu : {0.03, 0.1, 0.2, 0.5})
    for (const Index steps : {40, 160, 640}) {
      climb<Coulomb, Banded>("coulomb, banded", mu, steps);
      climb<Coulomb, Corrected<BandedCholesky>>("coulomb, corrected-banded", mu, steps);
      climb<QuasiCoulomb, Banded>("quasi-coulomb, banded", mu, steps);
      climb<ExtrapolatedCoulomb, Banded>("extrapolated-quasi-coulomb, banded", mu, steps);
      climb<WithPressure<Coulomb, LagIterated>, Banded>("lag-iterated-coulomb, banded", mu, steps);
      climb<WithPressure<Coulomb, Symmetrised>, Banded>("symmetrised-coulomb, banded", mu, steps);
    }
}
