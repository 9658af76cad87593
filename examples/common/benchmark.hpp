// SPDX-License-Identifier: BSL-1.0
// Runs a benchmark as the command line asks.
#pragma once

#include "checkpoint.hpp"
#include "dispatch.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "pictures.hpp"
#include "record.hpp"
#include "solvers.hpp"

#include <stickslip/advise.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/io/vtu.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/verify/energy.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <optional>
#include <string>

namespace examples {

/// The paper's friction laws and the cures of the lag, under their command-line names.
inline constexpr stickslip::run_time::Choices coulomb_laws{
    stickslip::run_time::Named<stickslip::Coulomb>{"coulomb"},
    stickslip::run_time::Named<stickslip::QuasiCoulomb>{"quasi-coulomb"},
    stickslip::run_time::Named<stickslip::Frictionless>{"frictionless"},
    stickslip::run_time::Named<stickslip::ExtrapolatedCoulomb>{"extrapolated-quasi-coulomb"},
    stickslip::run_time::Named<stickslip::WithPressure<stickslip::Coulomb, stickslip::LagIterated>>{
        "lag-iterated-coulomb"},
    stickslip::run_time::Named<stickslip::WithPressure<stickslip::Coulomb, stickslip::Symmetrised>>{
        "symmetrised-coulomb"}};
/// Whether the books of work and energy are kept.
enum class Books { none, kept };

/// What is particular to a benchmark.
struct Benchmark {
  Labels labels;
  stickslip::MarchOptions march{};            ///< end, first and largest step
  std::function<double()> travel_mm;          ///< abscissa of the history, now
  std::function<double()> force_N;            ///< ordinate of the history, now
  std::function<double()> depth_in_itself{};  ///< of the body [mm]
  double most_in_itself_mm = 0;               ///< that is no passing through itself
  double reach_mm = 100;                      ///< how far the tools are drawn
  std::string section{};                      ///< of a mesh in space, the side that is drawn: see patches()
};

/// The books, where they are kept.
template <class Model, Books books>
using LedgerOf =
    stickslip::StoredIf<books == Books::kept,
                        std::optional<stickslip::verify::EnergyBalance<stickslip::MechanicsOf<Model>>>, Benchmark>;

/// All that a run depends on, for its restart file.
template <class Model, Books books>
struct RunState {
  const Options& options;
  stickslip::March<Model>& march;
  LedgerOf<Model, books>& ledger;
  std::optional<stickslip::io::VtuSeries>& series;
  Record& record;
  double &next_frame, &last_frame;

  void serialize(stickslip::Archive& archive) {
    require_same(archive, options);
    march.serialize(archive);
    if constexpr (books == Books::kept) ledger->serialize(archive);
    if (series) series->serialize(archive);
    record.serialize(archive);
    archive("series, next", next_frame);
    archive("series, last", last_frame);
  }
};

/// Marches the problem to its end, keeps about 40 states as VTU and the deformed mesh at the march's stops, and writes
/// what the options ask for.
template <class Model, Books books = Books::none>
int run(const Options& options, stickslip::Problem<Model>& problem, Benchmark benchmark) {
  using namespace stickslip;
  benchmark.march.steps = options.steps;
  benchmark.march.tolerance = options.tolerance;
  benchmark.march.lag_tolerance = options.lag_tolerance;
  benchmark.march.step_tolerance = options.step_tolerance;
  benchmark.march.mesh_error_interval = options.mesh_error_interval;
  Outputs outputs(options, benchmark.labels.name);
  Record r{.labels = benchmark.labels, .symmetric_storage = Problem<Model>::symmetric_storage};
  r.elements = problem.body().mesh().cell_count();
  const auto note = [&] {
    r.time_s.push_back(problem.time());
    r.travel_mm.push_back(benchmark.travel_mm());
    r.force_N.push_back(benchmark.force_N());
  };
  const bool restarted = !options.restart.empty();
  if (!restarted) note();
  const bool files = !options.output.empty();
  std::optional<io::VtuSeries> series;
  double next_frame = 0;
  double last_frame = 0;
  const auto keep_state = [&] {
    outputs.attempt([&] { series->write(problem); });
    last_frame = problem.time();
  };
  const auto write_shot = [&](const std::string& name) {
    outputs.attempt(
        [&] { write_mesh_data(options.output / name, problem.body(), problem.displacement(), benchmark.section); });
  };
  if (files) {
    series.emplace(options.output, benchmark.labels.name);
    if (!restarted) keep_state();
  }

  Clock clock;
  clock.start();
  SolverParametersOf<Model> solver{};
  if constexpr (std::same_as<SolverParametersOf<Model>, run_time::SolverName>) solver.name = options.solver;
  auto march = problem.march(benchmark.march, solver);
  LedgerOf<Model, books> ledger;
  if constexpr (books == Books::kept) ledger.emplace(problem);
  RunState<Model, books> state{options, march, ledger, series, r, next_frame, last_frame};
  if (restarted) read_restart(options).restore(state);
  const double seconds_before = r.seconds;
  const Checkpoints checkpoints(options);
  const auto keep_checkpoint = [&] {
    r.seconds = seconds_before + clock.seconds();
    return outputs.attempt([&] { checkpoints.write(Archive::of(state)); });
  };
  bool stopped = false;
  for (const StepReport& step : march) {
    clock.stop();
    r.steps.push_back(step);
    note();
    if constexpr (books == Books::kept) ledger->update(step);
    if (benchmark.depth_in_itself) {
      const double depth = benchmark.depth_in_itself();
      r.deepest_in_itself_mm = std::max(r.deepest_in_itself_mm, depth);
      if (depth > benchmark.most_in_itself_mm && !r.self_penetration_mm) r.self_penetration_mm = r.travel_mm.back();
    }
    if (files)
      for (const double stop : benchmark.march.stops)
        if (std::abs(step.time - stop) < 1e-9 * benchmark.march.end) write_shot(shot_name(r.travel_mm.back()));
    show_progress(options, r, step.time / benchmark.march.end);
    if (files && step.time >= next_frame) {
      keep_state();
      while (next_frame <= step.time) next_frame += benchmark.march.end / 40;
    }
    if (checkpoints.due(step.number)) keep_checkpoint();
    clock.start();
    stopped = checkpoints.stop();
    if (stopped) break;
  }
  clock.stop();
  end_progress(options);
  const bool kept = !checkpoints.kept() || keep_checkpoint();
  if (stopped) return conclude_stopped(options, benchmark.labels.name, march.report().steps, kept);

  r.unknowns = problem.unknowns();
  r.outcome = march.outcome();
  r.report = march.report();
  r.warnings = march.warnings();
  r.max_plastic_strain = problem.max_plastic_strain();
  if constexpr (books == Books::kept) r.energies = ledger->energies();
  r.checks_self_penetration = static_cast<bool>(benchmark.depth_in_itself);
  if (options.wished > 0 && r.report.steps > 0) r.advice = advise(march, options.wished).words;
  r.seconds = seconds_before + clock.seconds();
  if (files) {
    if (last_frame < problem.time()) keep_state();
    write_shot("mesh.dat");
    outputs.attempt([&] { write_tool_data(options.output / "tools.dat", problem, benchmark.reach_mm); });
  }
  return conclude(options, r, outputs);
}

}  // namespace examples
