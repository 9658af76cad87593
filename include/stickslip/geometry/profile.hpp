// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace stickslip::rigid {

/// Rigid tool surface in the plane: a chain of straight lines and circular arcs, oriented so that **the body is on the
/// left** and the tool's material on the right. The outward normal points left. In axisymmetry it is the meridian of a
/// surface of revolution. Create one with `path`, `line`, `disc` or `rounded`.
///
/// The closest point is searched over the whole chain and is continuous across joints with a common tangent. At a sharp
/// corner that protrudes towards the body the gap is positive all around; at a re-entrant corner penetration is the
/// distance to the corner. Past an open end there is no contact.
class Profile {
 public:
  /// Begins at `start` [length] in the direction `heading`. Throws std::invalid_argument if one of them is invalid.
  Profile(const Vec<Real, 2>& start, const Vec<Real, 2>& heading) : end_(start), heading_(heading) {
    if (!(heading.norm() > 0) || !is_finite(heading) || !is_finite(start))
      throw std::invalid_argument("profile: the start must be finite and the heading not zero");
    heading_.normalize();
  }

  /// Appends a straight line of length `length`.
  Profile& straight(Real length) { return add(length, 0); }
  /// Appends an arc that turns right by `angle` [rad]: convex towards the body, such as the fillet of a die.
  Profile& right(Real radius, Real angle) { return add_arc(radius, angle, +1); }
  /// Appends an arc that turns left by `angle` [rad]: concave towards the body.
  Profile& left(Real radius, Real angle) { return add_arc(radius, angle, -1); }
  /// Turns the heading by `angle` [rad], positive to the left: a sharp corner.
  Profile& corner(Real angle) {
    if (!std::isfinite(angle)) throw std::invalid_argument("profile: a corner's angle must be finite");
    heading_ = rotate(heading_, std::cos(angle), std::sin(angle));
    return *this;
  }
  /// Extends the first and the last piece to infinity; throws std::invalid_argument unless both are straight.
  Profile& endless() {
    if (pieces_.empty() || pieces_.front().curvature != 0 || pieces_.back().curvature != 0)
      throw std::invalid_argument("profile: only straight ends can be endless");
    pieces_.front().low = -infinity;
    pieces_.back().high = infinity;
    return *this;
  }
  /// Joins the end to the start; throws std::invalid_argument unless they coincide.
  Profile& close() {
    if (pieces_.empty() || (end_ - position(pieces_.front(), 0)).norm() > 1e-9 * length_)
      throw std::invalid_argument("profile: the chain does not end where it starts");
    period_ = length_;
    const Joint joint = joint_between(heading_, pieces_.front().heading);
    pieces_.back().end_joint = pieces_.front().start_joint = joint;
    return *this;
  }

  bool empty() const { return pieces_.empty(); }
  Real length() const { return length_; }

  /// Difference of two surface coordinates [length], on a closed chain the one of smaller magnitude.
  template <class S>
  S difference(const S& to, const S& from) const {
    S d = to - from;
    if (period_ > 0) d -= S(period_ * std::round(value_of(d) / period_));
    return d;
  }

  /// Closest point to x, in the tool's frame; a NaN gap for an empty chain or an x that is not a number.
  template <class S>
  SurfacePoint<S, 2> closest(const Vec<S, 2>& x) const {
    const Vec<Real, 2> plain(value_of(x[0]), value_of(x[1]));
    const Piece* best = nullptr;
    Real best_distance = infinity;
    Real best_excess = 0;
    for (const Piece& piece : pieces_) {
      Real excess = 0;
      const Real d = distance(piece, plain, excess);
      if (d < best_distance) {
        best_distance = d;
        best_excess = excess;
        best = &piece;
      }
    }
    if (!best) {  // an empty chain, or a point that is not a number
      SurfacePoint<S, 2> nowhere;
      nowhere.gap = S(std::numeric_limits<Real>::quiet_NaN());
      return nowhere;
    }
    const Joint joint = best_excess > 0 ? best->end_joint : best->start_joint;
    if (best_excess != 0 && joint != Joint::smooth)
      return from_corner(x, position(*best, best_excess > 0 ? best->high : best->low),
                         best->offset + (best_excess > 0 ? best->high : best->low), joint);
    return best->curvature == 0 ? from_line(*best, x) : from_arc(*best, x);
  }

  /// Smallest feature size that nodes should resolve [length]: the smallest radius of an arc that is convex towards the
  /// body, the smallest thickness of a wall that ends in two sharp corners, the width of a closed chain, the extent of
  /// an open one. Sharp corners have no size, and re-entrant arcs do not count. Infinite for an infinite line.
  Real smallest_size() const {
    Real size = infinity;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const Piece& p = pieces_[k];
      if (p.curvature > 0) size = std::min(size, 1 / p.curvature);
      if (k == 0 || k + 1 == pieces_.size() || p.curvature != 0) continue;
      const Piece &before = pieces_[k - 1], &after = pieces_[k + 1];
      if (p.start_joint == Joint::standing_out && p.end_joint == Joint::standing_out && before.curvature == 0 &&
          after.curvature == 0 && before.heading.dot(after.heading) < -0.5)
        size = std::min(size, p.high - p.low);
    }
    if (pieces_.empty() || std::isinf(pieces_.front().low)) return size;
    // Widths normal to the straight pieces, and in directions 3 degrees apart.
    Real least = infinity, largest = 0;
    const std::vector<Vec<Real, 2>> points = sample(length_ / 240, 0);
    const auto measure = [&](const Vec<Real, 2>& along) {
      Real low = infinity, high = -infinity;
      for (const Vec<Real, 2>& x : points) {
        low = std::min(low, along.dot(x));
        high = std::max(high, along.dot(x));
      }
      least = std::min(least, high - low);
      largest = std::max(largest, high - low);
    };
    for (int i = 0; i < 60; ++i) measure({std::cos(pi * i / 60), std::sin(pi * i / 60)});
    for (const Piece& p : pieces_)
      if (p.curvature == 0) measure(left_of(p.heading));
    return std::min(size, period_ > 0 ? least : largest);
  }
  /// Largest magnitude of the first coordinate [length]; infinite if an endless piece extends along it.
  Real breadth() const {
    Real largest = 0;
    for (const Piece& p : pieces_)
      if (std::isinf(p.high - p.low) && std::abs(p.heading[0]) > 1e-12) return infinity;
    for (const Vec<Real, 2>& x : sample(length_ / 240, 0)) largest = std::max(largest, std::abs(x[0]));
    return largest;
  }

  /// Points along the chain for plotting: arcs at most `spacing` apart, endless pieces cut at `reach` [length].
  std::vector<Vec<Real, 2>> sample(Real spacing, Real reach) const {
    std::vector<Vec<Real, 2>> points;
    for (const Piece& piece : pieces_) {
      const Real low = std::isinf(piece.low) ? -reach : piece.low, high = std::isinf(piece.high) ? reach : piece.high;
      const int n = piece.curvature == 0 ? 1 : std::max(1, static_cast<int>(std::ceil((high - low) / spacing)));
      for (int i = points.empty() ? 0 : 1; i <= n; ++i) points.push_back(position(piece, low + (high - low) * i / n));
    }
    return points;
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();
  enum class Joint { open, smooth, standing_out, re_entrant };

  struct Piece {
    Vec<Real, 2> start, heading;  // at local coordinate 0
    Real low = 0, high = 0;       // range of the local coordinate
    Real curvature = 0;           // positive: turns right, convex towards the body
    Real offset = 0;              // surface coordinate at the local coordinate 0
    Joint start_joint = Joint::open, end_joint = Joint::open;
  };

  template <class S>
  static Vec<S, 2> rotate(const Vec<S, 2>& v, const S& cosine, const S& sine) {
    return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]};
  }
  static Vec<Real, 2> left_of(const Vec<Real, 2>& v) { return {-v[1], v[0]}; }
  static Vec<Real, 2> centre(const Piece& p) { return p.start - left_of(p.heading) / p.curvature; }

  static Vec<Real, 2> position(const Piece& p, Real s) {
    if (p.curvature == 0) return p.start + s * p.heading;
    const Vec<Real, 2> c = centre(p);
    return c + rotate<Real>(p.start - c, std::cos(p.curvature * s), -std::sin(p.curvature * s));
  }

  static Joint joint_between(const Vec<Real, 2>& before, const Vec<Real, 2>& after) {
    const Real turn = before[0] * after[1] - before[1] * after[0];
    if (std::abs(turn) < 1e-9 && before.dot(after) > 0) return Joint::smooth;
    return turn > 0 ? Joint::re_entrant : Joint::standing_out;
  }

  Profile& add(Real length, Real curvature) {
    if (!(length > 0) || !std::isfinite(length))
      throw std::invalid_argument("profile: every piece needs a positive finite length");
    Piece piece{.start = end_, .heading = heading_, .high = length, .curvature = curvature, .offset = length_};
    if (!pieces_.empty()) {
      const Joint joint = joint_between(last_heading_, heading_);
      pieces_.back().end_joint = piece.start_joint = joint;
    }
    pieces_.push_back(piece);
    end_ = position(piece, length);
    heading_ = rotate<Real>(heading_, std::cos(curvature * length), -std::sin(curvature * length));
    last_heading_ = heading_;
    length_ += length;
    return *this;
  }
  Profile& add_arc(Real radius, Real angle, int turn) {
    if (!(radius > 0) || !std::isfinite(radius))
      throw std::invalid_argument("profile: an arc needs a positive finite radius");
    if (!(angle > 0 && angle <= 2 * pi)) throw std::invalid_argument("profile: an arc's angle must lie in (0, 2 pi]");
    return add(radius * angle, turn / radius);
  }

  // Local coordinate of the point of the (extended) piece closest to x; on an arc measured from its middle, so that it
  // is continuous along the arc.
  template <class S>
  static S local_coordinate(const Piece& p, const Vec<S, 2>& x) {
    using std::atan2;
    if (p.curvature == 0) return (x[0] - S(p.start[0])) * p.heading[0] + (x[1] - S(p.start[1])) * p.heading[1];
    const Real middle = 0.5 * (p.low + p.high);
    const Vec<Real, 2> c = centre(p);
    const Vec<Real, 2> r = position(p, middle) - c;
    const S vx = x[0] - S(c[0]), vy = x[1] - S(c[1]);
    const S along = vx * r[0] + vy * r[1], across = vy * r[0] - vx * r[1];
    if (value_of(along) == 0 && value_of(across) == 0)
      return S(middle);  // at the centre all points of the arc are equally close: take the middle
    return S(middle) - atan2(across, along) / S(p.curvature);
  }

  // Distance of x to the piece; `excess` is the signed length by which its closest point lies past an end.
  static Real distance(const Piece& p, const Vec<Real, 2>& x, Real& excess) {
    const Real s = local_coordinate<Real>(p, x);
    excess = s > p.high ? s - p.high : s < p.low ? s - p.low : 0;
    if (excess != 0) return (x - position(p, std::clamp(s, p.low, p.high))).norm();
    if (p.curvature == 0) return std::abs((x - p.start).dot(left_of(p.heading)));
    return std::abs((x - centre(p)).norm() - 1 / std::abs(p.curvature));
  }

  template <class S>
  static SurfacePoint<S, 2> from_line(const Piece& p, const Vec<S, 2>& x) {
    SurfacePoint<S, 2> at;
    const Vec<Real, 2> n = left_of(p.heading);
    at.gap = (x[0] - S(p.start[0])) * n[0] + (x[1] - S(p.start[1])) * n[1];
    at.normal << S(n[0]), S(n[1]);
    at.surface_coordinate[0] = S(p.offset) + local_coordinate(p, x);
    at.grad_surface << S(p.heading[0]), S(p.heading[1]);
    return at;
  }

  template <class S>
  static SurfacePoint<S, 2> from_arc(const Piece& p, const Vec<S, 2>& x) {
    using std::sqrt;
    SurfacePoint<S, 2> at;
    const Real sign = p.curvature > 0 ? 1 : -1;
    const Vec<Real, 2> c = centre(p);
    const Vec<S, 2> v(x[0] - S(c[0]), x[1] - S(c[1]));
    const S radius = sqrt(v[0] * v[0] + v[1] * v[1]);
    at.surface_coordinate[0] = S(p.offset) + local_coordinate(p, x);
    at.gap = (radius - S(1 / std::abs(p.curvature))) * sign;
    if (value_of(radius) > 0)
      at.normal << v[0] * (S(sign) / radius), v[1] * (S(sign) / radius);
    else {
      const Vec<Real, 2> n = (position(p, 0.5 * (p.low + p.high)) - c).normalized() * sign;
      at.normal << S(n[0]), S(n[1]);
      return at;
    }
    const Vec<S, 2> tangent(at.normal[1], -at.normal[0]);
    const S stretch = S(1) / (S(1) + at.gap * p.curvature);
    for (int i = 0; i < 2; ++i) {
      at.grad_surface[i] = tangent[i] * stretch;
      for (int j = 0; j < 2; ++j) {
        at.hess_gap(i, j) = tangent[i] * tangent[j] * (stretch * p.curvature);
        at.hess_surface[0](i, j) =
            -(tangent[i] * at.normal[j] + at.normal[i] * tangent[j]) * (stretch * stretch * p.curvature);
      }
    }
    return at;
  }

  template <class S>
  static SurfacePoint<S, 2> from_corner(const Vec<S, 2>& x, const Vec<Real, 2>& corner, Real place, Joint joint) {
    using std::sqrt;
    SurfacePoint<S, 2> at;
    const Real sign = joint == Joint::re_entrant ? -1 : 1;
    const Vec<S, 2> v(x[0] - S(corner[0]), x[1] - S(corner[1]));
    const S d = sqrt(v[0] * v[0] + v[1] * v[1]);
    at.gap = d * sign;
    at.surface_coordinate[0] = S(place);
    if (value_of(d) == 0) return at;
    const S inverse = S(sign) / d;
    at.normal << v[0] * inverse, v[1] * inverse;
    const Vec<S, 2> tangent(at.normal[1], -at.normal[0]);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) at.hess_gap(i, j) = tangent[i] * tangent[j] * inverse;
    return at;
  }

  std::vector<Piece> pieces_;
  Vec<Real, 2> end_, heading_, last_heading_ = Vec<Real, 2>::Zero();
  Real length_ = 0;
  Real period_ = 0;
};

/// A chain that begins at `start` [length] in the direction `heading`.
inline Profile path(const Vec<Real, 2>& start, const Vec<Real, 2>& heading) {
  return {start, heading};
}

/// Infinite straight line through `point`; the body is on the left of `direction`.
inline Profile line(const Vec<Real, 2>& point, const Vec<Real, 2>& direction) {
  Profile profile(point, direction);
  profile.straight(direction.norm()).endless();
  return profile;
}

/// Full disc, the body outside; in axisymmetry a sphere (centre on the axis) or a torus.
inline Profile disc(const Vec<Real, 2>& centre, Real radius) {
  Profile profile(centre + Vec<Real, 2>(-radius, 0), {0, 1});
  profile.right(radius, 2 * pi).close();
  return profile;
}

/// Polyline through `points` [length] with every corner rounded to `radius` [length] (0: sharp).
inline Profile rounded(const std::vector<Vec<Real, 2>>& points, Real radius) {
  if (points.size() < 2) throw std::invalid_argument("profile: a polygon line needs at least two points");
  if (!(radius >= 0)) throw std::invalid_argument("profile: the corner radius must not be negative");
  Profile profile(points[0], points[1] - points[0]);
  Real used = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec<Real, 2> edge = points[i] - points[i - 1];
    Real turn = 0, cut = 0;
    if (i + 1 < points.size()) {
      const Vec<Real, 2> next = points[i + 1] - points[i];
      turn = std::atan2(edge[0] * next[1] - edge[1] * next[0], edge.dot(next));
      cut = radius * std::tan(0.5 * std::abs(turn));
    }
    const Real rest = edge.norm() - used - cut;
    if (!(rest > 0))
      throw std::invalid_argument("profile: the corner radius is too large for the edge before point " +
                                  std::to_string(i));
    profile.straight(rest);
    if (turn != 0 && radius > 0)
      turn < 0 ? profile.right(radius, -turn) : profile.left(radius, turn);
    else if (turn != 0)
      profile.corner(turn);
    used = cut;
  }
  return profile;
}

}  // namespace stickslip::rigid
