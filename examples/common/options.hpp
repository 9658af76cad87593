// SPDX-License-Identifier: BSL-1.0
// The command line that all benchmarks share.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace examples {

/// A parameter that one benchmark has besides the common ones: a number in a range, or one of a few names, of which
/// the value is the position.
struct Parameter {
  std::string name, about;
  double value = 0;  ///< default
  double low = 0, high = 0;
  std::vector<std::string> names{};
};

/// What the user asked for.
struct Options {
  std::string friction, solver;
  double mu = 0;
  int refine = 1;
  int steps = 0;  ///< 0: automatic
  double tolerance = 0;
  double lag_tolerance = 0, step_tolerance = 0;  ///< 0: none
  int mesh_error_interval = 10;                  ///< steps from one estimate of the mesh's error to the next; 0: none
  double wished = 0;                             ///< error of the force to advise on; 0: none
  std::filesystem::path output;                  ///< empty: write no files
  std::string json;                              ///< empty: none; "-": standard output
  std::filesystem::path checkpoint, restart;     ///< empty: none
  int checkpoint_every = 50;                     ///< steps from one restart file to the next
  bool quiet = false;
  bool list = false;
  std::map<std::string, double> parameters;  ///< of the benchmark, by name
};

/// Names of the elements that benchmarks offer with --element.
inline const std::vector<std::string> element_names{"mean-dilatation", "assumed-strain"};

/// What a program offers and what it takes where the user says nothing.
struct Program {
  std::string name, title;
  std::vector<std::string> frictions, solvers;  ///< names; the first of each is the default
  double mu = 0;
  double tolerance = 1e-5;
  std::vector<Parameter> parameters{};
};

/// A command line that cannot be taken; its text is one sentence. Programs end with exit code 2.
struct BadOption : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Joins names for a sentence.
std::string joined(const std::vector<std::string>& names);

/// Reads the command line; empty when --help was answered.
std::optional<Options> parse(int argc, char** argv, const Program& program);

/// Exit code of a run that came to its end, but not all that it was asked for could be written.
inline constexpr int output_missing = 4;

/// Whether the standard output is open to be written. Throws std::runtime_error with the reason if not.
void check_standard_output();

/// Writes to it. Throws std::runtime_error with the reason, as where it is a full disc or a pipe that nobody reads.
void write_to_standard_output(std::string_view text);

/// Runs the body of a main function: exit code 2 and one sentence for input that cannot be taken, 1 for a failure, 4 if
/// what was printed could not be written.
int guarded(const std::string& name, const std::function<int()>& body);

}  // namespace examples
