// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "run_case.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability {

using scene::Model;
template <class S, class F, class M, class K>
struct Moving : Model<S, F, M, K> {
  using TimeIntegration = GeneralizedAlpha;
};

const TestedModel& metal() {
  static const TestedModel one{"J2, QuasiCoulomb, EigenLdlt",
                               run_case<Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>>>, true};
  return one;
}
const std::vector<TestedModel>& sheets() {
  using Sheet = FiniteJ2<PowerHardening>;
  static const std::vector<TestedModel> all = {
      {"axisymmetric J2, Coulomb, EigenLu", run_case<Model<EigenLu, Coulomb, Sheet, Axisymmetric>>},
      {"axisymmetric J2, QuasiCoulomb, EigenLdlt", run_case<Model<EigenLdlt, QuasiCoulomb, Sheet, Axisymmetric>>, true},
  };
  return all;
}
const std::vector<TestedModel>& moving() {
  static const std::vector<TestedModel> all = {
      {"dynamics, Coulomb, EigenLu", run_case<Moving<EigenLu, Coulomb, Hencky, PlaneStrain>>},
      {"dynamics, QuasiCoulomb, EigenLdlt", run_case<Moving<EigenLdlt, QuasiCoulomb, Hencky, PlaneStrain>>, true},
  };
  return all;
}
struct Ringing : Moving<EigenLdlt, Frictionless, Hencky, PlaneStrain> {
  using Enforcement = AugmentedLagrangian;
};
const TestedModel& ringing() {
  static const TestedModel one{"dynamics, frictionless, multipliers, EigenLdlt", run_case<Ringing>, false, true};
  return one;
}
const TestedModel& tube() {
  static const TestedModel one{"axisymmetric J2 dynamics, QuasiCoulomb, EigenLdlt",
                               run_case<Moving<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>, Axisymmetric>>,
                               true};
  return one;
}

}  // namespace stability
