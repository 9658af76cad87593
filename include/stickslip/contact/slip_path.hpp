// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/poses_along.hpp>
#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip {

/// A node at the converged state that a step departs from.
template <int dim>
struct Departure {
  Vec<Real, dim> x = Vec<Real, dim>::Zero();  ///< in space [length]
  bool touching = false;
};

/// The way of a node's place on a tool over a step, as it is seen at the end of it (theory.md, eq. 4.23-4.25).
template <int dim>
struct FollowedSlide {
  static constexpr int m = surface_coordinates<dim>;

  Vec<Real, m> traction = Vec<Real, m>::Zero();        ///< t_F of the departure, carried along the way [force]
  Vec<Real, m> slip_increment = Vec<Real, m>::Zero();  ///< sum of the pieces of the way, carried along [length]
  Vec<Real, m> last = Vec<Real, m>::Zero();            ///< the last of them that is not nothing [length]
  Real length = 0;                                     ///< of the way [length]
  Real peak = 0;       ///< largest friction force on the way of a node that sticks throughout [force]
  bool finite = true;  ///< whether the tool tells where the node is, all the way
};

namespace detail {
// Carries a vector of the tangent plane at the normal a to that at the normal b, by the rotation that takes a to b.
inline Vec<Real, 3> carried(const Vec<Real, 3>& v, const Vec<Real, 3>& a, const Vec<Real, 3>& b) {
  const Real cosine = contraction(a, b), along = contraction(b, v);
  Vec<Real, 3> r = minus(v, scaled(b, along));
  if (cosine > -0.99) r = minus(v, scaled(Vec<Real, 3>(a + b), along / (1 + cosine)));  // a jump has no such rotation
  return r;
}
// Turns a chord into the tangent plane at its end, its length kept.
inline Vec<Real, 3> laid_flat(const Vec<Real, 3>& chord, const Vec<Real, 3>& normal) {
  const Vec<Real, 3> flat = minus(chord, scaled(normal, contraction(normal, chord)));
  const Real square = contraction(flat, flat);
  return square > 0 ? scaled(flat, std::sqrt(contraction(chord, chord) / square)) : flat;
}
}  // namespace detail

/// Follows a node's place on a tool over the poses of a step, to the point `end` that it is seen at in the last one. On
/// its own way the node goes straight, from the departure by u. A node that did not touch slides from where its gap
/// closes. `stiffness` is that of sticking.
template <int dim, class Tool>
FollowedSlide<dim> follow_slide(const Tool& tool, const rigid::PosesAlong<dim>& along, const Departure<dim>& from,
                                const Vec<Real, dim>& u, const SurfacePoint<Real, dim>& end,
                                const Vec<Real, surface_coordinates<dim>>& old_traction,
                                const Vec<Real, surface_coordinates<dim>>& old_place, Real stiffness) {
  constexpr int m = surface_coordinates<dim>;
  FollowedSlide<dim> way;
  way.traction = old_traction;
  Vec<Real, m> place = old_place;
  [[maybe_unused]] Vec<Real, dim> normal = end.normal;
  if constexpr (dim == 3) normal = distance_to<Real, dim>(tool, along[0].pose.on_tool(from.x)).normal;
  for (std::size_t i = 1; i < along.size(); ++i) {
    SurfacePoint<Real, dim> at;
    if (i + 1 == along.size()) {
      at = end;
    } else {
      Vec<Real, dim> x = from.x;
      add(x, u, along[i].share);
      x = along[i].pose.on_tool(x);
      at = distance_to<Real, dim>(tool, x);
      if constexpr (dim == 3) at.surface_coordinate = minus(x, scaled(at.normal, at.gap));
    }
    way.finite = way.finite && std::isfinite(at.gap);
    // Until the tool comes to it a node rests, if not on the line to where the tool takes it.
    if (!from.touching && at.gap > 0 && distance_to<Real, dim>(tool, along[i].pose.on_tool(from.x)).gap > 0) {
      way.slip_increment.setZero();
      way.length = way.peak = 0;
    } else {
      Vec<Real, m> piece = relative_displacement<Real, dim>(tool, at.surface_coordinate, place);
      if constexpr (dim == 3) {
        piece = detail::laid_flat(piece, at.normal);
        way.slip_increment = detail::carried(way.slip_increment, normal, at.normal);
        way.traction = detail::carried(way.traction, normal, at.normal);
      }
      const Real square = contraction(piece, piece);
      if (square > 0) way.last = piece;
      add(way.slip_increment, piece);
      way.length += std::sqrt(square);
      Vec<Real, m> trial = way.traction;
      add(trial, way.slip_increment, stiffness);
      way.peak = std::max(way.peak, trial.norm());
    }
    place = at.surface_coordinate;
    normal = at.normal;
  }
  return way;
}

/// How far the way of a node departs from the slide that stands for it, over what is allowed (theory.md, eq. 4.26 and
/// 4.27): above 1 the step must be shorter. What departs by less than `finest` is let pass. `own` is the node's own way
/// in space; where it is that of a node that rides on the tool, the tool tells nothing.
template <int dim>
Real turn_of_slide(const FollowedSlide<dim>& way, bool sliding, Real bound, Real stiffness, Real finest, Real own) {
  constexpr Real widest = 0.15, most_lost = 0.02, in_the_stick = 0.04;
  if (!(bound > 0)) return 0;
  const Real unseen = std::max(in_the_stick * bound / stiffness, finest);
  if (!sliding) return way.peak - bound > stiffness * std::max(unseen, 0.25 * own) ? 2 : 0;
  const Real size = way.slip_increment.norm(), lost = way.length - size;
  if (lost <= std::max(unseen, 1e-12 * way.length) || way.length <= 0.25 * own) return 0;
  const Real along = contraction(way.slip_increment, way.last) / (size * way.last.norm());
  const Real angle = size > 0 ? std::acos(std::clamp(along, -1.0, 1.0)) : pi;
  return std::max(angle / widest, std::sqrt(lost / (most_lost * way.length)));
}

/// The slip paths of a pair's nodes over a step in which the tool turns, or moves to and fro (theory.md, section 4.7).
template <int dim>
class SlipPaths {
 public:
  static constexpr int m = surface_coordinates<dim>;

  bool followed() const { return followed_; }
  /// Begins a step; `follow` where its paths are to be followed. `position(k)` is where node k starts, in space.
  template <class States, class Position>
  void begin(bool follow, const States& states, Position&& position) {
    followed_ = follow;
    if (!followed_) return;
    departures_.resize(states.size());
    for (std::size_t k = 0; k < departures_.size(); ++k) departures_[k] = {position(k), states[k].touching};
  }
  /// Follows node k to the point `at`, now at `x` in space: replaces the slip increment and the traction of the old
  /// memory by those that the path carries along. False where the tool does not tell the distance on the way.
  template <class Tool>
  bool follow(std::size_t k, const Tool& tool, const rigid::PosesAlong<dim>& along, const Vec<Real, dim>& x,
              const SurfacePoint<Real, dim>& at, Real stiffness, const Vec<Real, m>& old_coordinate,
              Vec<Real, m>& traction, Vec<Real, m>& slip) {
    own_ = minus(x, departures_[k].x);
    path_ = follow_slide<dim>(tool, along, departures_[k], own_, at, traction, old_coordinate, stiffness);
    slip = path_.slip_increment;
    traction = path_.traction;
    return path_.finite;
  }
  /// How far the path that was followed last departs from its slip increment, over what is allowed (turn_of_slide).
  Real turn(bool sliding, Real bound, Real stiffness, Real finest) const {
    return turn_of_slide<dim>(path_, sliding, bound, stiffness, finest, own_.norm());
  }

 private:
  std::vector<Departure<dim>> departures_;
  FollowedSlide<dim> path_;                      // of the last node
  Vec<Real, dim> own_ = Vec<Real, dim>::Zero();  // its displacement in the step
  bool followed_ = false;
};

}  // namespace stickslip
