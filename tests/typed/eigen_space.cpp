// SPDX-License-Identifier: BSL-1.0
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

TEST_CASE("models of the covering set, Eigen's solvers, in space") {
  CHECK(run_rows([](const Row& row) {
          return (row.solver == eigen_ldlt || row.solver == eigen_lu) && row.kinematics == space;
        }) == 5);
}

}  // namespace typed
