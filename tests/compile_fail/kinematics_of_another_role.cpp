// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Slab {
#ifdef CONTROL
  using Role = role::Kinematics;
#else
  using Role = role::Element;
#endif
  static constexpr bool hoop = false;
  using Shape = Planar;
  static constexpr int dim = 2;
  Real measure(const Vec<Real, 2>&) const;
};
struct Bundle : Sound {
  using Kinematics = Slab;
  using Enforcement = NoContact;
  using Friction = Frictionless;
};

static_assert(CheckModel<Bundle>::ok);
