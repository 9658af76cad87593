// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/mesh/mesh.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stickslip::mesh {

/// A quarter disc about the origin, x and y not negative: cells[0] x cells[0] quadrilaterals in a block at the centre,
/// and around it two curved blocks of cells[0] along the rim and cells[1] from the block to the rim.
struct QuarterDisc {
  Real radius = 1;  ///< [length]
  std::array<Index, 2> cells{1, 1};
};

/// Meshes a quarter disc. Sides: the straight ones `x=0` and `y=0`, and `rim`. Cells along the straight sides have
/// equal lengths, unless this makes the block wider than 0.6 of the radius. No cell is degenerate: three meet at the
/// block's corner, at about 120 degrees each. Nodes are numbered along the arcs, from the centre outwards, for a small
/// bandwidth of the matrices.
inline Mesh<2, 4> quarter_disc(const QuarterDisc& d) {
  if (d.cells[0] < 1 || d.cells[1] < 1)
    throw std::invalid_argument("mesh quarter disc: needs at least one cell in the block and one around it");
  if (!(d.radius > 0) || !std::isfinite(d.radius))
    throw std::invalid_argument("mesh quarter disc: the radius must be positive and finite");
  using Point = Vec<Real, 2>;
  const Index n = d.cells[0], arcs = n + d.cells[1];
  const Real block = d.radius * std::min(Real(n) / arcs, 0.6);

  // Arc s, with s = 0 at the centre, has `steps(s)` cells. Within the block it is the L-shaped line of the nodes with
  // max(i, j) = s, bent outwards in proportion to s.
  const auto steps = [&](Index s) { return 2 * std::min(s, n); };
  const auto on_circle = [&](Index s, Index t) {
    if (2 * t == steps(s)) return Point(Point::Constant(std::sqrt(0.5)));
    const Index half = std::min(t, steps(s) - t);  // makes both halves mirror images to the last bit
    const Real angle = 0.5 * pi * half / steps(s), u = std::cos(angle), v = std::sin(angle);
    return half == t ? Point(u, v) : Point(v, u);
  };
  const auto in_block = [&](Index s, Index t) {
    constexpr Real bend = 0.4;  // makes the three angles at the corner equal
    const Real share = bend * s / n, size = block * s / n;
    const Point square(s == 0 ? 0 : std::min<Real>(1, Real(2 * s - t) / s),
                       s == 0 ? 0 : std::min<Real>(1, Real(t) / s));
    return Point(size * ((1 - share) * square + share * on_circle(s, t)));
  };

  Mesh<2, 4> mesh;
  std::vector<Index> first;  // first node of every arc
  for (Index s = 0; s <= arcs; ++s) {
    first.push_back(mesh.node_count());
    for (Index t = 0; t <= steps(s); ++t) {
      const Real out = Real(s - n) / d.cells[1];
      if (s <= n)
        mesh.nodes.push_back(in_block(s, t));
      else
        mesh.nodes.emplace_back((1 - out) * in_block(n, t) + out * d.radius * on_circle(n, t));
    }
  }
  const auto node = [&](Index s, Index t) { return first[static_cast<std::size_t>(s)] + t; };
  // Cells between the arcs s and s + 1. Within the block the outer arc takes two more steps around the corner.
  for (Index s = 0; s < arcs; ++s)
    for (Index t = 0; t < steps(s + 1); ++t) {
      if (s >= n || t < s)
        mesh.cells.push_back({node(s, t), node(s + 1, t), node(s + 1, t + 1), node(s, t + 1)});
      else if (t == s)
        mesh.cells.push_back({node(s, t), node(s + 1, t), node(s + 1, t + 1), node(s + 1, t + 2)});
      else if (t > s + 1)
        mesh.cells.push_back({node(s, t - 2), node(s + 1, t), node(s + 1, t + 1), node(s, t - 1)});
    }

  const auto add_side = [&](const char* name, Index count, auto&& at) {
    Side<2> side;
    for (Index k = 0; k <= count; ++k) side.nodes.push_back(at(k));
    for (Index k = 0; k < count; ++k) side.facets.push_back({at(k), at(k + 1)});
    mesh.sides[name] = std::move(side);
  };
  add_side("y=0", arcs, [&](Index k) { return node(k, 0); });
  add_side("rim", 2 * n, [&](Index k) { return node(arcs, k); });
  add_side("x=0", arcs, [&](Index k) { return node(arcs - k, steps(arcs - k)); });
  return mesh;
}

}  // namespace stickslip::mesh
