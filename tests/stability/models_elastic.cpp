// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "run_case.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability {

using run_time::Named, scene::Model;
using Iterated = WithPressure<Coulomb, LagIterated>;
template <class S, class F>
using Multipliers = Model<S, F, Hencky, PlaneStrain, MeanDilatation<Quad4>, AugmentedLagrangian>;

const std::vector<TestedModel>& elastic() {
  static const auto all =
      tested(run_time::Choices{Named<Model<EigenLu, Coulomb>>{"Coulomb, EigenLu"},
                               Named<Model<Corrected<EigenLdlt>, Coulomb>>{"Coulomb, Corrected<EigenLdlt>"},
                               Named<Model<EigenLdlt, Iterated>>{"LagIterated, EigenLdlt"},
                               Named<Model<EigenLdlt, WithPressure<Coulomb, Symmetrised>>>{"Symmetrised, EigenLdlt"},
                               Named<Model<EigenLdlt, QuasiCoulomb>>{"QuasiCoulomb, EigenLdlt"},
                               Named<Multipliers<EigenLu, Coulomb>>{"multipliers, Coulomb, EigenLu"}});
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
  static const TestedModel one = tested<Model<EigenLdlt, Frictionless>>("Frictionless, EigenLdlt");
  return one;
}

}  // namespace stability
