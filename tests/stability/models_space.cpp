// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "run_case.hpp"

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
  using TimeIntegration = GeneralizedAlpha;
};

const std::vector<TestedModel>& elastic() {
  static const std::vector<TestedModel> all = {
      {"Coulomb, EigenLu", run_case<Solid<EigenLu, Coulomb>>},
      {"Coulomb, Corrected<EigenLdlt>", run_case<Solid<Corrected<EigenLdlt>, Coulomb>>},
      {"QuasiCoulomb, EigenLdlt", run_case<Solid<EigenLdlt, QuasiCoulomb>>, true},
      {"multipliers, Coulomb, EigenLu", run_case<Solid<EigenLu, Coulomb, AugmentedLagrangian>>, false, true},
  };
  return all;
}
const TestedModel& coulomb() {
  return elastic()[0];
}
const TestedModel& quasi() {
  return elastic()[2];
}
const TestedModel& augmented() {
  return elastic()[3];
}
const TestedModel& smooth() {
  static const TestedModel one{"Frictionless, EigenLdlt", run_case<Solid<EigenLdlt, Frictionless>>};
  return one;
}
const TestedModel& anisotropic() {
  static const TestedModel one{"AnisotropicCoulomb, EigenLu", run_case<Solid<EigenLu, AnisotropicCoulomb>>};
  return one;
}
const std::vector<TestedModel>& moving() {
  static const std::vector<TestedModel> all = {
      {"dynamics, Coulomb, EigenLu", run_case<Moving<EigenLu, Coulomb>>},
      {"dynamics, QuasiCoulomb, EigenLdlt", run_case<Moving<EigenLdlt, QuasiCoulomb>>, true},
  };
  return all;
}

}  // namespace stability::space
