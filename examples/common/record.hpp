// SPDX-License-Identifier: BSL-1.0
// What a benchmark run leaves behind, free of the model's type, and how it is written.
#pragma once

#include "options.hpp"
#include "outputs.hpp"

#include <stickslip/base/archive.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/solve/report.hpp>
#include <stickslip/solve/warnings.hpp>
#include <stickslip/verify/energy.hpp>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace examples {

/// Names and labels of a benchmark.
struct Labels {
  std::string name;                  ///< of the program
  std::string kinematics, material;  ///< for the JSON
  std::string travel, force;         ///< of the picture's axes, travel in mm and force in kN
  std::string view;                  ///< gnuplot ranges of the deformed mesh
};

/// A run from start to end.
struct Record {
  Labels labels;
  stickslip::Index elements = 0, unknowns = 0;
  bool symmetric_storage = false;
  stickslip::Outcome outcome{};
  stickslip::RunReport report{};
  std::vector<stickslip::Warning> warnings{};
  std::vector<stickslip::StepReport> steps{};
  std::vector<double> time_s{}, travel_mm{}, force_N{};  ///< one entry more than steps: the start
  double max_plastic_strain = 0;
  double seconds = 0;
  std::string advice{};                                   ///< where it was asked for
  std::optional<stickslip::verify::Energies> energies{};  ///< [N mm], where the benchmark keeps the books
  bool checks_self_penetration = false;
  double deepest_in_itself_mm = 0;              ///< of a node in another part of the body
  std::optional<double> self_penetration_mm{};  ///< travel from which on the body passes through itself

  /// The histories, and the seconds so far.
  void serialize(stickslip::Archive& archive);
};

/// Wall clock that can be stopped while files are written.
class Clock {
 public:
  void start() { begin_ = std::chrono::steady_clock::now(); }
  void stop() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  double seconds() const { return seconds_; }

 private:
  std::chrono::steady_clock::time_point begin_{};
  double seconds_ = 0;
};

/// The line of progress on a terminal; silent elsewhere.
void show_progress(const Options& options, const Record& record, double fraction);
void end_progress(const Options& options);

/// Writes JSON, CSV, pictures, the warnings and the one-line summary as far as they are asked for. Returns the exit
/// code: 0, 1 if the run failed, or output_missing.
int conclude(const Options& options, const Record& record, Outputs& outputs);

}  // namespace examples
