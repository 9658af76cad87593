// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/hex8.hpp>

#include <cmath>

namespace element_check::brick {

using namespace stickslip;

/// A brick with uneven corners; no two faces are parallel.
inline Mat<Real, 8, 3> distorted() {
  Mat<Real, 8, 3> X;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
      X(a, i) = 0.6 * Hex8::corner[std::size_t(a)][std::size_t(i)] + 0.1 * std::sin(5.0 * a + 2 * i);
  return X;
}
inline Vec<Real, 24> displacement(Real scale) {
  Vec<Real, 24> u;
  for (int k = 0; k < 24; ++k) u[k] = 0.15 * std::cos(2.7 * k + 0.3);
  return scale * u;
}

}  // namespace element_check::brick
