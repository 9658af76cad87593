// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_iterative.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

solvers::Outcome solvers::conjugate_gradients() {
  return outcome<ConjugateGradients>();
}
solvers::Outcome solvers::bicgstab() {
  return outcome<Bicgstab>();
}

namespace solvers {
namespace {

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

template <class Solver>
void check_limits() {
  const Matrix m = stored<Solver>(positive);
  Solver solver;
  solver.analyze(m.view());
  CHECK(answer(solver, m).solved);
  CHECK(solver.iterations() > 1);
  CHECK(solver.iterations() < 20);
  // One iteration does not do, of a matrix that takes more with a tight incomplete factor as well.
  const Matrix large = stored<Solver>(waves(20, 4.0));
  Solver patient, hurried({.iterations = 1}), loose({.tolerance = 0.1});
  for (Solver* s : {&patient, &hurried, &loose}) s->analyze(large.view());
  CHECK(answer(patient, large).solved);
  CHECK_FALSE(answer(hurried, large).solved);
  CHECK(answer(loose, large).solved);
  CHECK(loose.iterations() < patient.iterations());
  const auto refused = [](IterationLimits limits, const char* why) {
    CHECK_THROWS_WITH_AS(Solver{limits}, doctest::Contains(why), std::invalid_argument);
  };
  for (const Real tolerance : {0.0, -1.0, 1.0, std::nan("")})
    refused({.tolerance = tolerance}, ": the tolerance must lie between 0 and 1");
  refused({.iterations = 0}, ": needs at least one iteration");
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
TEST_CASE("a march takes the limits of its solver, also of a corrected one, and refuses invalid ones") {
  const auto moved = [](auto model, Real tolerance) {
    auto p = scene::press_and_drag<decltype(model)>(0.2, 0.2, 1, {8, 4});
    CHECK(p->march({.end = 1, .steps = 2, .tolerance = 1e-6}, {.tolerance = tolerance}).finish());
    return p->displacement();
  };
  const auto compare = [&](auto model) {
    const Field exact = moved(model, 1e-12), rough = moved(model, 1e-3);
    CHECK(exact != rough);
    CHECK((exact - rough).norm() < 1e-4 * exact.norm());
    auto p = scene::press_and_drag<decltype(model)>(0.2, 0.2, 1, {8, 4});
    CHECK_THROWS_WITH_AS(p->march({.end = 1}, {.iterations = -1}), doctest::Contains("needs at least one iteration"),
                         std::invalid_argument);
  };
  compare(scene::Model<EigenIterative, QuasiCoulomb>{});
  compare(scene::Model<EigenIterative, Coulomb>{});
  compare(scene::Model<Corrected<ConjugateGradients>, Coulomb>{});
}

}  // namespace
}  // namespace solvers
