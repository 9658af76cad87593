// SPDX-License-Identifier: BSL-1.0
#include "newton_check.hpp"

#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>

namespace newton_coulomb {
using namespace newton_check;
TEST_CASE("Newton converges quadratically: Coulomb, elastic") {
  check<Coulomb, Hencky, EigenLu>(0.2);
}
TEST_CASE("Newton converges quadratically: Coulomb, plastic") {
  check<Coulomb, FiniteJ2<PowerHardening>, EigenLu>(0.2);
}
TEST_CASE("Newton converges quadratically: Coulomb, hypoelastic-plastic") {
  check<Coulomb, HypoelasticJ2<PowerHardening>, EigenLu>(0.2);
}
}  // namespace newton_coulomb
