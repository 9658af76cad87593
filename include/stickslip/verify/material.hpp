// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/material.hpp>
#include <stickslip/verify/report.hpp>

#include <vector>

namespace stickslip::verify {

/// Deformation gradients that a point goes through; the check is made at the last one, on the memory the others left.
template <class Shape>
using DeformationPath = std::vector<Tensor<Real, Shape>>;

namespace detail {
/// The memory that all but the last of a path leave, in any scalar.
template <class S, class Shape, class Material>
typename Material::template State<S, Shape> preloaded(const Material& material, const DeformationPath<Shape>& path,
                                                      Real dt) {
  typename Material::template State<S, Shape> state;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Tensor<S, Shape> F;
    for (int k = 0; k < Shape::size; ++k) F.v[k] = S(path[i].v[k]);
    state = material.respond(F, state, dt).state;
  }
  return state;
}
}  // namespace detail

/// dP_dF of a material against the derivatives of its own P. Dual numbers do not see how principal directions turn
/// where principal stretches coincide: read `by_differences` there.
template <class Shape, class Material>
TangentReport material_tangent(const Material& material, const DeformationPath<Shape>& path, Real dt = 1,
                               Real step = 1e-4) {
  constexpr int n = Shape::size;
  const Tensor<Real, Shape>& F = path.back();
  const auto old = detail::preloaded<Real, Shape>(material, path, dt);
  const Moduli<Real, Shape> tangent = material.respond(F, old, dt).dP_dF;

  Tensor<Dual<n>, Shape> dual_F;
  dual_F.v = seeded<n>(F.v);
  const auto dual_old = detail::preloaded<Dual<n>, Shape>(material, path, dt);
  const Mat<Real, n> by_duals = slopes<n, n>(material.respond(dual_F, dual_old, dt).P.v);
  const Mat<Real, n> by_differences = differentiate<n, n>(F.v, step, [&](const Vec<Real, n>& v) {
    Tensor<Real, Shape> moved;
    moved.v = v;
    return material.respond(moved, old, dt).P.v;
  });
  return {relative_error(tangent, by_duals), relative_error(tangent, by_differences), asymmetry(tangent)};
}

/// The contract of the memory: a second call with the new memory, the same F and dt = 0 returns the same stress.
/// Relative change of P.
template <class Shape, class Material>
Real material_memory(const Material& material, const DeformationPath<Shape>& path, Real dt = 1) {
  const auto first = material.respond(path.back(), detail::preloaded<Real, Shape>(material, path, dt), dt);
  const auto second = material.respond(path.back(), first.state, 0);
  return relative_error(second.P.v, first.P.v);
}

/// Objectivity: P(Q F) = Q P(F) for a `rotation` Q by `angle` [rad], on the same memory. Relative error.
template <class Shape, class Material>
Real material_objectivity(const Material& material, const DeformationPath<Shape>& path, Real angle, Real dt = 1) {
  const Tensor<Real, Shape> Q = rotation<Shape>(angle);
  const auto old = detail::preloaded<Real, Shape>(material, path, dt);
  const auto turned = material.respond(product(Q, path.back()), old, dt);
  return relative_error(turned.P.v, product(Q, material.respond(path.back(), old, dt).P).v);
}

}  // namespace stickslip::verify
