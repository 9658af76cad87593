// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/material.hpp>
#include <stickslip/verify/report.hpp>

#include <vector>

namespace stickslip::verify {

/// Successive deformation gradients of a point; the check is made at the last one, with the state after the others.
template <class TensorPattern>
using DeformationPath = std::vector<Tensor<Real, TensorPattern>>;

namespace detail {
/// State after all but the last deformation gradient of a path, with the scalar type S.
template <class S, class TensorPattern, class Material>
typename Material::template State<S, TensorPattern> preloaded(const Material& material,
                                                              const DeformationPath<TensorPattern>& path, Real dt) {
  typename Material::template State<S, TensorPattern> state;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Tensor<S, TensorPattern> F;
    for (int k = 0; k < TensorPattern::size; ++k) F.v[k] = S(path[i].v[k]);
    state = material.respond(F, state, dt).state;
  }
  return state;
}
}  // namespace detail

/// dP_dF of a material against the derivatives of its own P. Where principal stretches coincide, dual numbers miss the
/// rotation of the principal directions: use `by_differences` there.
template <class TensorPattern, class Material>
TangentReport material_tangent(const Material& material, const DeformationPath<TensorPattern>& path, Real dt = 1,
                               Real step = 1e-4) {
  constexpr int n = TensorPattern::size;
  const Tensor<Real, TensorPattern>& F = path.back();
  const auto old = detail::preloaded<Real, TensorPattern>(material, path, dt);
  const Moduli<Real, TensorPattern> tangent = material.respond(F, old, dt).dP_dF;

  Tensor<Dual<n>, TensorPattern> dual_F;
  dual_F.v = seeded<n>(F.v);
  const auto dual_old = detail::preloaded<Dual<n>, TensorPattern>(material, path, dt);
  const Mat<Real, n> by_duals = slopes<n, n>(material.respond(dual_F, dual_old, dt).P.v);
  const Mat<Real, n> by_differences = differentiate<n, n>(F.v, step, [&](const Vec<Real, n>& v) {
    Tensor<Real, TensorPattern> moved;
    moved.v = v;
    return material.respond(moved, old, dt).P.v;
  });
  return {relative_error(tangent, by_duals), relative_error(tangent, by_differences), asymmetry(tangent)};
}

/// The contract of the state: a second call with the new state, the same F and dt = 0 returns the same stress. Relative
/// change of P.
template <class TensorPattern, class Material>
Real material_memory(const Material& material, const DeformationPath<TensorPattern>& path, Real dt = 1) {
  const auto first = material.respond(path.back(), detail::preloaded<Real, TensorPattern>(material, path, dt), dt);
  const auto second = material.respond(path.back(), first.state, 0);
  return relative_error(second.P.v, first.P.v);
}

/// Objectivity: P(Q F) = Q P(F) for a `rotation` Q by `angle` [rad], with the same state. Relative error.
template <class TensorPattern, class Material>
Real material_objectivity(const Material& material, const DeformationPath<TensorPattern>& path, Real angle,
                          Real dt = 1) {
  const Tensor<Real, TensorPattern> Q = rotation<TensorPattern>(angle);
  const auto old = detail::preloaded<Real, TensorPattern>(material, path, dt);
  const auto turned = material.respond(product(Q, path.back()), old, dt);
  return relative_error(turned.P.v, product(Q, material.respond(path.back(), old, dt).P).v);
}

}  // namespace stickslip::verify
