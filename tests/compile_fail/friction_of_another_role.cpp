// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Sticky {
#ifdef CONTROL
  using Role = role::Friction;
#else
  using Role = role::Enforcement;
#endif
  using Law = Sticky;
  using Pressure = CurrentPressure;
  static constexpr bool active = true, depends_on_pressure = true, depends_on_slip = false;
  FrictionBound<Real> bound(const FrictionPoint<Real>&) const;
};
struct Bundle : Sound {
  using Friction = Sticky;
};

static_assert(CheckModel<Bundle>::ok);
