// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Barrier {
#ifdef CONTROL
  using Role = role::Enforcement;
#endif
  static constexpr bool active = true;
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  template <class S>
  struct Memory {};
  PenaltyPer per = PenaltyPer::node;
  NormalForce<Real> normal_force(const Real&, Real, const Memory<Real>&) const;
  Real stick_stiffness(Real) const;
};
struct Model : Sound {
  using Enforcement = Barrier;
};

static_assert(CheckModel<Model>::ok);
