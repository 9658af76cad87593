// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Slab {
  using Role = role::Kinematics;
  static constexpr bool hoop = false;
  using TensorPattern = Planar;
  static constexpr int dim = 2;
#ifdef CONTROL
  Real volume_factor(const Vec<Real, 2>&) const;
#else
  float measure(const Vec<Real, 2>&) const;
#endif
};
struct Model : Sound {
  using Kinematics = Slab;
  using Enforcement = NoContact;
  using Friction = Frictionless;
};

static_assert(CheckModel<Model>::ok);
