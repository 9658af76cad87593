// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_direct.hpp>
#include <stickslip/linear_solver/eigen_iterative.hpp>
#include <stickslip/linear_solver/mumps.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

namespace examples {

const stickslip::run_time::SolverList& AllSolvers::solvers() {
  using namespace stickslip;
  static const run_time::SolverList all = run_time::SolverList()
                                              .add<Banded>("banded")
                                              .add<EigenLdlt>("eigen-ldlt")
                                              .add<EigenLu>("eigen-lu")
                                              .add<Cholmod>("cholmod")
                                              .add<Umfpack>("umfpack")
                                              .add<Mumps>("mumps")
                                              .add<ConjugateGradients>("conjugate-gradients")
                                              .add<Bicgstab>("bicgstab")
                                              .add<Corrected<BandedCholesky>>("corrected-banded")
                                              .add<Corrected<Cholmod>>("corrected-cholmod")
                                              .add<Corrected<EigenLdlt>>("corrected-eigen-ldlt");
  return all;
}

}  // namespace examples
