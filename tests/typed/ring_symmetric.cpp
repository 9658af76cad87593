// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"
#include "solvers_symmetric.hpp"

#include <doctest/doctest.h>

namespace typed {

TEST_CASE("axisymmetric models of the covering set run with symmetric solvers") {
  CHECK(run_rows([](const Row& row) { return row.kinematics == ring && row.solver % 2 == 0; }) == 8);
}

}  // namespace typed
