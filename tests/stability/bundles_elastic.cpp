// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "play.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability {

using scene::Model;
using Iterated = WithPressure<Coulomb, LagIterated>;
template <class S, class F>
using Multipliers = Model<S, F, Hencky, PlaneStrain, MeanDilatation<Quad4>, AugmentedLagrangian>;

const std::vector<Bundle>& elastic() {
  static const std::vector<Bundle> all = {
      {"Coulomb, EigenLu", play<Model<EigenLu, Coulomb>>},
      {"Coulomb, Corrected<EigenLdlt>", play<Model<Corrected<EigenLdlt>, Coulomb>>},
      {"LagIterated, EigenLdlt", play<Model<EigenLdlt, Iterated>>},
      {"Symmetrised, EigenLdlt", play<Model<EigenLdlt, WithPressure<Coulomb, Symmetrised>>>},
      {"QuasiCoulomb, EigenLdlt", play<Model<EigenLdlt, QuasiCoulomb>>, true},
      {"multipliers, Coulomb, EigenLu", play<Multipliers<EigenLu, Coulomb>>, false, true},
  };
  return all;
}
const Bundle& coulomb() {
  return elastic()[0];
}
const Bundle& quasi() {
  return elastic()[4];
}
const Bundle& augmented() {
  return elastic()[5];
}
const Bundle& smooth() {
  static const Bundle one{"Frictionless, EigenLdlt", play<Model<EigenLdlt, Frictionless>>};
  return one;
}

}  // namespace stability
