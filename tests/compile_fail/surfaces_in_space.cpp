// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

struct Model : Sound {
#ifndef CONTROL
  using Surfaces = SurfaceContact<Frictionless>;
#endif
  using Kinematics = ThreeDimensional;
  using Element = MeanDilatation<Hex8>;
};

static_assert(CheckModel<Model>::ok);
