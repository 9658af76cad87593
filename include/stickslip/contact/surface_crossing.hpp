// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/surface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace stickslip {

/// Whether nodes of one surface have gone through another within a step, all positions on straight ways (theory.md, eq.
/// 4.43 and 4.44).
class SurfaceCrossing {
 public:
  using Point = Vec<Real, 2>;

  /// Nodes go against `surface`, from the displacements `from` to those of `to`.
  SurfaceCrossing(const Surface& surface, const Field& from, const Field& to)
      : surface_(surface), from_(from), to_(to), tree_(surface.size(), [&](std::size_t f) { return swept(f); }) {}

  /// Whether a node has gone in and is no longer where contact would lead it back: it lies deeper than a quarter of the
  /// wall, or has come out at the other side of it. A surface's own node does not meet the facets next to it.
  bool passed(Index node) const {
    const Point p0 = surface_.position(from_, node), p1 = surface_.position(to_, node);
    bool gone = false;
    tree_.for_each_in({p0.cwiseMin(p1), p0.cwiseMax(p1)}, [&](std::size_t f) {
      if (gone || surface_.near(node, f)) return;
      if (enters(p0, p1, f)) gone = lost(node, p1, f);
    });
    return gone;
  }

 private:
  static Real cross(const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; }
  FacetTree::Box swept(std::size_t f) const {
    const FacetTree::Box a = surface_.box(from_, f, 0), b = surface_.box(to_, f, 0);
    return {a.low.cwiseMin(b.low), a.high.cwiseMax(b.high)};
  }
  // Whether the way from p0 to p1 goes in through a facet, and not out of it again. On which side of the facet the node
  // is, is a quadratic function of the part of the way.
  bool enters(const Point& p0, const Point& p1, std::size_t f) const {
    const auto& ends = surface_.facet(f);
    const Point a0 = surface_.position(from_, ends[0]), b0 = surface_.position(from_, ends[1]),
                a1 = surface_.position(to_, ends[0]), b1 = surface_.position(to_, ends[1]);
    const Point w0 = minus(b0, a0), dw = minus(minus(b1, a1), w0), r0 = minus(p0, a0), dr = minus(minus(p1, a1), r0);
    const Real c = cross(w0, r0), b = cross(w0, dr) + cross(dw, r0), a = cross(dw, dr);  // positive inside
    int inside = 0;
    const auto consider = [&](Real t) {
      if (!(t >= 0 && t <= 1)) return;
      Point w = w0, r = r0;
      add(w, dw, t);
      add(r, dr, t);
      const Real xi = contraction(r, w) / contraction(w, w);
      if (xi < 0 || xi > 1) return;
      inside += b + 2 * a * t > 0 ? 1 : -1;
    };
    const Real root = b * b - 4 * a * c;
    if (root < 0) return false;
    const Real q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    if (q != 0) consider(c / q);
    if (a != 0) consider(q / a);
    return inside > 0;
  }
  // Whether a node that went in through a facet has left the place where that would lead it back.
  bool lost(Index node, const Point& p, std::size_t through) const {
    Real nearest = std::numeric_limits<Real>::infinity(), gap = 0;
    std::size_t at = through;
    const Real reach = surface_.length(through) + surface_.deepest(through);
    const Point margin(reach, reach);
    tree_.for_each_in({p - margin, p + margin}, [&](std::size_t f) {
      if (surface_.near(node, f)) return;
      const auto& ends = surface_.facet(f);
      const Point a = surface_.position(to_, ends[0]), w = minus(surface_.position(to_, ends[1]), a), r = minus(p, a);
      const Real xi = std::clamp(contraction(r, w) / contraction(w, w), Real(0), Real(1));
      Point away = r;
      add(away, w, -xi);
      const Real distance = away.norm();
      if (!(distance < nearest)) return;
      nearest = distance;
      gap = -cross(w, r) / w.norm();
      at = f;
    });
    if (!(nearest <= reach)) return true;
    if (contraction(surface_.normal(to_, at), surface_.normal(to_, through)) < 0) return true;
    return -gap > 0.5 * surface_.deepest(at);
  }

  const Surface& surface_;
  const Field &from_, &to_;
  FacetTree tree_;
};

}  // namespace stickslip
