// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sticky {
  using Role = role::Friction;
  using Law = Sticky;
  using Pressure = CurrentPressure;
  static constexpr bool active = true, depends_on_pressure = true, depends_on_slip = false;
#ifdef CONTROL
  FrictionBound<Real> bound(const InterfaceState<Real>&) const;
#else
  Real bound(const InterfaceState<Real>&) const;
#endif
};
struct Model : Sound {
  using Friction = Sticky;
};

static_assert(CheckModel<Model>::ok);
