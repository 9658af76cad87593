// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

solvers::Outcome solvers::cholmod() {
  return outcome<Cholmod>();
}
solvers::Outcome solvers::umfpack() {
  return outcome<Umfpack>();
}
