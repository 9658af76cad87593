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

  static constexpr int unknowns = condensed_unknowns<Element>;
  template <class S>
  using Condensed = CondensedUnknown<S, dofs, unknowns == 0 ? 1 : unknowns>;
  using Value = typename Condensed<Real>::Value;

  typename Element::template Geometry<Kinematics> geometry() const { return geometry_of<Element>(kinematics, X); }

  /// Forces, tangent and states at the displacements u [length]. NaN forces if the element fails.
  template <class S>
  Result<S> at(const Vec<S, dofs>& u, const Memory<S>& old, Real dt = 1) const {
    Condensed<S> condensed;
    return evaluate(u, old, dt, Relation::closed, condensed);
  }

  /// The same with the element's condensed unknowns open at `value`.
  RelationSample<dofs, unknowns> open(const Vec<Real, dofs>& u, const Memory<Real>& old, const Value& value,
                                      Real dt = 1) const requires(unknowns > 0) {
    RelationSample<dofs, unknowns> sample;
    sample.relation.value = value;
    const Result<Real> result = evaluate(u, old, dt, Relation::open, sample.relation);
    sample.force = result.residual;
    sample.tangent = result.tangent;
    return sample;
  }

  /// The value of the element's condensed unknowns where their relations are closed.
  Value closed(const Vec<Real, dofs>& u, const Memory<Real>& old, Real dt = 1) const requires(unknowns > 0) {
    Condensed<Real> condensed;
    evaluate(u, old, dt, Relation::closed, condensed);
    return condensed.value;
  }

  /// Deformation gradients that the material sees at the displacements u.
  template <class S>
  auto deformation(const Vec<S, dofs>& u, [[maybe_unused]] const Memory<S>& old = {},
                   [[maybe_unused]] Real dt = 1) const {
    if constexpr (unknowns > 0) {
      Condensed<S> condensed;
      evaluate(u, old, dt, Relation::closed, condensed);
      return Element::deformation(geometry(), u, condensed.value);
    } else {
      return Element::deformation(geometry(), u);
    }
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

 private:
  template <class S>
  Result<S> evaluate(const Vec<S, dofs>& u, const Memory<S>& old, Real dt, [[maybe_unused]] Relation relation,
                     [[maybe_unused]] Condensed<S>& condensed) const {
    Result<S> result;
    FailureCause cause;
    if constexpr (unknowns > 0)
      cause = evaluate_element<Element>(geometry(), material, u, old, dt, result, Want::tangent, condensed, relation);
    else
      cause = evaluate_element<Element>(geometry(), material, u, old, dt, result, Want::tangent);
    if (cause != FailureCause::none) result.residual.setConstant(S(std::numeric_limits<Real>::quiet_NaN()));
    return result;
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
