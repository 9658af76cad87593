// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/tensor/products.hpp>

#include <cmath>
#include <concepts>
#include <functional>
#include <type_traits>
#include <utility>

namespace stickslip::rigid {

/// Pose of a tool: x = rotation * x_tool + translation [length].
template <int dim>
struct Pose {
  Mat<Real, dim> rotation = Mat<Real, dim>::Identity();
  Vec<Real, dim> translation = Vec<Real, dim>::Zero();

  /// Maps a point of space to the tool's frame.
  Vec<Real, dim> on_tool(const Vec<Real, dim>& x) const { return transposed_product(rotation, minus(x, translation)); }
  /// Maps a point of the tool's frame to space.
  Vec<Real, dim> in_space(const Vec<Real, dim>& x) const {
    Vec<Real, dim> turned = product(rotation, x);
    add(turned, translation);
    return turned;
  }

  bool finite() const { return is_finite(rotation) && is_finite(translation); }
  /// Whether `rotation` is a proper orthogonal matrix to 1e-6.
  bool rigid() const {
    const Mat<Real, dim>& Q = rotation;
    Real volume = 0;
    if constexpr (dim == 2)
      volume = Q(0, 0) * Q(1, 1) - Q(0, 1) * Q(1, 0);
    else
      for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i, ++i)
        volume += Q(0, i) * (Q(1, j) * Q(2, k) - Q(1, k) * Q(2, j));
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j <= i; ++j) {
        Real product = i == j ? -1 : 0;
        for (int k = 0; k < dim; ++k) product += Q(k, i) * Q(k, j);
        if (!(std::abs(product) <= 1e-6)) return false;
      }
    return volume > 0;
  }
};

/// Rotation by `angle` [rad, counter-clockwise] about `centre`, then `translation` [length].
inline Pose<2> turned(Real angle, const Vec<Real, 2>& centre, const Vec<Real, 2>& translation = Vec<Real, 2>::Zero()) {
  Pose<2> pose;
  pose.rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  pose.translation = minus(centre, product(pose.rotation, centre));
  add(pose.translation, translation);
  return pose;
}

/// A tool's pose over time, from a function of time that returns a translation or a Pose; at rest by default.
template <int dim>
class Motion {
 public:
  Motion() noexcept {}  // not defaulted: GCC 12 fails on the member initialisers of an aggregate that holds a Motion
  template <class F>
    requires std::invocable<const F&, Real> &&
        (!std::same_as<F, Motion>)Motion(F f) {  // NOLINT(google-explicit-constructor): a lambda is the usual argument
      if constexpr (std::convertible_to<std::invoke_result_t<const F&, Real>, Pose<dim>>)
        pose_ = std::move(f);
      else
        pose_ = [f = std::move(f)](Real t) {
          Pose<dim> pose;
          pose.translation = f(t);
          return pose;
        };
    }
    Pose<dim> at(Real time) const {
      return pose_ ? pose_(time) : Pose<dim>{};
    }

   private:
    std::function<Pose<dim>(Real)> pose_;
};

}  // namespace stickslip::rigid
