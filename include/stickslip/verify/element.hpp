// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/element.hpp>
#include <stickslip/verify/report.hpp>

#include <limits>
#include <vector>

namespace stickslip::verify {

/// A single element: kinematics, material and reference coordinates X (one row per node) [length].
template <class Element, class Kinematics, class Material>
struct SingleElement {
  static constexpr int dofs = Element::nodes * Element::dim;
  using TensorPattern = typename Kinematics::TensorPattern;
  template <class S>
  using State = typename Material::template State<S, TensorPattern>;
  template <class S>
  using Result = ElementResult<S, dofs, Element::points, State<S>>;
  template <class S>
  using Memory = std::array<State<S>, static_cast<std::size_t>(Element::points)>;

  Kinematics kinematics{};
  Material material{};
  Mat<Real, Element::nodes, Element::dim> X;

  /// Geometry of the quadrature points with the scalar type S.
  template <class S>
  typename Element::template Geometry<Kinematics, S> geometry_in() const {
    typename Element::template Geometry<Kinematics, S> geometry;
    const auto rule = Element::Cell::quadrature();
    for (std::size_t p = 0; p < rule.size(); ++p) {
      const auto plain = point_geometry<Kinematics, typename Element::Cell>(kinematics, X, rule[p].xi, rule[p].weight);
      geometry[p].dN_dX = plain.dN_dX.template cast<S>();
      if constexpr (Kinematics::hoop) geometry[p].N_over_R = plain.N_over_R.template cast<S>();
      geometry[p].weight = S(plain.weight);
    }
    return geometry;
  }

  /// Forces, tangent and states at the displacements u [length]. NaN forces if the element fails.
  template <class S>
  Result<S> at(const Vec<S, dofs>& u, const Memory<S>& old, Real dt = 1) const {
    const typename Element::template Geometry<Kinematics, S> geometry = geometry_in<S>();
    Result<S> result;
    if (Element::evaluate(geometry, material, u, old, dt, result) != FailureCause::none)
      result.residual.setConstant(S(std::numeric_limits<Real>::quiet_NaN()));
    return result;
  }

  /// The same with the element's condensed unknown open at `value`.
  RelationSample<dofs> open(const Vec<Real, dofs>& u, const Memory<Real>& old, Real value,
                            Real dt = 1) const requires has_condensed_unknown<Element> {
    const auto geometry = geometry_in<Real>();
    Result<Real> result;
    RelationSample<dofs> sample;
    sample.relation.value = value;
    if (Element::evaluate(geometry, material, u, old, dt, result, &sample.relation) != FailureCause::none)
      result.residual.setConstant(std::numeric_limits<Real>::quiet_NaN());
    sample.force = result.residual;
    sample.tangent = result.tangent;
    return sample;
  }

  /// States after all but the last displacements of a path.
  template <class S>
  Memory<S> preloaded(const std::vector<Vec<Real, dofs>>& path, Real dt = 1) const {
    Memory<S> memory;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      Vec<S, dofs> u;
      for (int k = 0; k < dofs; ++k) u[k] = S(path[i][k]);
      memory = at<S>(u, memory, dt).states;
    }
    return memory;
  }
};

/// Tangent of an element at the last nodal displacements of a path, with the states after the others.
template <class Element, class Kinematics, class Material>
TangentReport element_tangent(const SingleElement<Element, Kinematics, Material>& element,
                              const std::vector<Vec<Real, Element::nodes * Element::dim>>& path, Real dt = 1,
                              Real step = 1e-4) {
  constexpr int n = Element::nodes * Element::dim;
  const auto old = element.template preloaded<Real>(path, dt);
  const Mat<Real, n> tangent = element.template at<Real>(path.back(), old, dt).tangent;
  const auto dual_old = element.template preloaded<Dual<n>>(path, dt);
  const Mat<Real, n> by_duals =
      slopes<n, n>(element.template at<Dual<n>>(seeded<n>(path.back()), dual_old, dt).residual);
  const Mat<Real, n> by_differences = differentiate<n, n>(
      path.back(), step, [&](const Vec<Real, n>& u) { return element.template at<Real>(u, old, dt).residual; });
  return {relative_error(tangent, by_duals), relative_error(tangent, by_differences), asymmetry(tangent)};
}

/// Objectivity of an element: a superposed `rotation` by `angle` [rad] rotates its nodal forces. Relative error.
template <class Element, class Kinematics, class Material>
Real element_objectivity(const SingleElement<Element, Kinematics, Material>& element,
                         const std::vector<Vec<Real, Element::nodes * Element::dim>>& path, Real angle, Real dt = 1) {
  static_assert(!Kinematics::hoop, "a rotation in the section leaves an axisymmetric body's axis");
  constexpr int dim = Element::dim, n = Element::nodes * dim;
  const auto turn = rotation<typename Kinematics::TensorPattern>(angle);
  Mat<Real, dim> Q;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) Q(i, j) = turn(i, j);
  const auto old = element.template preloaded<Real>(path, dt);
  const Vec<Real, n> forces = element.template at<Real>(path.back(), old, dt).residual;
  Vec<Real, n> turned_u, turned_forces;
  for (int a = 0; a < Element::nodes; ++a) {
    const Vec<Real, dim> X = element.X.row(a).transpose();
    turned_u.template segment<dim>(dim * a) = Q * (X + path.back().template segment<dim>(dim * a)) - X;
    turned_forces.template segment<dim>(dim * a) = Q * forces.template segment<dim>(dim * a);
  }
  return relative_error(element.template at<Real>(turned_u, old, dt).residual, turned_forces);
}

}  // namespace stickslip::verify
