// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

#include <doctest/doctest.h>

solvers::Outcome solvers::cholmod() {
  return outcome<Cholmod>();
}
solvers::Outcome solvers::umfpack() {
  return outcome<Umfpack>();
}

namespace solvers {
namespace {

// An arrow, its dense row and column first: in the given order the factor fills, in any other it does not.
Matrix arrow(Index size) {
  Matrix m{{0}, {}, {}, Symmetry::symmetric};
  for (Index j = 0; j < size; ++j) {
    m.row.push_back(j);
    m.values.push_back(j == 0 ? Real(size) : 2);
    for (Index i = 1; j == 0 && i < size; ++i) {
      m.row.push_back(i);
      m.values.push_back(1);
    }
    m.start.push_back(Index(m.row.size()));
  }
  return m;
}
TEST_CASE("CHOLMOD takes the ordering and the kind of factor that it is told") {
  using Ordering = CholmodParameters::Ordering;
  using Factor = CholmodParameters::Factor;
  const Matrix m = arrow(200);
  struct Result {
    Answer answer;
    std::size_t bytes;
  };
  const auto solve = [&](const CholmodParameters& parameters) {
    Cholmod solver(parameters);
    solver.analyze(m.view());
    Answer a = answer(solver, m);
    CHECK(a.solved);
    return Result{a, solver.factor_bytes()};
  };
  const Result best = solve({});
  for (const Ordering ordering : {Ordering::amd, Ordering::metis, Ordering::natural})
    for (const Factor factor : {Factor::best, Factor::simplicial, Factor::supernodal}) {
      const Result r = solve({.ordering = ordering, .factor = factor});
      for (std::size_t i = 0; i < r.answer.x.size(); ++i)
        CHECK(r.answer.x[i] == doctest::Approx(best.answer.x[i]).epsilon(1e-12));
      if (ordering == Ordering::natural)
        CHECK(r.bytes > 10 * best.bytes);
      else if (factor != Factor::supernodal)
        CHECK(r.bytes < 2 * best.bytes);
    }
  CHECK(solve({.factor = Factor::supernodal}).bytes != solve({.factor = Factor::simplicial}).bytes);
}

}  // namespace
}  // namespace solvers
