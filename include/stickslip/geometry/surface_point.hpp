// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/tensor/dual.hpp>

#include <array>
#include <concepts>

namespace stickslip {

/// Signed distance of a point to a tool's surface and its derivatives with respect to the point, in the tool's frame
/// (theory.md, eq. 4.1-4.3).
template <class S, int dim>
struct Distance {
  S gap = S(0);                                ///< negative in penetration [length]
  Vec<S, dim> normal = Vec<S, dim>::Zero();    ///< grad gap [-]: outward from the tool
  Mat<S, dim> hess_gap = Mat<S, dim>::Zero();  ///< [1/length]
};

/// Number of surface coordinates: in the plane one, the arc length; in three dimensions the components of the closest
/// point itself, because no pair of coordinates covers a whole sphere.
template <int dim>
inline constexpr int surface_coordinates = dim == 2 ? 1 : 3;

/// Distance of a point to a tool's surface, surface coordinate of its closest point, and their derivatives with respect
/// to the point, in the tool's frame (theory.md, eq. 4.3 and 4.13).
template <class S, int dim>
struct SurfacePoint : Distance<S, dim> {
  static constexpr int places = surface_coordinates<dim>;

  Vec<S, places> surface_coordinate = Vec<S, places>::Zero();                ///< [length]
  Mat<S, dim, places> grad_surface = Mat<S, dim, places>::Zero();            ///< one column per coordinate [-]
  std::array<Mat<S, dim>, static_cast<std::size_t>(places)> hess_surface{};  ///< one matrix per coordinate [1/length]

  SurfacePoint() {
    for (auto& h : hess_surface) h.setZero();
  }
};

/// A rigid tool. In the plane `closest(x)` returns the SurfacePoint and `difference(to, from)` that of two arc lengths;
/// in space `distance(x)` suffices. All are templates on the scalar. docs/policies.md, section Tool.
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

/// The distance alone, sufficient for contact without friction.
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

/// Adds the surface coordinate, the closest point x - g N, and its gradient (theory.md, eq. 4.13).
template <class S>
void add_surface_coordinate(const Vec<S, 3>& x, SurfacePoint<S, 3>& at) {
  for (int i = 0; i < 3; ++i) {
    at.surface_coordinate[i] = x[i] - at.normal[i] * at.gap;
    for (int j = 0; j < 3; ++j)
      at.grad_surface(i, j) = S(i == j ? 1 : 0) - at.normal[i] * at.normal[j] - at.hess_gap(i, j) * at.gap;
  }
}

/// Adds the Hessians of the surface coordinates, from the derivative of the distance's Hessian by dual numbers
/// (theory.md, eq. 4.14).
template <class Tool>
void add_surface_curvature(const Tool& tool, const Vec<Real, 3>& x, SurfacePoint<Real, 3>& at) {
  Vec<Dual<3>, 3> seeded;
  for (int i = 0; i < 3; ++i) seeded[i] = Dual<3>::variable(x[i], i);
  const Distance<Dual<3>, 3> dual = tool.distance(seeded);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        at.hess_surface[static_cast<std::size_t>(k)](i, j) = at.hess_surface[static_cast<std::size_t>(k)](j, i) =
            -(at.hess_gap(k, j) * at.normal[i] + at.hess_gap(i, j) * at.normal[k] + at.hess_gap(k, i) * at.normal[j] +
              at.gap * dual.hess_gap(k, i).slope[j]);
}

/// The complete SurfacePoint of x. Dual numbers carry the first derivatives of all members, except that in three
/// dimensions the Hessians of the surface coordinates stay zero.
template <class S, int dim, class Tool>
SurfacePoint<S, dim> surface_point(const Tool& tool, const Vec<S, dim>& x) {
  SurfacePoint<S, dim> at = distance_to<S, dim>(tool, x);
  if constexpr (dim == 3) {
    add_surface_coordinate(x, at);
    if constexpr (std::same_as<S, Real>) add_surface_curvature(tool, x, at);
  }
  return at;
}

/// Change of the surface coordinate from `from` to `place` [length].
template <class S, int dim, class Tool>
Vec<S, surface_coordinates<dim>> relative_displacement(const Tool& tool, const Vec<S, surface_coordinates<dim>>& place,
                                                       const Vec<S, surface_coordinates<dim>>& from) {
  if constexpr (dim == 2)
    return Vec<S, 1>(tool.difference(place[0], from[0]));
  else
    return place - from;
}

}  // namespace stickslip
