// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"
#include "solvers_general.hpp"

#include <doctest/doctest.h>

namespace typed {

TEST_CASE("spatial models of the covering set run with general solvers") {
  CHECK(run_rows([](const Row& row) { return row.kinematics == space && row.solver % 2 == 1; }) == 7);
}

}  // namespace typed
