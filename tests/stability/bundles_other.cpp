// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "play.hpp"

#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace stability {

using scene::Model;
template <class S, class F, class M, class K>
struct Moving : Model<S, F, M, K> {
  using Inertia = GeneralizedAlpha;
};

const Bundle& metal() {
  static const Bundle one{"J2, QuasiCoulomb, EigenLdlt",
                          play<Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>>>, true};
  return one;
}
const std::vector<Bundle>& sheets() {
  using Sheet = FiniteJ2<PowerHardening>;
  static const std::vector<Bundle> all = {
      {"axisymmetric J2, Coulomb, EigenLu", play<Model<EigenLu, Coulomb, Sheet, Axisymmetric>>},
      {"axisymmetric J2, QuasiCoulomb, EigenLdlt", play<Model<EigenLdlt, QuasiCoulomb, Sheet, Axisymmetric>>, true},
  };
  return all;
}
const std::vector<Bundle>& moving() {
  static const std::vector<Bundle> all = {
      {"dynamics, Coulomb, EigenLu", play<Moving<EigenLu, Coulomb, Hencky, PlaneStrain>>},
      {"dynamics, QuasiCoulomb, EigenLdlt", play<Moving<EigenLdlt, QuasiCoulomb, Hencky, PlaneStrain>>, true},
  };
  return all;
}
struct Ringing : Moving<EigenLdlt, Frictionless, Hencky, PlaneStrain> {
  using Enforcement = AugmentedLagrangian;
};
const Bundle& ringing() {
  static const Bundle one{"dynamics, frictionless, multipliers, EigenLdlt", play<Ringing>, false, true};
  return one;
}
const Bundle& tube() {
  static const Bundle one{"axisymmetric J2 dynamics, QuasiCoulomb, EigenLdlt",
                          play<Moving<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>, Axisymmetric>>, true};
  return one;
}

}  // namespace stability
