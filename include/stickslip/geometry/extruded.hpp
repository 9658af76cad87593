// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/profile.hpp>
#include <stickslip/geometry/space.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace stickslip::rigid {

/// Rigid cylindrical surface: a Profile in the plane of two directions, swept infinitely along the normal of the plane
/// (theory.md, eq. 4.9): drawbeads, rollers, plane-strain tools in three dimensions. Viewed against the sweep direction
/// first x second the body is on the left of the section.
class Extruded {
 public:
  /// The section's coordinates are measured from `origin` [length] along `first` and `second`, which must be orthogonal
  /// and may have any length. Throws std::invalid_argument, naming the wrong argument.
  Extruded(Profile section, const Vec<Real, 3>& origin, const Vec<Real, 3>& first, const Vec<Real, 3>& second)
      : section_(std::move(section)), origin_(origin), first_(detail::unit(first, "extruded: the first direction")) {
    const Vec<Real, 3> v = detail::unit(second, "extruded: the second direction");
    if (!is_finite(origin)) throw std::invalid_argument("extruded: the origin must be finite");
    if (!(std::abs(v.dot(first_)) < 1e-6))
      throw std::invalid_argument("extruded: the two directions must be at a right angle");
    second_ = (v - v.dot(first_) * first_).normalized();
  }

  bool empty() const { return section_.empty(); }
  const Profile& section() const { return section_; }
  /// Smallest feature size that nodes should resolve [length]: that of the section.
  Real smallest_size() const { return section_.smallest_size(); }

  /// Signed distance at x and its derivatives, in the tool's frame; a NaN gap for an x that is not finite.
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    const Vec<S, 3> v(x[0] - origin_[0], x[1] - origin_[1], x[2] - origin_[2]);
    const Vec<S, 3> e = detail::promote<S>(first_), f = detail::promote<S>(second_);
    if (!is_finite(detail::values(v))) return detail::nowhere<S>();
    const auto at = section_.closest(Vec<S, 2>(detail::dot(e, v), detail::dot(f, v)));
    Distance<S, 3> out;
    out.gap = at.gap;
    for (int i = 0; i < 3; ++i) out.normal[i] = e[i] * at.normal[0] + f[i] * at.normal[1];
    out.hess_gap = detail::dyads<S>(e, f, at.hess_gap(0, 0), at.hess_gap(1, 1), at.hess_gap(0, 1));
    return out;
  }

 private:
  Profile section_;
  Vec<Real, 3> origin_, first_, second_;
};

}  // namespace stickslip::rigid
