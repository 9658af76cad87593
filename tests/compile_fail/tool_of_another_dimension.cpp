// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/contact/contact_pair.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

struct Model : Sound {
  using Kinematics = ThreeDimensional;
  using Element = FullyIntegrated<Hex8>;
#ifdef CONTROL
  using Tool = rigid::Revolution;
#else
  using Tool = rigid::Profile;
#endif
};

static_assert(sizeof(ContactPair<Model>) > 0);
