// SPDX-License-Identifier: BSL-1.0
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

TEST_CASE("models of the covering set, CHOLMOD and UMFPACK, in space") {
  CHECK(run_rows([](const Row& row) {
          return (row.solver == cholmod || row.solver == umfpack) && row.kinematics == space;
        }) == 6);
}

}  // namespace typed
