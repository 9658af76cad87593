// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

solvers::Outcome solvers::eigen_ldlt() {
  return outcome<EigenLdlt>();
}
solvers::Outcome solvers::eigen_lu() {
  return outcome<EigenLu>();
}
