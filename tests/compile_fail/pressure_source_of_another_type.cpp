// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Smoothed {
  using Role = role::PressureSource;
  static constexpr bool follows_current = false;
  template <class S>
  struct Memory {};
#ifdef CONTROL
  static Real pressure(const Real&, const Memory<Real>&, Real);
#else
  static float pressure(const Real&, const Memory<Real>&, Real);
#endif
  static Memory<Real> advance(const Real&, const Memory<Real>&, Real);
};
struct Model : Sound {
  using Friction = WithPressure<Coulomb, Smoothed>;
};

static_assert(CheckModel<Model>::ok);
