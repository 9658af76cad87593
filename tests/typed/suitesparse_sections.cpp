// SPDX-License-Identifier: BSL-1.0
#include "judge.hpp"
#include "scene.hpp"

#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

#include <doctest/doctest.h>

namespace typed {

template <>
struct SolverType<cholmod> {
  using type = Cholmod;
};
template <>
struct SolverType<umfpack> {
  using type = Umfpack;
};

std::vector<Judgement> judge_suitesparse() {
  return {judge<cholmod>(), judge<umfpack>()};
}

TEST_CASE("models of the covering set, CHOLMOD and UMFPACK, in sections") {
  CHECK(run_rows([](const Row& row) {
          return (row.solver == cholmod || row.solver == umfpack) && row.kinematics != space;
        }) == 14);
}

}  // namespace typed
