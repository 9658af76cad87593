// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sticky {
  using Role = role::Friction;
  using Law = Sticky;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = false;
#ifdef CONTROL
  FrictionBound<Real> bound(const InterfaceState<Real>& at) const;
#else
  Real bound(const InterfaceState<Real>& at) const;
#endif
};
struct Model : Sound {
  using Friction = PerContact<Coulomb, Sticky, Frictionless>;
};

static_assert(CheckModel<Model>::ok);
