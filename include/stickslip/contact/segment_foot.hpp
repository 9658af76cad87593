// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/tensor/products.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace stickslip {

/// A point of a slave segment against a master segment: its gap, the place of its foot, and their derivatives by the
/// positions of the four nodes, those of the slave's segment first (theory.md, eq. 4.29-4.36).
class SegmentFoot {
 public:
  static constexpr int dim = 2;
  static constexpr std::size_t nodes = 4;
  using Point = Vec<Real, dim>;
  using Block = Mat<Real, dim>;

  SegmentFoot() = default;
  /// The foot at x on the line through a and b; the point is at `eta` of its own segment. `length` is that of the
  /// master segment in the metric of the places.
  SegmentFoot(const Point& x, Real eta, const Point& a, const Point& b, Real length) {
    const Point way = minus(b, a);
    length_ = way.norm();
    tangent_ = scaled(way, 1 / length_);
    normal_ = Point(tangent_[1], -tangent_[0]);
    const Point from = minus(x, a);
    xi_ = contraction(from, tangent_) / length_;
    gap_ = contraction(from, normal_);
    stretch_ = length / length_;
    alpha_ = {1 - eta, eta, xi_ - 1, -xi_};
    beta_ = {0, 0, -1, 1};
  }
  /// The foot at a vertex v, the second node of the master segment if `second`: inside the master where `inside`. Its
  /// place is fixed.
  static SegmentFoot at_vertex(const Point& x, Real eta, const Point& v, bool second, bool inside,
                               const Point& outward) {
    SegmentFoot foot;
    const Point from = minus(x, v);
    const Real distance = from.norm();
    foot.vertex_ = true;
    foot.gap_ = inside ? -distance : distance;
    foot.normal_ = distance > 0 ? scaled(from, 1 / foot.gap_) : outward;
    foot.curvature_ = distance > 0 ? 1 / foot.gap_ : 0;
    foot.xi_ = second ? 1 : 0;
    foot.alpha_ = {1 - eta, eta, foot.xi_ - 1, -foot.xi_};
    return foot;
  }

  Real gap() const { return gap_; }          ///< [length]
  Real xi() const { return xi_; }            ///< of the foot, from 0 at the first node to 1 at the second
  Real length() const { return length_; }    ///< of the master segment [length]; 0 at a vertex
  Real stretch() const { return stretch_; }  ///< its length in the metric of the places over that [-]; 0 at a vertex
  const Point& normal() const { return normal_; }  ///< out of the master

  /// Derivatives of gap and place by the position of node p [-].
  Point gap_gradient(std::size_t p) const { return scaled(normal_, alpha_[p]); }
  Point place_gradient(std::size_t p) const {
    Point r = scaled(tangent_, stretch_ * alpha_[p]);
    if (beta_[p] != 0) add(r, normal_, stretch_ * beta_[p] * gap_ / length_);
    return r;
  }
  /// Second derivatives by the positions of nodes p and q, those of the gap and of the place weighted with the
  /// tractions along both [force / length].
  Block curvature(std::size_t p, std::size_t q, Real along_normal, Real along_place) const {
    const Real ap = alpha_[p], aq = alpha_[q], bp = beta_[p], bq = beta_[q];
    Block r;
    if (vertex_) {
      const Real c = along_normal * curvature_ * ap * aq;
      for (int j = 0; j < dim; ++j)
        for (int i = 0; i < dim; ++i) r(i, j) = c * ((i == j ? 1 : 0) - normal_[i] * normal_[j]);
      return r;
    }
    const Real g = gap_ / length_, n = along_normal / length_, t = along_place * stretch_ / length_;
    // Coefficients of N N, T T, T N and N T.
    const Real nn = -n * g * bp * bq + t * (ap * bq + bp * aq), tt = -t * (ap * bq + bp * aq),
               tn = -n * ap * bq - 2 * t * g * bp * bq, nt = -n * bp * aq - 2 * t * g * bp * bq;
    for (int j = 0; j < dim; ++j)
      for (int i = 0; i < dim; ++i)
        r(i, j) = nn * normal_[i] * normal_[j] + tt * tangent_[i] * tangent_[j] + tn * tangent_[i] * normal_[j] +
                  nt * normal_[i] * tangent_[j];
    return r;
  }

 private:
  Real gap_ = 0, xi_ = 0, length_ = 0, stretch_ = 0, curvature_ = 0;
  Point normal_ = Point::Zero(), tangent_ = Point::Zero();
  std::array<Real, nodes> alpha_{}, beta_{};
  bool vertex_ = false;
};

}  // namespace stickslip
