// SPDX-License-Identifier: BSL-1.0
#include "judge.hpp"
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

#include <doctest/doctest.h>

namespace typed {

template <>
struct SolverType<eigen_ldlt> {
  using type = EigenLdlt;
};
template <>
struct SolverType<eigen_lu> {
  using type = EigenLu;
};

std::vector<Judgement> judge_eigen() {
  return {judge<eigen_ldlt>(), judge<eigen_lu>()};
}

TEST_CASE("models of the covering set, Eigen's solvers, in sections") {
  CHECK(run_rows([](const Row& row) {
          return (row.solver == eigen_ldlt || row.solver == eigen_lu) && row.kinematics != space;
        }) == 15);
}

}  // namespace typed
