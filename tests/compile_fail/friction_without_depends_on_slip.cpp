// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Sticky {
  using Role = role::Friction;
  using Law = Sticky;
  using Pressure = CurrentPressure;
  static constexpr bool active = true, depends_on_pressure = true;
#ifdef CONTROL
  static constexpr bool depends_on_slip = false;
#endif
  FrictionBound<Real> bound(const InterfaceState<Real>&) const;
};
struct Model : Sound {
  using Friction = Sticky;
};

static_assert(CheckModel<Model>::ok);
