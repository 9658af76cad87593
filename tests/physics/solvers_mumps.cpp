// SPDX-License-Identifier: BSL-1.0
#include "solver_runs.hpp"

#include <stickslip/linear_solver/mumps.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>
#include <Eigen/Eigenvalues>

#include <utility>

solvers::Outcome solvers::mumps_ldlt() {
  return outcome<MumpsLdlt>();
}
solvers::Outcome solvers::mumps_lu() {
  return outcome<MumpsLu>();
}

namespace solvers {
namespace {

TEST_CASE("MUMPS counts the negative eigenvalues, leaves the matrix alone and can be moved") {
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(verify::dense(indefinite.view()), Eigen::EigenvaluesOnly)
          .eigenvalues();
  const Matrix kept = indefinite;
  MumpsLdlt first;
  CHECK(first.factorize(indefinite.view()) == Factorization::failed);  // nothing analysed yet
  first.analyze(indefinite.view());
  CHECK(first.factorize(indefinite.view()) == Factorization::indefinite);
  CHECK(first.negative_pivots() == (eigenvalues.array() < 0).count());
  const Answer here = answer(first, indefinite);
  MumpsLdlt second = std::move(first);
  CHECK(answer(second, indefinite).x == here.x);
  CHECK(first.factorize(indefinite.view()) == Factorization::failed);  // NOLINT(bugprone-use-after-move)
  first.analyze(positive.view());
  CHECK(answer(first, positive).factorization == Factorization::done);
  first = std::move(second);
  CHECK(answer(first, indefinite).x == here.x);
  CHECK(indefinite.values == kept.values);
}

}  // namespace
}  // namespace solvers
