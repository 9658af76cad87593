// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

struct Bundle : Sound {
  using Friction = AnisotropicCoulomb;
#ifdef CONTROL
  using Kinematics = ThreeDimensional;
  using Element = FullyIntegrated<Hex8>;
#endif
};

static_assert(CheckModel<Bundle>::ok);
