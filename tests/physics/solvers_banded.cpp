// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/banded.hpp>

solvers::Outcome solvers::banded_cholesky() {
  return outcome<BandedCholesky>();
}
solvers::Outcome solvers::banded_lu() {
  return outcome<BandedLu>();
}
