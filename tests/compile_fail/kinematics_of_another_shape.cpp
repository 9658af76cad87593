// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Slab {
  using Role = role::Kinematics;
  static constexpr bool hoop = false;
  struct Shape : Planar {
#ifndef CONTROL
    static constexpr int dim = 3;
#endif
  };
  static constexpr int dim = 2;
  Real measure(const Vec<Real, 2>&) const;
};
struct Bundle : Sound {
  using Kinematics = Slab;
  using Enforcement = NoContact;
  using Friction = Frictionless;
};

static_assert(CheckModel<Bundle>::ok);
