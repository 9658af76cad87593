// SPDX-License-Identifier: BSL-1.0
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/tabulated_hardening.hpp>

using namespace stickslip;

static_assert(FrictionPolicy<QuasiCoulomb>);

// A table through the points of a straight line is that line.
int main() {
  const FiniteJ2<TabulatedHardening> metal{
      .young = 70e3, .poisson = 0.33, .hardening = {{{0, 100}, {0.1, 110}, {0.2, 120}, {0.4, 140}}}};
  const auto flow = metal.hardening.flow(0.15);
  return flow.value > 114.999 && flow.value < 115.001 ? 0 : 1;
}
