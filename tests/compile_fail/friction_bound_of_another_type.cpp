// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Sticky {
  using Role = role::Friction;
  using Law = Sticky;
  using Pressure = CurrentPressure;
  static constexpr bool active = true, depends_on_pressure = true, depends_on_slip = false;
#ifdef CONTROL
  FrictionBound<Real> bound(const FrictionPoint<Real>&) const;
#else
  Real bound(const FrictionPoint<Real>&) const;
#endif
};
struct Bundle : Sound {
  using Friction = Sticky;
};

static_assert(CheckModel<Bundle>::ok);
