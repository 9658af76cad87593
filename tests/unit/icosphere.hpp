// SPDX-License-Identifier: BSL-1.0
// A sphere of triangles: an icosahedron, each triangle cut in four `levels` times, vertices on the unit sphere.
#pragma once

#include <stickslip/geometry/triangles.hpp>

#include <cmath>
#include <map>
#include <utility>

namespace stickslip {

inline rigid::Triangles icosphere(int levels) {
  rigid::Triangles s;
  const Real g = 0.5 * (1 + std::sqrt(Real(5)));
  for (const auto& v : {Vec<Real, 3>(-1, g, 0), Vec<Real, 3>(1, g, 0), Vec<Real, 3>(-1, -g, 0), Vec<Real, 3>(1, -g, 0),
                        Vec<Real, 3>(0, -1, g), Vec<Real, 3>(0, 1, g), Vec<Real, 3>(0, -1, -g), Vec<Real, 3>(0, 1, -g),
                        Vec<Real, 3>(g, 0, -1), Vec<Real, 3>(g, 0, 1), Vec<Real, 3>(-g, 0, -1), Vec<Real, 3>(-g, 0, 1)})
    s.vertices.push_back(v.normalized());
  s.corners = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [at, fresh] = middles.insert({std::minmax(a, b), static_cast<Index>(s.vertices.size())});
      if (fresh)
        s.vertices.push_back(
            (s.vertices[static_cast<std::size_t>(a)] + s.vertices[static_cast<std::size_t>(b)]).normalized());
      return at->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (const auto& [a, b, c] : s.corners) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    s.corners = finer;
  }
  return s;
}

}  // namespace stickslip
