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

using run_time::Named;
template <class S, class F, class E = Penalty>
using Solid = scene::Model<S, F, Hencky, ThreeDimensional, MeanDilatation<Hex8>, E>;
template <class S, class F>
struct Moving : Solid<S, F> {
  using TimeIntegration = GeneralizedAlpha;
};

const std::vector<TestedModel>& elastic() {
  static const auto all =
      tested(run_time::Choices{Named<Solid<EigenLu, Coulomb>>{"Coulomb, EigenLu"},
                               Named<Solid<Corrected<EigenLdlt>, Coulomb>>{"Coulomb, Corrected<EigenLdlt>"},
                               Named<Solid<EigenLdlt, QuasiCoulomb>>{"QuasiCoulomb, EigenLdlt"},
                               Named<Solid<EigenLu, Coulomb, AugmentedLagrangian>>{"multipliers, Coulomb, EigenLu"}});
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
  static const TestedModel one = tested<Solid<EigenLdlt, Frictionless>>("Frictionless, EigenLdlt");
  return one;
}
const TestedModel& anisotropic() {
  static const TestedModel one = tested<Solid<EigenLu, AnisotropicCoulomb>>("AnisotropicCoulomb, EigenLu");
  return one;
}
const std::vector<TestedModel>& moving() {
  static const auto all =
      tested(run_time::Choices{Named<Moving<EigenLu, Coulomb>>{"dynamics, Coulomb, EigenLu"},
                               Named<Moving<EigenLdlt, QuasiCoulomb>>{"dynamics, QuasiCoulomb, EigenLdlt"}});
  return all;
}

}  // namespace stability::space
