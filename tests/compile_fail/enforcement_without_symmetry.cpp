// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Barrier {
  using Role = role::Enforcement;
  static constexpr bool active = true;
#ifdef CONTROL
  static constexpr Symmetry symmetry = Symmetry::symmetric;
#endif
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
