// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/problem.hpp>
#include <stickslip/solve/energy_books.hpp>

namespace stickslip::verify {

using stickslip::Energies;

/// Keeps the books of a run (theory.md, eq. 7.7): make one before the first step of a march, update it after every
/// step. It costs a pass over the points a step and nothing where it is not used.
template <class Model>
class EnergyLedger : public EnergyBooks<MechanicsOf<Model>, Scene<MechanicsOf<Model>>> {
 public:
  /// Begin after `Problem::march`, before its first step.
  explicit EnergyLedger(const Scene<MechanicsOf<Model>>& problem)
      : EnergyBooks<MechanicsOf<Model>, Scene<MechanicsOf<Model>>>(problem) {}
};

template <class Model>
EnergyLedger(const Problem<Model>&) -> EnergyLedger<Model>;

}  // namespace stickslip::verify
