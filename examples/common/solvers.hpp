// SPDX-License-Identifier: BSL-1.0
// The linear solvers of the benchmarks, chosen by name as they run.
#pragma once

#include <stickslip/run_time.hpp>

namespace examples {

/// All of them. They are compiled in one unit.
struct AllSolvers {
  static const stickslip::run_time::SolverList& solvers();
};

}  // namespace examples
