// SPDX-License-Identifier: BSL-1.0
#include "judge.hpp"
#include "scene.hpp"

#include <stickslip/linear_solver/banded.hpp>

#include <doctest/doctest.h>

namespace typed {

template <>
struct SolverType<banded_cholesky> {
  using type = BandedCholesky;
};
template <>
struct SolverType<banded_lu> {
  using type = BandedLu;
};

std::vector<Judgement> judge_banded() {
  return {judge<banded_cholesky>(), judge<banded_lu>()};
}

TEST_CASE("models of the covering set, band solvers, in sections") {
  CHECK(run_rows([](const Row& row) {
          return (row.solver == banded_cholesky || row.solver == banded_lu) && row.kinematics != space;
        }) == 15);
}

}  // namespace typed
