// SPDX-License-Identifier: BSL-1.0
#include "judge.hpp"
#include "scene.hpp"

#include <stickslip/linear_solver/bicgstab.hpp>
#include <stickslip/linear_solver/conjugate_gradients.hpp>

#include <doctest/doctest.h>

namespace typed {

template <>
struct SolverType<conjugate_gradients> {
  using type = ConjugateGradients;
};
template <>
struct SolverType<bicgstab> {
  using type = Bicgstab;
};

std::vector<Judgement> judge_iterative() {
  return {judge<conjugate_gradients>(), judge<bicgstab>()};
}

TEST_CASE("models of the covering set, iterative solvers") {
  CHECK(run_rows([](const Row& row) { return row.solver == conjugate_gradients || row.solver == bicgstab; }) == 3);
}

}  // namespace typed
