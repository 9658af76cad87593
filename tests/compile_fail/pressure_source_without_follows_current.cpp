// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Smoothed {
  using Role = role::PressureSource;
#ifdef CONTROL
  static constexpr bool follows_current = false;
#endif
  template <class S>
  struct Memory {};
  static Real pressure(const Real&, const Memory<Real>&, Real);
  static Memory<Real> advance(const Real&, const Memory<Real>&, Real);
};
struct Model : Sound {
  using Friction = WithPressure<Coulomb, Smoothed>;
};

static_assert(CheckModel<Model>::ok);
