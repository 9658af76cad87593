// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

#include <stickslip/assembly/contact_pair.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

struct Bundle : Sound {
  using Kinematics = ThreeDimensional;
  using Element = FullyIntegrated<Hex8>;
#ifdef CONTROL
  using Tool = rigid::Revolution;
#else
  using Tool = rigid::Profile;
#endif
};

static_assert(sizeof(ContactPair<Bundle>) > 0);
