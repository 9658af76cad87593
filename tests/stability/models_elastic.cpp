// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "run_case.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability {

using scene::Model;
using Iterated = WithPressure<Coulomb, LagIterated>;
template <class S, class F>
using Multipliers = Model<S, F, Hencky, PlaneStrain, MeanDilatation<Quad4>, AugmentedLagrangian>;

const std::vector<TestedModel>& elastic() {
  static const std::vector<TestedModel> all = {
      {"Coulomb, EigenLu", run_case<Model<EigenLu, Coulomb>>},
      {"Coulomb, Corrected<EigenLdlt>", run_case<Model<Corrected<EigenLdlt>, Coulomb>>},
      {"LagIterated, EigenLdlt", run_case<Model<EigenLdlt, Iterated>>},
      {"Symmetrised, EigenLdlt", run_case<Model<EigenLdlt, WithPressure<Coulomb, Symmetrised>>>},
      {"QuasiCoulomb, EigenLdlt", run_case<Model<EigenLdlt, QuasiCoulomb>>, true},
      {"multipliers, Coulomb, EigenLu", run_case<Multipliers<EigenLu, Coulomb>>, false, true},
  };
  return all;
}
const TestedModel& coulomb() {
  return elastic()[0];
}
const TestedModel& quasi() {
  return elastic()[4];
}
const TestedModel& augmented() {
  return elastic()[5];
}
const TestedModel& smooth() {
  static const TestedModel one{"Frictionless, EigenLdlt", run_case<Model<EigenLdlt, Frictionless>>};
  return one;
}

}  // namespace stability
