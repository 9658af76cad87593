// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/eigen_iterative.hpp>

#include <doctest/doctest.h>

solvers::Outcome solvers::conjugate_gradients() {
  return outcome<ConjugateGradients>();
}
solvers::Outcome solvers::bicgstab() {
  return outcome<Bicgstab>();
}

namespace solvers {
namespace {

template <class Solver>
void check_limits() {
  const Matrix m = stored<Solver>(positive);
  Solver solver;
  solver.analyze(m.view());
  CHECK(answer(solver, m).solved);
  CHECK(solver.iterations() > 1);
  CHECK(solver.iterations() < 20);
  Solver hurried;
  hurried.limits.iterations = 0;
  hurried.analyze(m.view());
  CHECK_FALSE(answer(hurried, m).solved);
  const std::vector<Real> zeros(std::size_t(m.view().size), 0.0);
  std::vector<Real> x(zeros.size(), 1.0);
  CHECK(solver.solve(zeros.data(), x.data()));
  CHECK(x == zeros);
}
TEST_CASE_TEMPLATE("iterations end at their limits", Solver, ConjugateGradients, Bicgstab) {
  check_limits<Solver>();
}

TEST_CASE("conjugate gradients refuse a matrix without a diagonal entry") {
  // (1 1; 1 0)
  const Matrix saddle{{0, 2, 2}, {0, 1}, {1.0, 1.0}, Symmetry::symmetric};
  CHECK(answer<ConjugateGradients>(saddle).factorization == Factorization::failed);
}

// Waves on a square grid: the smallest eigenvalue is diagonal - 4 cos(pi / (side + 1)).
Matrix waves(Index side, Real diagonal) {
  Matrix m{{0}, {}, {}, Symmetry::symmetric};
  const auto add = [&m](Index row, Real value) {
    m.row.push_back(row);
    m.values.push_back(value);
  };
  for (Index j = 0; j < side * side; ++j) {
    add(j, diagonal);
    if ((j + 1) % side != 0) add(j + 1, -1);
    if (j + side < side * side) add(j + side, -1);
    m.start.push_back(Index(m.row.size()));
  }
  return m;
}
TEST_CASE("conjugate gradients refuse a matrix with one negative eigenvalue") {
  const Answer definite = answer<ConjugateGradients>(waves(20, 4.0)),
               indefinite_one = answer<ConjugateGradients>(waves(20, 3.9));
  CHECK(definite.solved);
  CHECK(indefinite_one.factorization == Factorization::done);  // nothing to be seen yet
  CHECK_FALSE(indefinite_one.solved);
}
TEST_CASE("an incomplete factor that is too loose stays tightened") {
  const Matrix m = stored<Bicgstab>(waves(20, 2.5));
  Bicgstab solver;
  solver.analyze(m.view());
  CHECK(answer(solver, m).solved);
  CHECK(solver.iterations() > 300);
  CHECK(answer(solver, m).solved);
  CHECK(solver.iterations() < 100);
}

}  // namespace
}  // namespace solvers
