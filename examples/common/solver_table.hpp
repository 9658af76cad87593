// SPDX-License-Identifier: BSL-1.0
// One run with each solver, and what an iteration costs with it.
#pragma once

#include "options.hpp"

#include <functional>
#include <string>
#include <vector>

namespace examples {

/// Calls run(options) for each solver, each in a process of its own, so that the peak memory is that solver's and one
/// that fails ends nothing but its own line. A process that asks for more than `gigabytes` or works for longer than
/// `seconds` is ended. Prints the table as the lines become known. Returns the exit code: 0 if any solver went through.
int print_solver_table(const Options& options, const std::vector<std::string>& solvers, double gigabytes,
                       double seconds, const std::function<int(const Options&)>& run);

}  // namespace examples
