// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"
#include "solvers_symmetric.hpp"

#include <doctest/doctest.h>

namespace typed {

TEST_CASE("models of the covering set in axisymmetry, solvers of symmetric systems") {
  CHECK(run_rows([](const Row& row) { return row.kinematics == ring && row.solver % 2 == 0; }) == 8);
}

}  // namespace typed
