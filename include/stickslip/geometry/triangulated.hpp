// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/space.hpp>
#include <stickslip/geometry/triangles.hpp>

// Boost 1.74's R-tree includes a deprecated header of Boost's own, which warns in every translation unit.
#pragma push_macro("BOOST_ALLOW_DEPRECATED_HEADERS")
#undef BOOST_ALLOW_DEPRECATED_HEADERS
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_point_box.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#pragma pop_macro("BOOST_ALLOW_DEPRECATED_HEADERS")

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip::rigid {

/// Rigid tool of triangles, curved by Nagata's quadratic patches through the vertices and their normals (theory.md,
/// eq. 4.10-4.12). A vertex normal is the mean of its triangles' normals with Max's weights, unless given. Edges whose
/// triangles meet at more than the crease angle are sharp, with separate normals on each side.
///
/// The closest point is searched over all patches. Patches meet along common curves; across a smooth edge gap and
/// normal jump by no more than the difference of the patches' normals there, of second order in the triangle size: in
/// the sliver between the normals of both sides one of the patches is extended past its edge. At a sharp edge that
/// protrudes towards the body the gap is positive all around; at a re-entrant edge penetration is the distance to the
/// edge. Past an open edge there is no contact. A patch that would be folded (normals that do not fit the triangle)
/// gets straight edges.
class Triangulated {
 public:
  /// `crease` [rad]: edges with a larger angle are sharp; with normals given all edges between triangles are smooth.
  /// Throws std::invalid_argument, naming the triangle (counted from 0), if there are none, if one is degenerate, has
  /// an invalid vertex or normal, or traverses an edge in the same direction as its neighbour.
  explicit Triangulated(const Triangles& surface, Real crease = pi / 4) {
    check(surface);
    if (!(crease >= 0)) throw std::invalid_argument("triangulated: the crease angle must not be negative");
    build(surface, crease);
    std::vector<Leaf> leaves;
    leaves.reserve(patches_.size());
    for (std::size_t i = 0; i < patches_.size(); ++i) leaves.emplace_back(box_of(patches_[i]), i);
    tree_ = Tree(leaves);  // built at once: a packed tree
  }

  bool empty() const { return patches_.empty(); }
  /// Number of triangles.
  Index size() const { return static_cast<Index>(patches_.size()); }
  /// Smallest feature size that nodes should resolve [length]: the shortest edge of the bounding box of a closed
  /// surface, the longest of an open one.
  Real smallest_size() const {
    V low = patches_[0].x[0], high = low;
    bool closed = true;
    for (const Patch& patch : patches_)
      for (std::size_t k = 0; k < 3; ++k) {
        low = low.cwiseMin(patch.x[k]);
        high = high.cwiseMax(patch.x[k]);
        closed = closed && patch.edge[k] != Rim::open;
      }
    return closed ? (high - low).minCoeff() : (high - low).maxCoeff();
  }

  /// Signed distance at x and its derivatives, in the tool's frame; a NaN gap for an x that is not finite.
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    const V plain = detail::values(x);
    if (!is_finite(plain)) return detail::nowhere<S>();
    // The nearest box limits the distance; then all boxes within this distance. (Boost 1.74's incremental nearest query
    // sorts its candidates at every leaf.)
    namespace tree = boost::geometry::index;
    Foot best;
    tree_.query(tree::nearest(Point(plain[0], plain[1], plain[2]), 1),
                boost::make_function_output_iterator([&](const Leaf& leaf) { consider(leaf.second, plain, best); }));
    const V reach = V::Constant(best.distance * (1 + tie)), low = plain - reach, high = plain + reach;
    tree_.query(
        tree::intersects(Box(Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2]))),
        boost::make_function_output_iterator([&](const Leaf& leaf) {
          const Real least = best.distance * (1 + tie);
          if (distance_to(leaf.first, plain) <= least && distance_at_least(patches_[leaf.second], plain) <= least)
            consider(leaf.second, plain, best);
        }));
    return seen(best, x);
  }

  /// The same without the search tree, over all triangles, to verify the search.
  template <class S>
  Distance<S, 3> distance_by_all(const Vec<S, 3>& x) const {
    const V plain = detail::values(x);
    if (!is_finite(plain)) return detail::nowhere<S>();
    Foot best;
    for (std::size_t i = 0; i < patches_.size(); ++i) consider(i, plain, best);
    return seen(best, x);
  }

 private:
  using V = Vec<Real, 3>;
  using V2 = Vec<Real, 2>;
  using Point = boost::geometry::model::point<Real, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Point>;
  using Leaf = std::pair<Box, std::size_t>;
  using Tree = boost::geometry::index::rtree<Leaf, boost::geometry::index::rstar<8>>;

  static constexpr Real tie = 1e-12;    // relative difference below which distances are equal
  static constexpr Real on_rim = 1e-9;  // overshoot past an edge at which a foot belongs to the patch [edge lengths]
  static constexpr Real led_on = 0.25;  // overshoot to which a patch is extended past a smooth edge [edge lengths]
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  enum class Rim { smooth, sharp, open };

  struct Patch {
    std::array<V, 3> x, c;           // corners; Nagata's vectors of the edges k to k + 1
    std::array<V, 3> corner_normal;  // angle-weighted mean of all triangles at the corner, for the sign
    std::array<Rim, 3> edge{}, corner{};
    std::array<std::size_t, 3> other{none, none, none};  // 3 * neighbour + its edge
  };

  // Point of a patch at lambda = (1 - u - v, u, v) and its derivatives (eq. 4.11). Second derivatives are constant.
  template <class S>
  struct Local {
    Vec<S, 3> p, p_u, p_v;
    V p_uu, p_uv, p_vv;
    Local(const Patch& patch, const S& u, const S& v)
        : p_uu(2 * patch.c[0]), p_uv(patch.c[0] + patch.c[2] - patch.c[1]), p_vv(2 * patch.c[2]) {
      const S w = S(1) - u - v;
      for (int i = 0; i < 3; ++i) {
        const Real d1 = patch.x[1][i] - patch.x[0][i], d2 = patch.x[2][i] - patch.x[0][i];
        const Real c0 = patch.c[0][i], c1 = patch.c[1][i], c2 = patch.c[2][i];
        p[i] = patch.x[0][i] + d1 * u + d2 * v - c0 * (w * u) - c1 * (u * v) - c2 * (v * w);
        p_u[i] = d1 - c0 * (w - u) + (c2 - c1) * v;
        p_v[i] = d2 - c2 * (w - v) + (c0 - c1) * u;
      }
    }
    Vec<S, 3> normal() const {
      using std::sqrt;
      const Vec<S, 3> n = cross(p_u, p_v);
      return n / S(sqrt(detail::dot(n, n)));
    }
  };

  // Gradient and Hessian of half the squared distance of x to a patch in (u, v); Gauss-Newton unless `exact`.
  static V2 gradient(const Local<Real>& at, const V& x) {
    const V d = at.p - x;
    return {at.p_u.dot(d), at.p_v.dot(d)};
  }
  static Mat<Real, 2> hessian(const Local<Real>& at, const V& x, bool exact) {
    const V d = exact ? V(at.p - x) : V(V::Zero());
    const Real mixed = at.p_u.dot(at.p_v) + at.p_uv.dot(d);
    Mat<Real, 2> h;
    h << at.p_u.squaredNorm() + at.p_uu.dot(d), mixed, mixed, at.p_v.squaredNorm() + at.p_vv.dot(d);
    return h;
  }
  static Real determinant(const Mat<Real, 2>& h) { return h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0); }
  // Whether the squared distance is convex: the determinants' ratio is the product of the factors 1 + kappa g.
  static bool definite(const Mat<Real, 2>& h, const Mat<Real, 2>& form) {
    return h(0, 0) > 0 && determinant(h) > 1e-6 * determinant(form);
  }
  template <class S>
  static Vec<S, 2> solve(const Mat<Real, 2>& h, const Vec<S, 2>& b) {
    const Real inverse = 1 / determinant(h);
    return {(h(1, 1) * b[0] - h(0, 1) * b[1]) * inverse, (h(0, 0) * b[1] - h(1, 0) * b[0]) * inverse};
  }

  static Real least(const V2& uv) { return std::min({1 - uv[0] - uv[1], uv[0], uv[1]}); }

  // Curve of an edge, q(t) = a + (d - c) t + c t^2.
  struct Curve {
    V a, d, c;
    V at(Real t) const { return a + (d - c) * t + c * (t * t); }
    V slope(Real t) const { return d - c + c * (2 * t); }
  };
  static Curve curve(const Patch& patch, std::size_t k) {
    return {patch.x[k], patch.x[(k + 1) % 3] - patch.x[k], patch.c[k]};
  }
  static V2 on_edge(std::size_t k, Real t) { return k == 0 ? V2(t, 0) : k == 1 ? V2(1 - t, t) : V2(0, 1 - t); }

  // Closest point of a patch, including its rim.
  enum class Part { face, edge, corner };
  struct Foot {
    Real distance = std::numeric_limits<Real>::infinity();
    std::size_t patch = none;
    V2 uv = V2::Zero();
    Part part = Part::face;
    std::size_t k = 0;  // index of the edge or corner
    Real t = 0;         // parameter on the edge
  };

  // Newton's method for the foot on the patch extended past its rim: Gauss-Newton where the distance is not convex, and
  // halved steps where it grows. False if the foot is outside by more than `reach` or does not converge.
  static bool project(const Patch& patch, const V& x, V2& uv, Real reach) {
    const V2 from = uv;
    Local<Real> at(patch, uv[0], uv[1]);
    for (int i = 0; i < 30; ++i) {
      const V2 slope = gradient(at, x);
      const Mat<Real, 2> exact = hessian(at, x, true), form = hessian(at, x, false);
      const bool convex = definite(exact, form);
      V2 step = solve<Real>(convex ? exact : form, -slope);
      const Real size = step.norm(), now = (at.p - x).squaredNorm();
      if (!(size < 1e6)) return false;
      if (size > 1) step /= size;
      for (int halved = 0;; ++halved) {
        const V2 next = uv + step;
        at = Local<Real>(patch, next[0], next[1]);
        if (halved == 8 || size < 1e-6 || !((at.p - x).squaredNorm() > now)) {
          uv = next;
          break;
        }
        step *= 0.5;
      }
      if (least(uv) < -std::max(reach, Real(0.5)) - std::max(Real(0), -least(from))) return false;
      if (size < 1e-13) return convex && least(uv) >= -reach;
      if (size < 1e-8 && convex) {  // quadratic convergence: one more step is exact
        uv += solve<Real>(hessian(at, x, true), -gradient(at, x));
        return least(uv) >= -reach;
      }
    }
    return false;
  }

  // Parameter in [0, 1] of the closest point on an edge's curve: Newton's method in a bracket.
  static Real closest_on(const Curve& q, const V& x) {
    const auto slope = [&](Real t) { return q.slope(t).dot(q.at(t) - x); };
    const Real first = slope(0), last = slope(1);
    if (first >= 0 && last <= 0) return (q.at(0) - x).squaredNorm() <= (q.at(1) - x).squaredNorm() ? 0 : 1;
    if (first >= 0) return 0;
    if (last <= 0) return 1;
    Real low = 0, high = 1, t = std::clamp((x - q.a).dot(q.d) / q.d.squaredNorm(), Real(0), Real(1));
    for (int i = 0; i < 60; ++i) {
      const V d = q.at(t) - x, tangent = q.slope(t);
      const Real f = tangent.dot(d), df = tangent.squaredNorm() + 2 * q.c.dot(d);
      (f < 0 ? low : high) = t;
      Real next = t - f / df;
      if (!(df > 0) || !(next >= low && next <= high)) next = 0.5 * (low + high);
      const Real step = std::abs(next - t);
      t = next;
      if (step < 1e-15) break;
    }
    return t;
  }

  Foot foot_on(std::size_t i, const V& x) const {
    const Patch& patch = patches_[i];
    Foot foot;
    foot.patch = i;
    // Starts from the foot on the flat triangle.
    const V e = patch.x[1] - patch.x[0], f = patch.x[2] - patch.x[0], d = x - patch.x[0];
    Mat<Real, 2> flat;
    flat << e.squaredNorm(), e.dot(f), e.dot(f), f.squaredNorm();
    V2 uv = solve<Real>(flat, V2(e.dot(d), f.dot(d)));
    uv = uv.cwiseMax(0);
    if (uv.sum() > 1) uv /= uv.sum();
    if (project(patch, x, uv, on_rim)) {
      foot.uv = uv;
      foot.distance = (Local<Real>(patch, uv[0], uv[1]).p - x).norm();
      return foot;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Curve q = curve(patch, k);
      const Real t = closest_on(q, x), away = (q.at(t) - x).norm();
      if (!(away < foot.distance)) continue;
      foot.distance = away;
      foot.part = t == 0 || t == 1 ? Part::corner : Part::edge;
      foot.k = t == 1 ? (k + 1) % 3 : k;
      foot.t = t;
      foot.uv = on_edge(k, t);
    }
    return foot;
  }

  // Keeps the nearer foot; of two equally near ones, as on a common edge, that of the lower patch, in any search order.
  void consider(std::size_t i, const V& x, Foot& best) const {
    const Foot foot = foot_on(i, x);
    const bool first = best.patch == none, nearer = foot.distance < best.distance * (1 - tie),
               as_near = foot.distance <= best.distance * (1 + tie);
    if (first || nearer || (as_near && i < best.patch)) best = foot;
  }

  template <class S>
  Distance<S, 3> seen(const Foot& foot, const Vec<S, 3>& x) const {
    if (foot.patch == none) return detail::nowhere<S>();
    const Patch& patch = patches_[foot.patch];
    if (foot.part == Part::face) return from_patch(patch, foot.uv, x);
    const Rim rim = foot.part == Part::edge ? patch.edge[foot.k] : patch.corner[foot.k];
    const V plain = detail::values(x);
    if (rim == Rim::smooth) {
      V2 uv = foot.uv;
      if (project(patch, plain, uv, led_on)) return from_patch(patch, uv, x);
    }
    V out = patch.corner_normal[foot.k];
    if (foot.part == Part::edge) {
      out = Local<Real>(patch, foot.uv[0], foot.uv[1]).normal();
      if (const std::size_t other = patch.other[foot.k]; other != none) {
        const V2 there = on_edge(other % 3, 1 - foot.t);
        out = (out + Local<Real>(patches_[other / 3], there[0], there[1]).normal()).normalized();
      }
    }
    const V p = Local<Real>(patch, foot.uv[0], foot.uv[1]).p;
    const Real sign = rim == Rim::open || out.dot(plain - p) >= 0 ? 1 : -1;
    Curve q{p, V::Zero(), V::Zero()};
    if (foot.part == Part::edge) q = curve(patch, foot.k);
    return from_rim(q, foot.part == Part::edge, foot.t, x, sign, out);
  }

  // Eq. 4.12. (u, v) is the foot of x's value; a last Newton step propagates the derivatives of x to it.
  template <class S>
  static Distance<S, 3> from_patch(const Patch& patch, const V2& uv, const Vec<S, 3>& x) {
    const Local<Real> plain(patch, uv[0], uv[1]);
    const Vec<S, 3> away(plain.p[0] - x[0], plain.p[1] - x[1], plain.p[2] - x[2]);
    const Vec<S, 2> step = solve<S>(hessian(plain, detail::values(x), true),
                                    Vec<S, 2>(detail::dot(plain.p_u, away), detail::dot(plain.p_v, away)));
    const Local<S> at(patch, uv[0] - step[0], uv[1] - step[1]);
    Distance<S, 3> out;
    out.normal = at.normal();
    out.gap = detail::dot(out.normal, Vec<S, 3>(x[0] - at.p[0], x[1] - at.p[1], x[2] - at.p[2]));
    // First and second fundamental form; the gap's Hessian is -J I^-1 II (I - g II)^-1 J^T.
    const S E = detail::dot(at.p_u, at.p_u), F = detail::dot(at.p_u, at.p_v), G = detail::dot(at.p_v, at.p_v);
    const S L = detail::dot(at.p_uu, out.normal), M = detail::dot(at.p_uv, out.normal),
            N = detail::dot(at.p_vv, out.normal);
    const S A = E - out.gap * L, B = F - out.gap * M, C = G - out.gap * N;
    // II (I - g II)^-1, then I^-1 times it, each without its determinant.
    const S k11 = L * C - M * B, k12 = M * A - L * B, k21 = M * C - N * B, k22 = N * A - M * B;
    const S scale = S(-1) / ((E * G - F * F) * (A * C - B * B));
    const S h11 = scale * (G * k11 - F * k21), h22 = scale * (E * k22 - F * k12),
            h12 = scale * 0.5 * (G * k12 - F * k22 + E * k21 - F * k11);
    out.hess_gap = detail::dyads<S>(at.p_u, at.p_v, h11, h22, h12);
    return out;
  }

  // Signed distance to an edge's curve at t, or to a corner. On the edge or corner itself the normal is `out_of`.
  template <class S>
  static Distance<S, 3> from_rim(const Curve& q, bool edge, Real t, const Vec<S, 3>& x, Real sign, const V& out_of) {
    using std::sqrt;
    Distance<S, 3> out;
    Vec<S, 3> p = detail::promote<S>(q.a);
    Mat<S, 3> along = Mat<S, 3>::Zero();
    if (edge) {
      const V tangent = q.slope(t), point = q.at(t);
      const Vec<S, 3> away(point[0] - x[0], point[1] - x[1], point[2] - x[2]);
      const Real change = tangent.squaredNorm() + 2 * q.c.dot(point - detail::values(x));
      const S at = t - detail::dot(tangent, away) / change;
      Vec<S, 3> slope;
      for (int i = 0; i < 3; ++i) {
        p[i] = q.a[i] + (q.d[i] - q.c[i]) * at + q.c[i] * (at * at);
        slope[i] = q.d[i] - q.c[i] + (2 * q.c[i]) * at;
      }
      // Stretch of a parallel curve: 1 - curvature . (x - p).
      const S square = detail::dot(slope, slope);
      const Vec<S, 3> d(x[0] - p[0], x[1] - p[1], x[2] - p[2]);
      const S stretch =
          S(1) - 2 * (detail::dot(q.c, d) - detail::dot(q.c, slope) * detail::dot(slope, d) / square) / square;
      along = scaled<S>(product_transposed(slope, slope), S(1) / (square * stretch));
    }
    const Vec<S, 3> d(x[0] - p[0], x[1] - p[1], x[2] - p[2]);
    const S length = sqrt(detail::dot(d, d));
    if (!(value_of(length) > 0)) {
      out.normal = detail::promote<S>(out_of);
      out.gap = detail::dot(out_of, d);
      return out;
    }
    out.gap = length * sign;
    const S curvature = S(sign) / length;
    for (int i = 0; i < 3; ++i) out.normal[i] = d[i] * curvature;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out.hess_gap(i, j) = (S(i == j ? 1 : 0) - out.normal[i] * out.normal[j] - along(i, j)) * curvature;
    return out;
  }

  // ---- Construction ----

  static std::string name(std::size_t triangle) { return "triangulated: triangle " + std::to_string(triangle); }

  static void check(const Triangles& s) {
    if (s.corners.empty()) throw std::invalid_argument("triangulated: there are no triangles");
    if (!s.normals.empty() && s.normals.size() != s.vertices.size())
      throw std::invalid_argument("triangulated: " + std::to_string(s.normals.size()) + " normals for " +
                                  std::to_string(s.vertices.size()) + " vertices");
    for (std::size_t i = 0; i < s.corners.size(); ++i) {
      for (const Index n : s.corners[i]) {
        if (n < 0 || static_cast<std::size_t>(n) >= s.vertices.size())
          throw std::invalid_argument(name(i) + " names vertex " + std::to_string(n) + ", but there are " +
                                      std::to_string(s.vertices.size()));
        if (!s.vertices[static_cast<std::size_t>(n)].allFinite())
          throw std::invalid_argument(name(i) + " has a vertex that is not finite");
        if (!s.normals.empty() &&
            !(s.normals[static_cast<std::size_t>(n)].norm() > 0 && s.normals[static_cast<std::size_t>(n)].allFinite()))
          throw std::invalid_argument(name(i) + " has a normal that is zero or not finite");
      }
      const V a = vertex(s, i, 0), e = vertex(s, i, 1) - a, f = vertex(s, i, 2) - a;
      const Real longest = std::max({e.squaredNorm(), f.squaredNorm(), (e - f).squaredNorm()});
      if (!(cross(e, f).norm() > 1e-12 * longest))
        throw std::invalid_argument(name(i) + " is degenerate: it has no area");
    }
  }

  static std::size_t number(const Triangles& s, std::size_t i, std::size_t k) {
    return static_cast<std::size_t>(s.corners[i][k % 3]);
  }
  static const V& vertex(const Triangles& s, std::size_t i, std::size_t k) { return s.vertices[number(s, i, k)]; }
  static V facet_normal(const Triangles& s, std::size_t i) {
    const V a = vertex(s, i, 0);
    return cross(V(vertex(s, i, 1) - a), V(vertex(s, i, 2) - a)).normalized();
  }
  // Max's weight of a facet with the edges a and b at a vertex: for vertices on a sphere the mean is the sphere's
  // normal.
  static Real facet_weight(const V& a, const V& b) { return cross(a, b).norm() / (a.squaredNorm() * b.squaredNorm()); }
  static Real angle(const V& a, const V& b) { return std::atan2(cross(a, b).norm(), a.dot(b)); }

  void build(const Triangles& s, Real crease) {
    const std::size_t count = s.corners.size();
    std::vector<V> facet(count);
    for (std::size_t i = 0; i < count; ++i) facet[i] = facet_normal(s, i);

    // Neighbours traverse their common edge in opposite directions.
    patches_.resize(count);
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> walked;  // from, to -> 3 * triangle + edge
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [at, fresh] = walked.insert({{number(s, i, k), number(s, i, k + 1)}, 3 * i + k});
        if (!fresh)
          throw std::invalid_argument(name(i) + " runs along an edge in the same direction as triangle " +
                                      std::to_string(at->second / 3) +
                                      ": one is inside out, or more than two meet at the edge");
      }
    for (const auto& [edge, half] : walked) {
      Patch& patch = patches_[half / 3];
      const std::size_t k = half % 3;
      const auto back = walked.find({edge.second, edge.first});
      patch.edge[k] = Rim::open;
      if (back == walked.end()) continue;
      patch.other[k] = back->second;
      const bool sharp = s.normals.empty() && angle(facet[half / 3], facet[back->second / 3]) > crease;
      patch.edge[k] = sharp ? Rim::sharp : Rim::smooth;
    }

    // Corners connected by smooth edges share a normal.
    std::vector<std::size_t> group(3 * count);
    std::iota(group.begin(), group.end(), std::size_t(0));
    const auto root = [&](std::size_t i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (patches_[i].edge[k] == Rim::smooth) {
          const std::size_t other = patches_[i].other[k], j = other / 3, m = other % 3;
          group[root(3 * i + k)] = root(3 * j + (m + 1) % 3);
          group[root(3 * i + (k + 1) % 3)] = root(3 * j + m);
        }
    std::vector<V> sum(3 * count, V::Zero()), around(s.vertices.size(), V::Zero());
    std::vector<Real> total(3 * count, 0);
    std::vector<Rim> corner(s.vertices.size(), Rim::smooth);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const V a = vertex(s, i, k + 1) - vertex(s, i, k), b = vertex(s, i, k + 2) - vertex(s, i, k);
        const Real weight = facet_weight(a, b);
        sum[root(3 * i + k)] += facet[i] * weight;
        total[root(3 * i + k)] += weight;
        around[number(s, i, k)] += facet[i] * angle(a, b);
        for (const std::size_t n : {number(s, i, k), number(s, i, k + 1)})
          if (corner[n] != Rim::open && patches_[i].edge[k] != Rim::smooth) corner[n] = patches_[i].edge[k];
      }
    const auto normal = [&](std::size_t i, std::size_t k) -> V {
      if (!s.normals.empty()) return s.normals[number(s, i, k)].normalized();
      const std::size_t shared = root(3 * i + k % 3);
      return sum[shared].norm() > 1e-6 * total[shared] ? V(sum[shared].normalized()) : facet[i];
    };

    for (std::size_t i = 0; i < count; ++i) {
      Patch& patch = patches_[i];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!s.normals.empty() && !(normal(i, k).dot(facet[i]) > 0))
          throw std::invalid_argument(name(i) + " is opposed to the normal of its vertex " +
                                      std::to_string(number(s, i, k)));
        patch.x[k] = vertex(s, i, k);
        patch.corner[k] = corner[number(s, i, k)];
        const V n = around[number(s, i, k)];
        patch.corner_normal[k] = n.norm() > 1e-6 ? V(n.normalized()) : facet[i];
        const std::size_t other = patch.other[k];
        if (other != none && other < 3 * i + k) {  // computed for the neighbour
          patch.c[k] = patches_[other / 3].c[other % 3];
          continue;
        }
        const V d = vertex(s, i, k + 1) - vertex(s, i, k);
        patch.c[k] = patch.edge[k] == Rim::sharp
                         ? between(d, normal(i, k), normal(i, k + 1), normal(other / 3, other % 3 + 1),
                                   normal(other / 3, other % 3))
                         : nagata(d, normal(i, k), normal(i, k + 1));
      }
    }
    straighten(facet);
  }

  // Nagata's vector of an edge d with the normals n and m at its ends (eq. 4.10). The part along the edge only
  // reparametrises the curve and is left out where it is large; a curve that turns by more than a right angle becomes
  // straight.
  static V nagata(const V& d, const V& n, const V& m) {
    const V mean = 0.5 * (n + m), half = 0.5 * (n - m);
    const Real mean_square = mean.squaredNorm(), half_square = half.squaredNorm(), square = d.squaredNorm();
    if (!(mean_square > 1e-6)) return V::Zero();
    const V arch = mean * (half.dot(d) / mean_square);
    if (!(arch.squaredNorm() < square)) return V::Zero();
    if (!(half_square > 1e-16)) return arch;
    const V skew = half * (mean.dot(d) / half_square);
    return skew.squaredNorm() < 0.1 * square ? V(arch + skew) : arch;
  }

  // The same for a sharp edge with separate normals on each side: fits both.
  static V between(const V& d, const V& n1, const V& m1, const V& n2, const V& m2) {
    const V a = 0.5 * (n1 + m1), b = 0.5 * (n2 + m2);
    const Real f = 0.5 * (n1 - m1).dot(d), g = 0.5 * (n2 - m2).dot(d);
    Mat<Real, 2> gram;
    gram << a.squaredNorm(), a.dot(b), a.dot(b), b.squaredNorm();
    if (!(determinant(gram) > 0.03)) return V::Zero();  // the crease angle nearly vanishes
    const V2 share = solve<Real>(gram, V2(f, g));
    const V c = a * share[0] + b * share[1];
    return c.squaredNorm() < d.squaredNorm() ? c : V(V::Zero());
  }

  // Straightens the edges of folded patches, on both sides, until none is folded. Flat patches never are.
  void straighten(const std::vector<V>& facet) {
    const std::array<V2, 7> places{V2(0, 0),   V2(1, 0),     V2(0, 1),          V2(0.5, 0),
                                   V2(0, 0.5), V2(0.5, 0.5), V2(1. / 3, 1. / 3)};
    for (bool again = true; again;) {
      again = false;
      for (std::size_t i = 0; i < patches_.size(); ++i) {
        Patch& patch = patches_[i];
        const Real area = cross(V(patch.x[1] - patch.x[0]), V(patch.x[2] - patch.x[0])).norm();
        const bool sound = std::all_of(places.begin(), places.end(), [&](const V2& uv) {
          const Local<Real> at(patch, uv[0], uv[1]);
          return cross(at.p_u, at.p_v).dot(facet[i]) > 0.1 * area;
        });
        if (sound) continue;
        again = true;
        for (std::size_t k = 0; k < 3; ++k) {
          patch.c[k].setZero();
          if (patch.other[k] != none) patches_[patch.other[k] / 3].c[patch.other[k] % 3].setZero();
        }
      }
    }
  }

  // A quadratic patch lies in the convex hull of its Bezier points.
  static Box box_of(const Patch& patch) {
    V low = patch.x[0], high = patch.x[0];
    for (std::size_t k = 0; k < 3; ++k)
      for (const V& p : {patch.x[k], V(0.5 * (patch.x[k] + patch.x[(k + 1) % 3] - patch.c[k]))}) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    return {Point(low[0], low[1], low[2]), Point(high[0], high[1], high[2])};
  }
  static Real distance_to(const Box& box, const V& x) {
    const Point &low = box.min_corner(), &high = box.max_corner();
    const V a(low.get<0>(), low.get<1>(), low.get<2>()), b(high.get<0>(), high.get<1>(), high.get<2>());
    return (x - x.cwiseMax(a).cwiseMin(b)).norm();
  }

  // Lower limit of the distance: to the flat triangle, less the patch's bulge, |sum lambda lambda c| <= max |c| / 3.
  // Far from the tool many boxes are as near as the closest patch, and this costs less than a foot.
  static Real distance_at_least(const Patch& patch, const V& x) {
    const V e = patch.x[1] - patch.x[0], f = patch.x[2] - patch.x[0], d = x - patch.x[0];
    const V n = cross(e, f);
    const Real bulge =
        std::sqrt(std::max({patch.c[0].squaredNorm(), patch.c[1].squaredNorm(), patch.c[2].squaredNorm()})) / 3;
    Real square = std::numeric_limits<Real>::infinity();
    bool above = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const V from = x - patch.x[k], edge = patch.x[(k + 1) % 3] - patch.x[k];
      if (cross(edge, from).dot(n) >= 0) continue;
      above = false;
      const Real t = std::clamp(from.dot(edge) / edge.squaredNorm(), Real(0), Real(1));
      square = std::min(square, (from - t * edge).squaredNorm());
    }
    if (above) return std::abs(d.dot(n)) / n.norm() - bulge;
    return std::sqrt(square) - bulge;
  }

  std::vector<Patch> patches_;
  Tree tree_;
};

}  // namespace stickslip::rigid
