// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/profile.hpp>
#include <stickslip/geometry/space.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace stickslip::rigid {

/// Rigid surface of revolution: a Profile in the half-plane of the radius (first coordinate, not negative) and the
/// height along the axis (second), revolved about the axis (theory.md, eq. 4.7-4.8). The body is on the left of the
/// meridian, as for every Profile.
///
/// A meridian that crosses the axis must continue past it as its own mirror image: a whole disc for a sphere, both
/// flanks for a cone. A meridian may end on the axis if it meets the axis at a right angle. On the axis the distance is
/// smooth above and below a smooth tip. Elsewhere (inside a cone, on the axis of a cylinder) the closest points form a
/// circle and one of them is taken: the normal is that of a fixed meridian, and the circumferential curvature, which is
/// unbounded there, is left out.
class Revolution {
 public:
  /// The height is measured from `origin` [length] along `axis`, which may have any length. Throws
  /// std::invalid_argument if the origin is not finite or the axis has no direction.
  Revolution(Profile meridian, const Vec<Real, 3>& origin, const Vec<Real, 3>& axis)
      : meridian_(std::move(meridian)),
        origin_(origin),
        axis_(detail::unit(axis, "revolution: the axis")),
        aside_(detail::perpendicular(axis_)) {
    if (!is_finite(origin)) throw std::invalid_argument("revolution: the origin must be finite");
  }

  bool empty() const { return meridian_.empty(); }
  const Profile& meridian() const { return meridian_; }
  /// Smallest feature size that nodes should resolve [length]: the meridian's, or the largest radius (a pin).
  Real smallest_size() const { return std::min(meridian_.smallest_size(), meridian_.breadth()); }

  /// Signed distance at x and its derivatives, in the tool's frame; a NaN gap for an x that is not finite.
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    using std::sqrt;
    const Vec<S, 3> v(x[0] - origin_[0], x[1] - origin_[1], x[2] - origin_[2]);
    const S height = detail::dot(axis_, v);
    const Vec<S, 3> across(v[0] - axis_[0] * height, v[1] - axis_[1] * height, v[2] - axis_[2] * height);
    const Real r = detail::values(across).norm();
    if (!std::isfinite(r) || !std::isfinite(value_of(height))) return detail::nowhere<S>();

    if (const Real near = 1e-6 * meridian_.length(); !(r > near)) {
      // Near the axis n_r / r loses digits, and on it round-off would step past the end of a meridian.
      const auto at = meridian_.closest(Vec<Real, 2>(near, value_of(height)));
      const Real turn = at.hess_gap.trace() * near;
      if (std::abs(at.normal[0] - turn) < 1e-9 && std::abs(turn) < 0.5) return from_tip(at, near, across, height);
      if (!(r > 1e-3 * near)) {
        const S radius = 1e-3 * near + detail::dot(aside_, across);
        return turned<S>(meridian_.closest(Vec<S, 2>(radius, height)), detail::promote<S>(aside_), S(0));
      }
    }
    const S radius = sqrt(detail::dot(across, across));
    return turned<S>(meridian_.closest(Vec<S, 2>(radius, height)),
                     {across[0] / radius, across[1] / radius, across[2] / radius}, S(1) / radius);
  }

 private:
  // Eq. 4.7-4.8. `inverse` is 1 / radius.
  template <class S, class At>
  Distance<S, 3> turned(const At& at, const Vec<S, 3>& e_r, const S& inverse) const {
    const Vec<S, 3> e_z = detail::promote<S>(axis_), e_phi = cross(e_z, e_r);
    Distance<S, 3> out;
    out.gap = at.gap;
    for (int i = 0; i < 3; ++i) out.normal[i] = e_r[i] * at.normal[0] + e_z[i] * at.normal[1];
    out.hess_gap = detail::dyads<S>(e_r, e_z, at.hess_gap(0, 0), at.hess_gap(1, 1), at.hess_gap(0, 1));
    add(out.hess_gap, product_transposed(e_phi, e_phi), S(at.normal[0] * inverse));
    return out;
  }

  // Near the axis above a smooth tip, which is a sphere to fourth order in the radius: `at` is the profile's closest
  // point from (near, height). With h its curvature and m = n_z a, y = h (x - x_axis) + m points from the centre of the
  // sphere to x, in units of the distance from the centre to (near, height). No division by h: it may be zero.
  template <class S, class At>
  Distance<S, 3> from_tip(const At& at, Real near, const Vec<S, 3>& across, const S& height) const {
    using std::sqrt;
    const Real h = at.hess_gap.trace();
    const Real n_z = std::copysign(std::sqrt(1 - (h * near) * (h * near)), at.normal[1]);
    const S rise = height - value_of(height);
    Vec<S, 3> w, y;
    for (int i = 0; i < 3; ++i) {
      w[i] = across[i] + axis_[i] * rise;
      y[i] = w[i] * h + axis_[i] * n_z;
    }
    const S length = sqrt(detail::dot(y, y)), curvature = h / length;
    Distance<S, 3> out;
    out.gap = at.gap + (h * (detail::dot(w, w) - near * near) + 2 * n_z * rise) / (length + 1);
    for (int i = 0; i < 3; ++i) out.normal[i] = y[i] / length;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) out.hess_gap(i, j) = (S(i == j ? 1 : 0) - out.normal[i] * out.normal[j]) * curvature;
    return out;
  }

  Profile meridian_;
  Vec<Real, 3> origin_, axis_, aside_;
};

namespace detail {
inline void positive(Real size, const char* what) {
  if (!(size > 0) || !std::isfinite(size))
    throw std::invalid_argument(std::string(what) + " must be positive and finite");
}
inline void acute(Real angle, const char* what) {
  if (!(angle > 0 && angle < 0.5 * pi)) throw std::invalid_argument(std::string(what) + " must lie in (0, pi/2)");
}
}  // namespace detail

/// Infinite plane through `point` [length]; the body is on the side of `normal`.
inline Revolution plane(const Vec<Real, 3>& point, const Vec<Real, 3>& normal) {
  return {line({0, 0}, {1, 0}), point, normal};
}

/// Sphere, the body outside.
inline Revolution sphere(const Vec<Real, 3>& centre, Real radius) {
  detail::positive(radius, "sphere: the radius");
  return {disc({0, 0}, radius), centre, {0, 0, 1}};
}

/// Spherical cavity, the body inside.
inline Revolution cavity(const Vec<Real, 3>& centre, Real radius) {
  detail::positive(radius, "cavity: the radius");
  return {path({-radius, 0}, {0, -1}).left(radius, 2 * pi).close(), centre, {0, 0, 1}};
}

/// Infinite circular cylinder about `axis` through `point`, the body outside.
inline Revolution cylinder(const Vec<Real, 3>& point, const Vec<Real, 3>& axis, Real radius) {
  detail::positive(radius, "cylinder: the radius");
  return {line({radius, 0}, {0, -1}), point, axis};
}

/// Infinite cylindrical bore about `axis` through `point`, the body inside.
inline Revolution tube(const Vec<Real, 3>& point, const Vec<Real, 3>& axis, Real radius) {
  detail::positive(radius, "tube: the radius");
  return {line({radius, 0}, {0, 1}), point, axis};
}

/// Infinite cone that opens from `apex` along `axis`, the body outside. `half_angle` [rad] between axis and flank.
inline Revolution cone(const Vec<Real, 3>& apex, const Vec<Real, 3>& axis, Real half_angle) {
  detail::acute(half_angle, "cone: the half angle");
  const Real s = std::sin(half_angle), c = std::cos(half_angle);
  return {path({s, c}, {-s, -c}).straight(1).corner(2 * half_angle - pi).straight(1).endless(), apex, axis};
}

/// Infinite conical cavity that opens from `apex` along `axis`, the body inside.
inline Revolution funnel(const Vec<Real, 3>& apex, const Vec<Real, 3>& axis, Real half_angle) {
  detail::acute(half_angle, "funnel: the half angle");
  const Real s = std::sin(half_angle), c = std::cos(half_angle);
  return {path({-s, c}, {s, -c}).straight(1).corner(pi - 2 * half_angle).straight(1).endless(), apex, axis};
}

/// Torus about `axis`: a circle of radius `minor` swept along one of radius `major`; the body outside.
inline Revolution torus(const Vec<Real, 3>& centre, const Vec<Real, 3>& axis, Real major, Real minor) {
  detail::positive(minor, "torus: the minor radius");
  if (!(major > minor) || !std::isfinite(major))
    throw std::invalid_argument("torus: the major radius must be finite and larger than the minor one");
  return {disc({major, 0}, minor), centre, axis};
}

}  // namespace stickslip::rigid
