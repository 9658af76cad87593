// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/banded.hpp>

#include <doctest/doctest.h>

solvers::Outcome solvers::banded_cholesky() {
  return outcome<BandedCholesky>();
}
solvers::Outcome solvers::banded_lu() {
  return outcome<BandedLu>();
}

namespace solvers {
namespace {

// A chain of 2 n nodes whose even ones are numbered first.
Matrix badly_numbered(Index half) {
  Matrix m{{0}, {}, {}, Symmetry::symmetric};
  const auto add = [&m](Index row, Real value) {
    m.row.push_back(row);
    m.values.push_back(value);
  };
  for (Index j = 0; j < 2 * half; ++j) {
    add(j, 3);
    if (j < half) {
      if (j > 0) add(half + j - 1, -1);
      add(half + j, -1);
    }
    m.start.push_back(Index(m.row.size()));
  }
  return m;
}
TEST_CASE_TEMPLATE("bands are renumbered unless they are not to be", Solver, BandedCholesky, BandedLu) {
  const Matrix m = stored<Solver>(badly_numbered(20));
  Solver reordered, natural({.reorder = false});
  reordered.analyze(m.view());
  natural.analyze(m.view());
  CHECK(reordered.half_bandwidth() == 1);
  CHECK(natural.half_bandwidth() == 20);
  const Answer a = answer(reordered, m), b = answer(natural, m);
  REQUIRE((a.solved && b.solved));
  for (std::size_t i = 0; i < a.x.size(); ++i) CHECK(a.x[i] == doctest::Approx(b.x[i]).epsilon(1e-12));
}

}  // namespace
}  // namespace solvers
