// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/role.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <concepts>

namespace stickslip {

/// What a material answers to a deformation gradient.
template <class S, class Shape, class State>
struct MaterialResponse {
  Tensor<S, Shape> P;      ///< first Piola-Kirchhoff stress [force / reference area], first index spatial
  Moduli<S, Shape> dP_dF;  ///< its consistent derivative, rows and columns in the order of Shape::pairs
  State state;             ///< memory at the end of the step
  Cause cause = Cause::none;
};

/// Constitutive law at a point: old memory in, stress, consistent tangent and new memory out. `State<S, Shape>` is an
/// empty struct where nothing is remembered. A second call with the new memory, the same F and dt = 0 returns the same
/// stress. docs/policies.md, section Material.
template <class M, class Shape>
concept MaterialPolicy = requires(const M& material, const Tensor<Real, Shape>& F,
                                  const typename M::template State<Real, Shape>& old, Real dt) {
  requires std::same_as<typename M::Role, role::Material>;
  requires std::same_as<decltype(M::symmetry), const Symmetry>;
  requires std::default_initializable<typename M::template State<Real, Shape>>;
  {
    material.respond(F, old, dt)
    } -> std::same_as<MaterialResponse<Real, Shape, typename M::template State<Real, Shape>>>;
};

/// Flow stress and its slope at one accumulated plastic strain.
template <class S>
struct FlowStress {
  S value;  ///< [stress]
  S slope;  ///< d value / d p [stress]
};

/// Isotropic hardening: the uniaxial flow stress as a function of the accumulated plastic strain p >= 0.
/// docs/policies.md, section Hardening.
template <class H>
concept HardeningPolicy = requires(const H& hardening, const Real& p) {
  requires std::same_as<typename H::Role, role::Hardening>;
  { hardening.flow(p) } -> std::same_as<FlowStress<Real>>;
};

}  // namespace stickslip
