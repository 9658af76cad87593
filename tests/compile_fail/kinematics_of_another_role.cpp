// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Slab {
#ifdef CONTROL
  using Role = role::Kinematics;
#else
  using Role = role::Element;
#endif
  static constexpr bool hoop = false;
  using TensorPattern = Planar;
  static constexpr int dim = 2;
  Real volume_factor(const Vec<Real, 2>&) const;
};
struct Model : Sound {
  using Kinematics = Slab;
  using Enforcement = NoContact;
  using Friction = Frictionless;
};

static_assert(CheckModel<Model>::ok);
