// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "run_case.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability {

using run_time::Named, scene::Model;
template <class S, class F, class M, class K>
struct Moving : Model<S, F, M, K> {
  using TimeIntegration = GeneralizedAlpha;
};

const TestedModel& metal() {
  static const TestedModel one =
      tested<Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>>>("J2, QuasiCoulomb, EigenLdlt");
  return one;
}
const std::vector<TestedModel>& sheets() {
  using Sheet = FiniteJ2<PowerHardening>;
  static const auto all = tested(run_time::Choices{
      Named<Model<EigenLu, Coulomb, Sheet, Axisymmetric>>{"axisymmetric J2, Coulomb, EigenLu"},
      Named<Model<EigenLdlt, QuasiCoulomb, Sheet, Axisymmetric>>{"axisymmetric J2, QuasiCoulomb, EigenLdlt"}});
  return all;
}
const std::vector<TestedModel>& moving() {
  static const auto all = tested(run_time::Choices{
      Named<Moving<EigenLu, Coulomb, Hencky, PlaneStrain>>{"dynamics, Coulomb, EigenLu"},
      Named<Moving<EigenLdlt, QuasiCoulomb, Hencky, PlaneStrain>>{"dynamics, QuasiCoulomb, EigenLdlt"}});
  return all;
}
struct Ringing : Moving<EigenLdlt, Frictionless, Hencky, PlaneStrain> {
  using Enforcement = AugmentedLagrangian;
};
const TestedModel& ringing() {
  static const TestedModel one = tested<Ringing>("dynamics, frictionless, multipliers, EigenLdlt");
  return one;
}
const TestedModel& tube() {
  static const TestedModel one = tested<Moving<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>, Axisymmetric>>(
      "axisymmetric J2 dynamics, QuasiCoulomb, EigenLdlt");
  return one;
}

}  // namespace stability
