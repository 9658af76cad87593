// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/role.hpp>
#include <stickslip/base/stored_if.hpp>
#include <stickslip/base/want.hpp>
#include <stickslip/policy/condensed_unknown.hpp>
#include <stickslip/policy/kinematics.hpp>
#include <stickslip/tensor/products.hpp>

#include <array>
#include <concepts>

namespace stickslip {

/// What one quadrature point of an element keeps of the reference mesh.
template <class Kinematics, int nodes>
struct PointGeometry {
  using TensorPattern = typename Kinematics::TensorPattern;
  static constexpr int dim = Kinematics::dim;
  static constexpr int dofs = nodes * dim;

  Mat<Real, nodes, dim> dN_dX;  ///< reference gradients of the shape functions [1/length]
  [[no_unique_address]] StoredIf<Kinematics::hoop, Vec<Real, nodes>, struct HoopTag>
      N_over_R;  ///< hoop operator [1/length]
  Real weight;   ///< reference volume that the point stands for [length^3]
};

/// Geometry of a point from the nodes' reference coordinates (one row a node).
template <class Kinematics, class Cell>
PointGeometry<Kinematics, Cell::nodes> point_geometry(const Kinematics& kinematics,
                                                      const Mat<Real, Cell::nodes, Cell::dim>& X,
                                                      const Vec<Real, Cell::dim>& xi, Real quadrature_weight) {
  constexpr int dim = Cell::dim;
  using TensorPattern = typename Kinematics::TensorPattern;
  const Mat<Real, Cell::nodes, dim> dN_dxi = Cell::gradient(xi);
  const Vec<Real, Cell::nodes> N = Cell::shape(xi);
  const Mat<Real, dim> block = transposed_product(X, dN_dxi);
  auto jacobian = Tensor<Real, TensorPattern>::identity();  // in the plane, the normal stays as it is
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) jacobian(i, j) = block(i, j);
  const Real det = determinant(jacobian);
  const Tensor<Real, TensorPattern> adjugate_of_jacobian = adjugate(jacobian);
  Mat<Real, dim> inverse;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) inverse(i, j) = adjugate_of_jacobian(i, j) / det;
  const Vec<Real, dim> place = transposed_product(X, N);
  PointGeometry<Kinematics, Cell::nodes> point;
  point.dN_dX = product(dN_dxi, inverse);
  if constexpr (Kinematics::hoop) point.N_over_R = scaled(N, 1 / place[0]);
  point.weight = quadrature_weight * det * kinematics.volume_factor(place);
  return point;
}

/// Hourglass vectors: products `h` of reference coordinates at the nodes, one a column, without what an affine motion
/// has of them (theory.md, eq. 2.14). `slope` and `dual` are the gradients of the shape functions and the inverse of
/// the derivatives of the place, at the centre of a cell whose nodes are at X.
template <int nodes, int dim, int modes>
Mat<Real, nodes, modes> hourglass_vectors(const Mat<Real, nodes, modes>& h, const Mat<Real, nodes, dim>& slope,
                                          const Mat<Real, dim>& dual, const Mat<Real, nodes, dim>& X) {
  return scaled(minus(h, product(product(slope, dual), transposed_product(X, h))), 1. / nodes);
}

namespace detail {
template <class E>
constexpr auto force_quadrature() {
  if constexpr (requires { E::quadrature(); })
    return E::quadrature();
  else
    return E::Cell::quadrature();
}
}  // namespace detail

/// The rule with which an element integrates its forces: its own, or that of its cell. The mass has always that of the
/// cell.
template <class E>
auto quadrature_of() {
  return detail::force_quadrature<E>();
}

/// Geometry of an element from its nodes' reference coordinates (one row a node): what the element makes itself, or
/// that of its points.
template <class E, class Kinematics>
typename E::template Geometry<Kinematics> geometry_of(const Kinematics& kinematics,
                                                      const Mat<Real, E::nodes, E::dim>& X) {
  if constexpr (requires { E::geometry(kinematics, X); }) {
    return E::geometry(kinematics, X);
  } else {
    typename E::template Geometry<Kinematics> geometry;
    const auto rule = quadrature_of<E>();
    for (std::size_t p = 0; p < rule.size(); ++p)
      geometry[p] = point_geometry<Kinematics, typename E::Cell>(kinematics, X, rule[p].xi, rule[p].weight);
    return geometry;
  }
}

/// What an element returns: nodal forces, their derivative (both triangles) and the memory of its points.
template <class S, int dofs, int points, class State>
struct ElementResult {
  Vec<S, dofs> residual;
  Mat<S, dofs> tangent;
  std::array<State, static_cast<std::size_t>(points)> states;
};

namespace detail {
template <class E>
constexpr int condensed_unknowns_of() {
  if constexpr (requires { E::condensed_unknowns; })
    return E::condensed_unknowns;
  else
    return 0;
}
}  // namespace detail

/// How many condensed unknowns an element has. Where it has some, its `evaluate` takes a
/// CondensedUnknown<S, dofs, count>& and a Relation after all else.
template <class E>
inline constexpr int condensed_unknowns = detail::condensed_unknowns_of<E>();

/// Whether an element can leave the tangent out: its `evaluate` then takes a Want after all else.
template <class E>
inline constexpr bool takes_want = requires {
  requires E::takes_want;
};

/// Evaluates an element, with the skills that it has. `condensed` is nothing, or a CondensedUnknown<S, dofs, count>&
/// and a Relation.
template <class Element, class Geometry, class Material, class Vector, class States, class Result, class... Condensed>
FailureCause evaluate_element(const Geometry& geometry, const Material& material, const Vector& u, const States& old,
                              Real dt, Result& out, [[maybe_unused]] Want want, Condensed&&... condensed) {
  if constexpr (takes_want<Element>)
    return Element::evaluate(geometry, material, u, old, dt, out, condensed..., want);
  else
    return Element::evaluate(geometry, material, u, old, dt, out, condensed...);
}

/// An element: a reference cell with its quadrature and the treatment of the volumetric part. `evaluate`, a template,
/// is checked where the model is put together. docs/policies.md, section Element.
template <class E>
concept ElementPolicy = requires(const Mat<Real, E::nodes, E::dim>& X, const Vec<Real, E::dim>& xi) {
  requires std::same_as<typename E::Role, role::Element>;
  requires E::nodes >
  0 && E::points > 0;
  { E::Cell::shape(xi) } -> std::same_as<Vec<Real, E::nodes>>;
  { E::Cell::gradient(xi) } -> std::same_as<Mat<Real, E::nodes, E::dim>>;
  {E::Cell::quadrature()};
};

}  // namespace stickslip
