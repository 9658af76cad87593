// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/pose.hpp>
#include <stickslip/geometry/surface_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip::rigid {

/// The poses of a tool at equal times along a step: five, or so many that it turns by no more than a tenth of a radian
/// from one to the next (at most 256 steps of it). A tool that turns by whole turns between two of five is not seen to.
template <int dim>
void poses_along(const Motion<dim>& motion, Real begin, Real end, std::vector<Pose<dim>>& poses) {
  for (int parts = 4;; parts *= 2) {
    poses.clear();
    Real turn = 0;
    for (int i = 0; i <= parts; ++i) {
      poses.push_back(motion.at(i == parts ? end : begin + (end - begin) * i / parts));
      if (i > 0) turn = std::max(turn, (poses.back().rotation - poses[poses.size() - 2].rotation).norm());
    }
    if (!(turn > 0.1 * std::sqrt(2.0)) || parts >= 256) return;
  }
}

/// Looks along a point's way past a tool, straight pieces in the tool's frame, for a place deeper inside it than
/// `depth`. What lies less than `finest` below that may be missed (theory.md, eq. 4.19).
template <int dim, class Tool>
struct Passage {
  using V = Vec<Real, dim>;
  const Tool& tool;
  Real depth, finest;  ///< [length]

  /// The gap at a place deeper than `depth` on the straight way from a to b, where the gaps are gap_a and gap_b, or the
  /// smaller of these; not a number where the tool has none.
  Real least_gap(const V& a, Real gap_a, const V& b, Real gap_b) const {
    // A distance changes by no more than the way.
    if ((b - a).norm() <= std::max(finest, gap_a + gap_b + 2 * depth)) return std::min(gap_a, gap_b);
    const V middle = 0.5 * (a + b);
    const Real gap = distance_to<Real, dim>(tool, middle).gap;
    if (!(gap >= -depth)) return gap;
    const Real first = least_gap(a, gap_a, middle, gap);
    return first >= -depth ? std::min(first, least_gap(middle, gap, b, gap_b)) : first;
  }

  /// The tool's normal where the way enters it: `way(i)` for i from 0 to `parts`.
  template <class Way>
  V entered(const Way& way, std::size_t parts) const {
    SurfacePoint<Real, dim> at = distance_to<Real, dim>(tool, way(0));
    for (std::size_t i = 0; i < parts; ++i) {
      const V a = way(i), b = way(i + 1);
      const Real length = (b - a).norm();
      for (Real s = 0; s < length && at.gap > 0; s += std::max(at.gap, 0.5 * finest))
        at = distance_to<Real, dim>(tool, a + s / length * (b - a));
    }
    return at.normal;
  }
};

}  // namespace stickslip::rigid
