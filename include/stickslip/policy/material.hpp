// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/role.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/tensor/products.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <cmath>
#include <concepts>

namespace stickslip {

/// A deformation gradient F and two quantities that it tells with an error of one rounding of 1 only, however small the
/// strain: an element gives them with all their digits (theory.md, eq. 2.13).
template <class S, class TensorPattern>
struct Deformation {
  Tensor<S, TensorPattern> F;
  Tensor<S, TensorPattern> H;  ///< F - 1
  S log_J;                     ///< ln det F

  /// What F alone tells.
  static Deformation of(const Tensor<S, TensorPattern>& F) {
    using std::log;
    Deformation d{F, F, log(determinant(F))};
    for (int i = 0; i < 3; ++i) d.H(i, i) -= S(1);
    return d;
  }
};

/// What a material answers to a deformation gradient.
template <class S, class TensorPattern, class State>
struct MaterialResponse {
  Tensor<S, TensorPattern> P;      ///< first Piola-Kirchhoff stress [force / reference area], first index spatial
  Moduli<S, TensorPattern> dP_dF;  ///< its consistent derivative, rows and columns in the order of TensorPattern::pairs
  State state;                     ///< memory at the end of the step
  FailureCause cause = FailureCause::none;
};

/// Constitutive law at a point: old memory in, stress, consistent tangent and new memory out. `State<S, TensorPattern>`
/// is an empty struct where nothing is remembered. A second call with the new memory, the same F and dt = 0 returns the
/// same stress. A law that can be had with more digits takes a Deformation in place of F as well. docs/policies.md,
/// section Material.
template <class M, class TensorPattern>
concept MaterialPolicy = requires(const M& material, const Tensor<Real, TensorPattern>& F,
                                  const typename M::template State<Real, TensorPattern>& old, Real dt) {
  requires std::same_as<typename M::Role, role::Material>;
  requires std::same_as<decltype(M::symmetry), const Symmetry>;
  requires std::default_initializable<typename M::template State<Real, TensorPattern>>;
  {
    material.respond(F, old, dt)
    } -> std::same_as<MaterialResponse<Real, TensorPattern, typename M::template State<Real, TensorPattern>>>;
};

/// Whether a material takes a Deformation in place of F, and so strains with all their digits.
template <class Material, class TensorPattern>
inline constexpr bool takes_deformation =
    requires(const Material& material, const Deformation<Real, TensorPattern>& deformation,
             const typename Material::template State<Real, TensorPattern>& state) {
  material.respond(deformation, state, Real(0));
};

/// What a material answers at a point of an element, with all the digits that it can use.
template <class Material, class S, class TensorPattern, class State>
MaterialResponse<S, TensorPattern, State> answer_of(const Material& material,
                                                    const Deformation<S, TensorPattern>& deformation, const State& old,
                                                    Real dt) {
  if constexpr (requires { material.respond(deformation, old, dt); })
    return material.respond(deformation, old, dt);
  else
    return material.respond(deformation.F, old, dt);
}

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
