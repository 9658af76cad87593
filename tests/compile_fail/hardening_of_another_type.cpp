// SPDX-License-Identifier: BSL-1.0
#include <stickslip/material/finite_j2.hpp>

using namespace stickslip;

struct Softening {
  using Role = role::Hardening;
#ifdef CONTROL
  FlowStress<Real> flow(const Real&) const;
#else
  Real flow(const Real&) const;
#endif
};
static_assert(sizeof(FiniteJ2<Softening>) > 0);
