// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "play.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability::space {

template <class S, class F, class E = Penalty>
using Solid = scene::Model<S, F, Hencky, ThreeDimensional, MeanDilatation<Hex8>, E>;
template <class S, class F>
struct Moving : Solid<S, F> {
  using Inertia = GeneralizedAlpha;
};

const std::vector<Bundle>& elastic() {
  static const std::vector<Bundle> all = {
      {"Coulomb, EigenLu", play<Solid<EigenLu, Coulomb>>},
      {"Coulomb, Corrected<EigenLdlt>", play<Solid<Corrected<EigenLdlt>, Coulomb>>},
      {"QuasiCoulomb, EigenLdlt", play<Solid<EigenLdlt, QuasiCoulomb>>, true},
      {"multipliers, Coulomb, EigenLu", play<Solid<EigenLu, Coulomb, AugmentedLagrangian>>, false, true},
  };
  return all;
}
const Bundle& coulomb() {
  return elastic()[0];
}
const Bundle& quasi() {
  return elastic()[2];
}
const Bundle& augmented() {
  return elastic()[3];
}
const Bundle& smooth() {
  static const Bundle one{"Frictionless, EigenLdlt", play<Solid<EigenLdlt, Frictionless>>};
  return one;
}
const Bundle& anisotropic() {
  static const Bundle one{"AnisotropicCoulomb, EigenLu", play<Solid<EigenLu, AnisotropicCoulomb>>};
  return one;
}
const std::vector<Bundle>& moving() {
  static const std::vector<Bundle> all = {
      {"dynamics, Coulomb, EigenLu", play<Moving<EigenLu, Coulomb>>},
      {"dynamics, QuasiCoulomb, EigenLdlt", play<Moving<EigenLdlt, QuasiCoulomb>>, true},
  };
  return all;
}

}  // namespace stability::space
