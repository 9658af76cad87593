// SPDX-License-Identifier: BSL-1.0
#include "judge.hpp"
#include "scene.hpp"

#include <stickslip/linear_solver/mumps.hpp>

#include <doctest/doctest.h>

namespace typed {

template <>
struct SolverType<mumps_ldlt> {
  using type = MumpsLdlt;
};
template <>
struct SolverType<mumps_lu> {
  using type = MumpsLu;
};

std::vector<Judgement> judge_mumps() {
  return {judge<mumps_ldlt>(), judge<mumps_lu>()};
}

TEST_CASE("models of the covering set, MUMPS") {
  CHECK(run_rows([](const Row& row) { return row.solver == mumps_ldlt || row.solver == mumps_lu; }) == 3);
}

}  // namespace typed
