// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/tensor/dual.hpp>

#include <array>
#include <concepts>

namespace stickslip {

/// A point's signed distance to a tool's surface and its derivatives by the point's position, in the tool's frame
/// (theory.md, eq. 4.1-4.3).
template <class S, int dim>
struct Distance {
  S gap = S(0);                                ///< negative in penetration [length]
  Vec<S, dim> normal = Vec<S, dim>::Zero();    ///< grad gap: outward from the tool
  Mat<S, dim> hess_gap = Mat<S, dim>::Zero();  ///< [1/length]
};

/// Number of coordinates that tell where on a tool a point is: the arc length in the plane; in space, where no
/// coordinates serve a whole sphere, the closest point itself.
template <int dim>
inline constexpr int place_components = dim == 2 ? 1 : 3;

/// A point seen from a tool's surface: its distance, the place of its closest point and the place's derivatives by the
/// point's position, all in the tool's frame (theory.md, eq. 4.3 and 4.13).
template <class S, int dim>
struct SurfacePoint : Distance<S, dim> {
  static constexpr int places = place_components<dim>;

  Vec<S, places> place = Vec<S, places>::Zero();                           ///< [length]
  Mat<S, dim, places> grad_place = Mat<S, dim, places>::Zero();            ///< one column a coordinate [-]
  std::array<Mat<S, dim>, static_cast<std::size_t>(places)> hess_place{};  ///< one matrix a coordinate [1/length]

  SurfacePoint() {
    for (auto& h : hess_place) h.setZero();
  }
};

/// A rigid tool. In the plane `closest(x)` gives the SurfacePoint, and `difference(to, from)` that of two arc lengths;
/// in space `distance(x)` is enough. Both are templates on the scalar. docs/policies.md, section Tool.
template <class Tool, int dim>
concept RigidTool = requires(const Tool& tool, const Vec<Real, dim>& x, const Vec<Dual<dim>, dim>& x_dual) {
  { tool.empty() } -> std::convertible_to<bool>;
  requires(dim != 2) || requires(Real s) {
    { tool.closest(x) } -> std::same_as<SurfacePoint<Real, dim>>;
    { tool.difference(s, s) } -> std::same_as<Real>;
  };
  requires(dim != 3) || requires {
    { tool.distance(x) } -> std::same_as<Distance<Real, dim>>;
    { tool.distance(x_dual) } -> std::same_as<Distance<Dual<dim>, dim>>;
  };
};

/// The distance alone, which is all that contact without friction looks at.
template <class S, int dim, class Tool>
SurfacePoint<S, dim> distance_to(const Tool& tool, const Vec<S, dim>& x) {
  if constexpr (dim == 2) {
    return tool.closest(x);
  } else {
    SurfacePoint<S, dim> at;
    static_cast<Distance<S, dim>&>(at) = tool.distance(x);
    return at;
  }
}

/// Adds the place and its gradient: the closest point x - g N (theory.md, eq. 4.13).
template <class S>
void add_place(const Vec<S, 3>& x, SurfacePoint<S, 3>& at) {
  for (int i = 0; i < 3; ++i) {
    at.place[i] = x[i] - at.normal[i] * at.gap;
    for (int j = 0; j < 3; ++j)
      at.grad_place(i, j) = S(i == j ? 1 : 0) - at.normal[i] * at.normal[j] - at.hess_gap(i, j) * at.gap;
  }
}

/// Adds the Hessians of the place. They take the derivative of the distance's Hessian, which dual numbers carry
/// (theory.md, eq. 4.14).
template <class Tool>
void add_curvature_of_place(const Tool& tool, const Vec<Real, 3>& x, SurfacePoint<Real, 3>& at) {
  Vec<Dual<3>, 3> seeded;
  for (int i = 0; i < 3; ++i) seeded[i] = Dual<3>::variable(x[i], i);
  const Distance<Dual<3>, 3> dual = tool.distance(seeded);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        at.hess_place[static_cast<std::size_t>(k)](i, j) = at.hess_place[static_cast<std::size_t>(k)](j, i) =
            -(at.hess_gap(k, j) * at.normal[i] + at.hess_gap(i, j) * at.normal[k] + at.hess_gap(k, i) * at.normal[j] +
              at.gap * dual.hess_gap(k, i).slope[j]);
}

/// All of a point seen from a tool. Dual numbers carry the first derivatives of everything but the place's Hessians,
/// which they leave out in space.
template <class S, int dim, class Tool>
SurfacePoint<S, dim> surface_point(const Tool& tool, const Vec<S, dim>& x) {
  SurfacePoint<S, dim> at = distance_to<S, dim>(tool, x);
  if constexpr (dim == 3) {
    add_place(x, at);
    if constexpr (std::same_as<S, Real>) add_curvature_of_place(tool, x, at);
  }
  return at;
}

/// How far the place has moved since `from`.
template <class S, int dim, class Tool>
Vec<S, place_components<dim>> moved(const Tool& tool, const Vec<S, place_components<dim>>& place,
                                    const Vec<S, place_components<dim>>& from) {
  if constexpr (dim == 2)
    return Vec<S, 1>(tool.difference(place[0], from[0]));
  else
    return place - from;
}

}  // namespace stickslip
