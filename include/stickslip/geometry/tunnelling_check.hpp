// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/geometry/poses_along.hpp>
#include <stickslip/geometry/surface_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace stickslip::rigid {

/// Whether a point has passed through a tool within a step (theory.md, eq. 4.20-4.22).
template <int dim, class Tool>
class TunnellingCheck {
 public:
  using V = Vec<Real, dim>;

  /// Searches the path in the tool's frame, at the poses along the step, for a position deeper inside the tool than
  /// both ends. A position deeper by less than `finest` [length] may be missed.
  TunnellingCheck(const Tool& tool, const PosesAlong<dim>& poses, Real finest)
      : tool_(tool), poses_(poses), finest_(finest) {}

  /// Checks the path from x by u [length] with the gaps `first` and `last` at its ends [length]. A point that `touches`
  /// at the end may have gone around a convex tool instead of through it.
  FailureCause operator()(const V& x, const V& u, Real first, Real last, bool touches) {
    x_ = x;
    u_ = u;
    depth_ = finest_ + std::max({0.0, -first, -last});
    const std::size_t parts = poses_.size() - 1;
    Real length = 0;
    V here = at(0);
    for (std::size_t i = 1; i <= parts; ++i) {
      const V next = at(i);
      length += (next - here).norm();
      here = next;
    }
    if (length <= first + last + 2 * depth_) return FailureCause::none;

    Real gap = first, least = first;
    here = at(0);
    for (std::size_t i = 1; i <= parts && least >= -depth_; ++i) {
      const V next = at(i);
      const Real there = i == parts ? last : distance_to<Real, dim>(tool_, next).gap;
      least = there >= -depth_ ? least_gap(here, gap, next, there) : there;
      here = next;
      gap = there;
    }
    if (least >= -depth_) return FailureCause::none;
    if (!std::isfinite(least)) return FailureCause::not_finite;
    // A path around the tool is replaced by its chord.
    if (touches && entered().dot(distance_to<Real, dim>(tool_, at(parts)).normal) > -1e-3) return FailureCause::none;
    return FailureCause::tunnelled;
  }

 private:
  // Position of the point at pose i, in the tool's frame.
  V at(std::size_t i) const { return poses_[i].pose.on_tool(x_ + poses_[i].share * u_); }

  // The gap of a position below -depth_ on the straight path from a to b with the end gaps gap_a and gap_b, else the
  // smallest gap found; NaN where the tool has no gap.
  Real least_gap(const V& a, Real gap_a, const V& b, Real gap_b) const {
    // The gap changes by no more than the path length.
    if ((b - a).norm() <= std::max(finest_, gap_a + gap_b + 2 * depth_)) return std::min(gap_a, gap_b);
    const V middle = 0.5 * (a + b);
    const Real gap = distance_to<Real, dim>(tool_, middle).gap;
    if (!(gap >= -depth_)) return gap;
    const Real first = least_gap(a, gap_a, middle, gap);
    return first >= -depth_ ? std::min(first, least_gap(middle, gap, b, gap_b)) : first;
  }

  // The tool's normal where the path enters it.
  V entered() const {
    SurfacePoint<Real, dim> point = distance_to<Real, dim>(tool_, at(0));
    for (std::size_t i = 0; i + 1 < poses_.size(); ++i) {
      const V a = at(i), b = at(i + 1);
      const Real length = (b - a).norm();
      for (Real s = 0; s < length && point.gap > 0; s += std::max(point.gap, 0.5 * finest_))
        point = distance_to<Real, dim>(tool_, a + s / length * (b - a));
    }
    return point.normal;
  }

  const Tool& tool_;
  const PosesAlong<dim>& poses_;
  Real finest_, depth_ = 0;  // [length]
  V x_, u_;
};

}  // namespace stickslip::rigid
