// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/problem.hpp>
#include <stickslip/solve/energy_gain.hpp>

namespace stickslip::verify {

using stickslip::Energies;

/// Energy balance of a run (theory.md, eq. 7.7): construct it before the first step of a march and update it after
/// every step. It costs a loop over the quadrature points per step.
template <class Model>
class EnergyBalance : public EnergyGain<MechanicsOf<Model>, Scene<MechanicsOf<Model>>> {
 public:
  /// Construct it after `Problem::march`, before the first step.
  explicit EnergyBalance(const Scene<MechanicsOf<Model>>& problem)
      : EnergyGain<MechanicsOf<Model>, Scene<MechanicsOf<Model>>>(problem) {}
};

template <class Model>
EnergyBalance(const Problem<Model>&) -> EnergyBalance<Model>;

}  // namespace stickslip::verify
