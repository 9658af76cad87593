// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// Report of a run and properties of its model: the input of `advise`.
struct RunSummary {
  enum class Bound { none, current, lagged, extrapolated };
  RunReport report{};
  Bound bound = Bound::none;               ///< pressure in the slip bound
  Symmetry storage = Symmetry::symmetric;  ///< of the factorised matrices
  std::string thin_cells{};                ///< the warning of thin cells that bend, if there was one

  template <class Model>
  static RunSummary of(const March<Model>& march) {
    RunSummary run{.report = march.report(), .storage = matrix_storage<Model>};
    if constexpr (has_friction<Model>) {
      using Friction = typename Model::Friction;
      run.bound = !has_lag<Model>() || has_outer_iterations<Model>() ? Bound::current : Bound::lagged;
      if constexpr (requires { Friction::Pressure::lag_order; })
        if (Friction::Pressure::lag_order == 2) run.bound = Bound::extrapolated;
    }
    for (const Warning& told : march.warnings())
      if (told.name == "thin_cells_bend") run.thin_cells = told.text;
    return run;
  }
};

/// A recommendation for the wished accuracy.
struct Advice {
  std::string friction;  ///< pressure source: "current", "last converged" or "extrapolated"; "" without friction
  std::string solver;    ///< matrix to factorise: "symmetric", "symmetric, corrected" or "general"
  Index steps = 0;
  Real seconds = 0;   ///< expected, on the same machine [s]
  std::string words;  ///< the recommendation in words
};

/// Recommends from the error estimates and timings of a coarse run the pressure source, number of steps and kind of
/// solver that bring the error of the force below `wished` [-] in the least time (theory.md, section 6.6): errors by
/// lag and step size are proportional to the step size (the lag of the extrapolated slip bound to its square), and the
/// time per iteration is constant. The estimates hold within a factor of two or three, so each is doubled. Throws
/// std::invalid_argument if the run has no step, or `wished` is not a number between 0 and 1.
inline Advice advise(const RunSummary& run, Real wished) {
  if (!(wished > 0 && wished < 1)) throw std::invalid_argument("advise: the wished error must lie between 0 and 1");
  const RunReport& r = run.report;
  if (r.steps < 1 || r.iterations < 1) throw std::invalid_argument("advise: the run has not taken a step");
  using Bound = RunSummary::Bound;
  constexpr Real reserve = 2;
  // Flops of an LU over those of a symmetric factor, and likewise of the substitutions; back-substitutions per
  // corrected solution if none were counted.
  constexpr Real general_cost = 2, usual_corrections = 6;

  const Real corrections = r.work.corrections > 0 ? Real(r.work.corrections) / r.iterations : usual_corrections;
  const Real general = run.storage == Symmetry::general ? general_cost : 1;
  const Real other = (r.timings.assembly + r.timings.contact) / r.iterations;
  const Real factor = r.timings.factorization / r.iterations / general;
  const Real substitution = r.timings.solve / r.iterations / general / (r.work.corrections > 0 ? corrections : Real(1));
  const auto steps_for = [&](Real error, Real order) {
    return r.steps * std::pow(reserve * error / wished, 1 / order);
  };
  const Real by_time = steps_for(r.errors.time, 1);

  std::vector<Advice> ways;
  const auto add = [&](const char* friction, const char* solver, Real steps, Real an_iteration) {
    // Fewer than a quarter of the run's steps may not converge.
    const Index n = static_cast<Index>(std::ceil(std::clamp(steps, 0.25 * r.steps, 1e9)));
    ways.push_back({friction, solver, n, n * an_iteration * r.iterations / r.steps, {}});
  };
  const Real symmetric = other + factor + substitution;
  if (run.bound == Bound::none) add("", "symmetric", by_time, symmetric);
  if (run.bound == Bound::lagged)
    add("last converged", "symmetric", std::max(by_time, steps_for(r.errors.lag, 1)), symmetric);
  if (run.bound == Bound::extrapolated)
    add("extrapolated", "symmetric", std::max(by_time, steps_for(r.errors.lag, 2)), symmetric);
  if (run.bound != Bound::none) {
    add("current", "symmetric, corrected", by_time, other + factor + corrections * substitution);
    add("current", "general", by_time, other + general_cost * (factor + substitution));
  }
  std::sort(ways.begin(), ways.end(), [](const Advice& a, const Advice& b) { return a.seconds < b.seconds; });

  const auto number = [](const char* format, auto... values) {
    char text[160];
    std::snprintf(text, sizeof text, format, values...);
    return std::string(text);
  };
  Advice best = ways.front();
  best.words = number("For an error of the force below %.2g %%: ", 100 * wished);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Advice& way = ways[i];
    best.words += i == 0 ? "" : i == 1 ? " Instead: " : "; ";
    if (!way.friction.empty()) best.words += "the " + way.friction + " pressure in the friction bound, ";
    best.words += "a " + way.solver + number(" factor, %d steps, about %.2g s", way.steps, way.seconds);
    if (i == 0) best.words += ".";
  }
  if (ways.size() > 1) best.words += ".";
  best.words += number(" The run took %d steps, and is estimated to err by %.2g %% for their size and %.2g %% by lag.",
                       r.steps, 100 * r.errors.time, 100 * r.errors.lag);
  if (reserve * r.errors.penetration > wished)
    best.words +=
        number(" Penetration alone errs by about %.2g %%: penalties %.2g times as stiff, or an augmented Lagrangian.",
               100 * reserve * r.errors.penetration, reserve * r.errors.penetration / wished);
  if (r.errors.space > 0)
    best.words +=
        number(" The mesh leaves an error of %.2g %% in the stress, which no step mends.", 100 * r.errors.space);
  if (!run.thin_cells.empty())
    best.words +=
        " Not in these figures: " + run.thin_cells +
        ". AssumedStrain on this mesh is without that error, at about one and a half times the time of an element.";
  return best;
}

template <class Model>
Advice advise(const March<Model>& march, Real wished) {
  return advise(RunSummary::of(march), wished);
}

}  // namespace stickslip
