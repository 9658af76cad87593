// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>
#include <vector>

namespace stickslip::rigid {

/// A triangulated surface as data, as in a file. The corners of a triangle run counter-clockwise viewed from the body:
/// by the right-hand rule the normal points out of the tool.
struct Triangles {
  std::vector<Vec<Real, 3>> vertices;         ///< [length]
  std::vector<std::array<Index, 3>> corners;  ///< vertex numbers, from 0
  std::vector<Vec<Real, 3>> normals;          ///< one per vertex, out of the tool, any length; empty: from the facets
};

}  // namespace stickslip::rigid
