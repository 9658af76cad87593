// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

#include <stickslip/contact/contact_pair.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

// Friction on a curved tool takes the third derivative of the distance, by dual numbers.
struct Floor {
  bool empty() const;
  Distance<Real, 3> distance(const Vec<Real, 3>& x) const;
#ifdef CONTROL
  Distance<Dual<3>, 3> distance(const Vec<Dual<3>, 3>& x) const;
#endif
};
struct Model : Sound {
  using Kinematics = ThreeDimensional;
  using Element = FullyIntegrated<Hex8>;
  using Tool = Floor;
};

static_assert(sizeof(ContactPair<Model>) > 0);
