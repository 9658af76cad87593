// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Slab {
  using Role = role::Kinematics;
  static constexpr bool hoop = false;
  using Shape = Planar;
  static constexpr int dim = 2;
#ifdef CONTROL
  Real measure(const Vec<Real, 2>&) const;
#endif
};
struct Bundle : Sound {
  using Kinematics = Slab;
  using Enforcement = NoContact;
  using Friction = Frictionless;
};

static_assert(CheckModel<Bundle>::ok);
