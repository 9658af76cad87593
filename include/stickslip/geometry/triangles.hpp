// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>
#include <vector>

namespace stickslip::rigid {

/// A triangulated surface as data: what a file holds. The corners of a triangle run counter-clockwise seen from the
/// body, so that the right hand's thumb points out of the tool.
struct Triangles {
  std::vector<Vec<Real, 3>> vertices;         ///< [length]
  std::vector<std::array<Index, 3>> corners;  ///< vertex numbers, from 0
  std::vector<Vec<Real, 3>> normals;          ///< one a vertex, out of the tool, any length; none: made of the facets
};

}  // namespace stickslip::rigid
