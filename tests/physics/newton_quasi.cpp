// SPDX-License-Identifier: BSL-1.0
#include "newton_check.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>

namespace newton_quasi {
using namespace newton_check;
TEST_CASE("Newton converges quadratically: Quasi-Coulomb, elastic") {
  check<QuasiCoulomb, Hencky, EigenLdlt>(0.2);
}
TEST_CASE("Newton converges quadratically: Quasi-Coulomb, linear hardening") {
  check<QuasiCoulomb, FiniteJ2<LinearHardening>, EigenLdlt>(0.2);
}
TEST_CASE("Newton converges quadratically: Quasi-Coulomb, power hardening") {
  check<QuasiCoulomb, FiniteJ2<PowerHardening>, EigenLdlt>(0.2);
}
TEST_CASE("Newton converges quadratically: an element that bends, power hardening") {
  check<QuasiCoulomb, FiniteJ2<PowerHardening>, EigenLdlt, AssumedStrain<Quad4>>(0.2);
}
}  // namespace newton_quasi
