// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Barrier {
  using Role = role::Enforcement;
  static constexpr bool active = true;
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  template <class S>
  struct Memory {};
  PenaltyPer per = PenaltyPer::node;
  NormalForce<Real> normal_force(const Real&, Real, const Memory<Real>&) const;
#ifdef CONTROL
  Real stick_stiffness(Real) const;
#endif
};
struct Model : Sound {
  using Enforcement = Barrier;
};

static_assert(CheckModel<Model>::ok);
