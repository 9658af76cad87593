// SPDX-License-Identifier: BSL-1.0
#include "../physics/scene.hpp"
#include "run_case.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>

namespace stability {

template <class M>
using Bending = scene::Model<EigenLdlt, QuasiCoulomb, M, PlaneStrain, AssumedStrain<Quad4>>;

const TestedModel& bends() {
  static const TestedModel one = tested<Bending<Hencky>>("AssumedStrain, QuasiCoulomb, EigenLdlt");
  return one;
}
const TestedModel& bending_metal() {
  static const TestedModel one =
      tested<Bending<FiniteJ2<LinearHardening>>>("AssumedStrain, J2, QuasiCoulomb, EigenLdlt");
  return one;
}

}  // namespace stability
