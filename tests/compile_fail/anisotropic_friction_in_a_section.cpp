// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

struct Model : Sound {
  using Friction = AnisotropicCoulomb;
#ifdef CONTROL
  using Kinematics = ThreeDimensional;
  using Element = FullyIntegrated<Hex8>;
#endif
};

static_assert(CheckModel<Model>::ok);
