// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/segment_foot.hpp>
#include <stickslip/contact/surface.hpp>
#include <stickslip/contact/surface_crossing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace stickslip {

/// A material point of a slave facet.
struct SurfacePointOf {
  Real eta;                           ///< on its facet, from 0 at the first node to 1 at the second
  Real weight;                        ///< reference area, with thickness or circumference [length^2]
  Index start_facet = Surface::none;  ///< of its foot where the step began; none without a foot there
  Real start_place = 0;               ///< place of that foot [length]
  Index tip = Surface::none;          ///< the node that it is, where that touches by its tip alone
};

/// The points of a slave surface against a master surface over a step: where they are, and which master facets they may
/// meet (theory.md, eq. 4.42). Both are functions of the state that the step starts from and of its guess.
template <class Kinematics>
class SurfacePoints {
 public:
  using Point = Vec<Real, 2>;
  /// The closest point of the master.
  struct Closest {
    SegmentFoot foot{};
    Index facet = Surface::none;  ///< none: the point faces no facet
    bool at_end = false;          ///< the foot is at the end of the facets that the point may meet, not of the surface
  };

  SurfacePoints(Surface slave, Surface master, bool self, const Kinematics& kinematics)
      : slave_(std::move(slave)), master_(std::move(master)), self_(self), kinematics_(kinematics) {}

  const Surface& slave() const { return slave_; }
  const Surface& master() const { return master_; }
  bool self() const { return self_; }
  /// Whether the points of a facet count for the node at its first or second end. Where the slave's surface bends they
  /// do only if the facet lies flat on the master: means over one that stands askew would feel the node once it has
  /// sunk in. Where neither facet lies flat the node touches by its tip, a point of its own (theory.md, section 4.8).
  bool counts(std::size_t facet, std::size_t end) const { return counts_[facet][end]; }
  /// The master facets that a slave facet may meet in this step, ascending.
  std::span<const std::size_t> candidates(std::size_t facet) const {
    return part(candidates_, candidate_start_, facet);
  }
  /// Number of the first point of a slave facet, and its points.
  std::size_t first_point(std::size_t facet) const { return point_start_[facet]; }
  std::span<const SurfacePointOf> points(std::size_t facet) const { return part(points_, point_start_, facet); }
  std::size_t point_count() const { return points_.size(); }
  /// Facets farther apart than this meet in no step like the one that is guessed [length].
  Real reach() const { return reach_; }

  /// Makes the points for a step from the displacements u, which is guessed to end at the displacements `guess`.
  void update(const Field& u, const Field& guess) {
    master_.take_places(u);
    reach_ = std::max(slave_.largest_length(u), master_.largest_length(u)) + 2 * relative_motion(u, guess);
    const FacetTree tree(master_.size(), [&](std::size_t g) { return master_.box(u, g, 0); });
    candidates_.clear();
    points_.clear();
    tips_.clear();
    find_creases(u);
    candidate_start_.assign(1, 0);
    point_start_.assign(1, 0);
    for (std::size_t f = 0; f < slave_.size(); ++f) {
      const Point normal = slave_.normal(u, f);
      tree.for_each_in(slave_.box(u, f, reach_), [&](std::size_t g) {
        if (meets(u, f, normal, g)) candidates_.push_back(g);
      });
      std::sort(candidates_.begin() + static_cast<std::ptrdiff_t>(candidate_start_.back()), candidates_.end());
      candidate_start_.push_back(candidates_.size());
      if (!candidates(f).empty()) cut(u, f);
      if (!candidates(f).empty()) look_at_creases(u, f);
      point_start_.push_back(points_.size());
      for (std::size_t q = point_start_[f]; q < points_.size(); ++q) {
        const Closest at = closest(u, f, points_[q].eta);
        points_[q].start_facet = at.facet;
        if (at.facet != Surface::none)
          points_[q].start_place = master_.place(static_cast<std::size_t>(at.facet), at.foot.xi());
      }
    }
  }

  /// The closest point to a point of a slave facet among the facets that this may meet, at the displacements u.
  Closest closest(const Field& u, std::size_t facet, Real eta) const {
    const auto& ends = slave_.facet(facet);
    Point x = scaled(slave_.position(u, ends[0]), 1 - eta);
    add(x, slave_.position(u, ends[1]), eta);
    Closest best;
    Real nearest = std::numeric_limits<Real>::infinity();
    const std::span<const std::size_t> all = candidates(facet);
    for (const std::size_t g : all) {
      const Point a = master_.position(u, master_.facet(g)[0]), b = master_.position(u, master_.facet(g)[1]);
      const Point way = minus(b, a), from = minus(x, a);
      const Real square = contraction(way, way), xi = contraction(from, way) / square;
      const bool before = xi<0, after = xi> 1;
      const Index beyond = before ? master_.previous(g) : after ? master_.next(g) : static_cast<Index>(g);
      if (beyond == Surface::none) {  // past the end of the master there is no contact, but for round-off
        constexpr Real allowed = 1e-6;
        if (xi < -allowed || xi > 1 + allowed) continue;
      }
      if ((before || after) && beyond != Surface::none) {
        const Point v = before ? a : b, away = minus(x, v);
        const Real distance = contraction(away, away);
        if (!(distance < nearest)) continue;
        // Past the facet beyond as well, or that one is closer, whether the point may meet it or not.
        const auto& next = master_.facet(static_cast<std::size_t>(beyond));
        const Point along = minus(master_.position(u, next[1]), master_.position(u, next[0]));
        if (before ? contraction(away, along) < 0 : contraction(away, along) > 0) continue;
        const Point outward = master_.normal(u, g) + master_.normal(u, static_cast<std::size_t>(beyond));
        const bool inside = contraction(away, outward) < 0,
                   at_end = !std::binary_search(all.begin(), all.end(), static_cast<std::size_t>(beyond));
        if (inside && at_end) continue;  // behind a facet that it does not face
        nearest = distance;
        best = {SegmentFoot::at_vertex(x, eta, v, after, inside, scaled(outward, 1 / outward.norm())),
                static_cast<Index>(g), at_end};
      } else {
        const Real across = way[1] * from[0] - way[0] * from[1], distance = across * across / square;
        if (!(distance < nearest)) continue;
        nearest = distance;
        best = {SegmentFoot(x, eta, a, b, master_.places_length(g)), static_cast<Index>(g), false};
      }
    }
    return best;
  }
  /// Way of a point's foot on the master since the step began [length]; false where it had none there, or where the
  /// foot has jumped to another part of the surface.
  bool slip(const SurfacePointOf& point, const Closest& at, Real& way) const {
    if (point.start_facet == Surface::none) return false;
    const auto from = static_cast<std::size_t>(point.start_facet), to = static_cast<std::size_t>(at.facet);
    if (!master_.same_chain(from, to)) return false;
    way = master_.way(to, master_.place(to, at.foot.xi()), point.start_place);
    return std::abs(way) < reach_;  // else it is on another sheet of a fold
  }
  /// The largest motion of the two surfaces against each other between two states [length].
  Real relative_motion(const Field& from, const Field& to) const {
    Point low = Point::Constant(std::numeric_limits<Real>::infinity()), high = -low;
    for (const Surface* surface : {&slave_, &master_})
      for (const Index n : surface->nodes()) {
        const Point d = minus(at_node<2>(to, n), at_node<2>(from, n));
        low = low.cwiseMin(d);
        high = high.cwiseMax(d);
      }
    return minus(high, low).norm();
  }

  /// Lets bodies overlap by a depth, however thin their facets.
  void allow(Real depth) { allowed_ = depth; }
  /// The largest length of a facet at the start.
  Real largest_length() const { return std::max(slave_.largest_length(), master_.largest_length()); }
  /// The node of one surface that lies deepest inside the other body, and its depth there [length]; 0 where none does.
  [[gnu::cold]] std::pair<Index, Real> deepest_start(const Field& u) const {
    std::pair<Index, Real> worst{Surface::none, 0};
    if (self_) return worst;
    const auto look = [&](const Surface& nodes, const Surface& body) {
      const FacetTree tree(body.size(), [&](std::size_t f) { return body.box(u, f, 0); });
      for (const Index n : nodes.nodes())
        if (const Real depth = body.depth(u, nodes.position(u, n), tree); depth > worst.second) worst = {n, depth};
    };
    look(slave_, master_);
    look(master_, slave_);
    return worst;
  }
  /// A node of one surface that has gone through the other within a step, or through its own; or one of a facet with a
  /// point that lies deeper than contact can tell from the other side of the wall, or has come to the end of the facets
  /// that it may meet, beside one that it should. none if there is none.
  Index passed(const Field& from, const Field& to) const {
    if (const Index n = passed(slave_, master_, from, to); n != Surface::none) return n;
    if (!self_)
      if (const Index n = passed(master_, slave_, from, to); n != Surface::none) return n;
    for (std::size_t f = 0; f < slave_.size(); ++f)
      for (const SurfacePointOf& point : points(f)) {
        const Closest at = closest(to, f, point.eta);
        if (at.facet == Surface::none) continue;
        if (-at.foot.gap() > 0.9 * deepest(f, static_cast<std::size_t>(at.facet))) return slave_.facet(f)[0];
        if (!at.at_end || at.foot.gap() > slave_.length(f)) continue;
        const auto g = static_cast<std::size_t>(at.facet);
        const Index beyond = at.foot.xi() > 0.5 ? master_.next(g) : master_.previous(g);
        if (contraction(slave_.normal(to, f), master_.normal(to, static_cast<std::size_t>(beyond))) < -0.1 &&
            !(self_ && (!comes_first(f, static_cast<std::size_t>(beyond)) ||
                        slave_.neighbours(f, static_cast<std::size_t>(beyond)))))
          return slave_.facet(f)[0];
      }
    return Surface::none;
  }

 private:
  Index passed(const Surface& nodes, const Surface& through, const Field& from, const Field& to) const {
    const SurfaceCrossing crossing(through, from, to);
    for (const Index n : nodes.nodes())
      if (crossing.passed(n)) return n;
    return Surface::none;
  }
  // How deep a point of a slave facet may lie behind a master facet.
  Real deepest(std::size_t f, std::size_t g) const {
    return std::max(self_ ? Real(0) : 1.2 * allowed_, std::min(master_.deepest(g), slave_.deepest(f)));
  }
  template <class T>
  static std::span<const T> part(const std::vector<T>& all, const std::vector<std::size_t>& start, std::size_t i) {
    return {all.data() + start[i], start[i + 1] - start[i]};
  }
  // Whether a slave facet may meet a master facet: they look at each other, are within reach, and no wall is between.
  bool meets(const Field& u, std::size_t f, const Point& normal, std::size_t g) const {
    if (self_ && (!comes_first(f, g) || slave_.neighbours(f, g))) return false;
    const Point opposite = master_.normal(u, g);
    if (!(contraction(normal, opposite) < 0)) return false;
    const std::array<Point, 2> s{slave_.position(u, slave_.facet(f)[0]), slave_.position(u, slave_.facet(f)[1])},
        m{master_.position(u, master_.facet(g)[0]), master_.position(u, master_.facet(g)[1])};
    Real nearest = std::numeric_limits<Real>::infinity(), depth = 0;
    const auto consider = [&](const Point& x, const std::array<Point, 2>& of) {
      const Point way = minus(of[1], of[0]);
      const Real xi = std::clamp(contraction(minus(x, of[0]), way) / contraction(way, way), Real(0), Real(1));
      Point to = of[0];
      add(to, way, xi);
      const Point between = &of == &m ? minus(x, to) : minus(to, x);  // from the master to the slave
      const Real distance = between.norm();
      if (!(distance < nearest)) return;
      nearest = distance;
      depth = -contraction(between, opposite);
    };
    for (const Point& x : {s[0], s[1], Point(scaled(Point(s[0] + s[1]), Real(0.5)))}) consider(x, m);
    for (const Point& x : m) consider(x, s);
    return nearest < reach_ && depth < deepest(f, g);
  }
  // Of a pair in contact with itself the slave: the facet at a crease, whose tip it feels, else the first along the
  // side.
  bool comes_first(std::size_t f, std::size_t g) const { return creased_[f] != creased_[g] ? creased_[f] : f < g; }
  static constexpr Real crease = 0.87, flat = 0.94;  // cosines of 30 and 20 degrees
  bool bends(const Field& u, std::size_t f, Index beyond) const {
    return beyond != Surface::none &&
           contraction(slave_.normal(u, f), slave_.normal(u, static_cast<std::size_t>(beyond))) < crease;
  }
  void find_creases(const Field& u) {
    creased_.resize(slave_.size());
    counts_.assign(slave_.size(), {true, true});
    for (std::size_t f = 0; f < slave_.size(); ++f)
      creased_[f] = bends(u, f, slave_.next(f)) || bends(u, f, slave_.previous(f));
  }
  // Looks whether a facet lies flat on the master at its ends where the surface bends; where neither facet there does,
  // the first of them adds a point for the tip.
  void look_at_creases(const Field& u, std::size_t f) {
    if (!creased_[f]) return;
    for (const std::size_t end : {std::size_t(0), std::size_t(1)}) {
      const Index beyond = end == 1 ? slave_.next(f) : slave_.previous(f), node = slave_.facet(f)[end];
      if (!bends(u, f, beyond)) continue;
      const Closest at = closest(u, f, Real(end));
      if (at.facet == Surface::none) continue;
      const Point normal = master_.normal(u, static_cast<std::size_t>(at.facet));
      const auto other = static_cast<std::size_t>(beyond);
      if (contraction(slave_.normal(u, f), normal) < -flat) continue;
      counts_[f][end] = false;
      if (contraction(slave_.normal(u, other), normal) < -flat) continue;
      if (std::find(tips_.begin(), tips_.end(), node) != tips_.end()) continue;
      tips_.push_back(node);
      points_.push_back({.eta = Real(end), .weight = tributary(f, node) + tributary(other, node), .tip = node});
    }
  }
  // Reference area of a facet that one of its nodes carries.
  Real tributary(std::size_t f, Index node) const {
    const auto& ends = slave_.facet(f);
    const Index from = ends[0] == node ? ends[1] : ends[0];
    Point third = scaled(slave_.reference(node), Real(2) / 3);
    add(third, slave_.reference(from), Real(1) / 3);
    return 0.5 * slave_.length(f) * kinematics_.volume_factor(third);
  }
  // Cuts a slave facet where nodes of the master project on it, two Gauss points a piece.
  void cut(const Field& u, std::size_t f) {
    const auto& ends = slave_.facet(f);
    const Point a = slave_.position(u, ends[0]), way = minus(slave_.position(u, ends[1]), a);
    const Real square = contraction(way, way);
    cuts_.assign({0, 1});
    for (const std::size_t g : candidates(f))
      for (const Index n : master_.facet(g)) {
        const Real eta = contraction(minus(master_.position(u, n), a), way) / square;
        if (eta > 0 && eta < 1) cuts_.push_back(eta);
      }
    std::sort(cuts_.begin(), cuts_.end());
    const Point A = slave_.reference(ends[0]), W = minus(slave_.reference(ends[1]), A);
    for (std::size_t c = 0; c + 1 < cuts_.size(); ++c) {
      const Real width = cuts_[c + 1] - cuts_[c];
      if (width < 1e-9) continue;
      const Real middle = cuts_[c] + 0.5 * width, off = 0.5 * width / std::sqrt(Real(3));
      for (const Real eta : {middle - off, middle + off}) {
        Point X = A;
        add(X, W, eta);
        points_.push_back({.eta = eta, .weight = 0.5 * width * slave_.length(f) * kinematics_.volume_factor(X)});
      }
    }
  }

  Surface slave_, master_;
  bool self_;
  Kinematics kinematics_;
  std::vector<std::size_t> candidates_, candidate_start_, point_start_;
  std::vector<SurfacePointOf> points_;
  std::vector<Real> cuts_;
  std::vector<bool> creased_;  // facets of the slave
  std::vector<std::array<bool, 2>> counts_;
  std::vector<Index> tips_;  // of this step
  Real reach_ = 0, allowed_ = 0;
};

}  // namespace stickslip
