// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sticky {
#ifdef CONTROL
  using Role = role::Friction;
#else
  using Role = role::Enforcement;
#endif
  using Law = Sticky;
  using Pressure = CurrentPressure;
  static constexpr bool active = true, depends_on_pressure = true, depends_on_slip = false;
  FrictionBound<Real> bound(const InterfaceState<Real>&) const;
};
struct Model : Sound {
  using Friction = Sticky;
};

static_assert(CheckModel<Model>::ok);
