// SPDX-License-Identifier: BSL-1.0
#include <stickslip/material/finite_j2.hpp>

using namespace stickslip;

struct Softening {
#ifdef CONTROL
  using Role = role::Hardening;
#endif
  FlowStress<Real> flow(const Real&) const;
};
static_assert(sizeof(FiniteJ2<Softening>) > 0);
