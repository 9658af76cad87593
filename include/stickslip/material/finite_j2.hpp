// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/material/radial_return.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/products.hpp>

#include <cmath>

namespace stickslip {

/// Multiplicative J2 plasticity with isotropic hardening: F = Fe Fp, Hencky elasticity, exponential return map in
/// principal axes, exact algorithmic tangent (theory.md, section 3.3). Plastic flow preserves the volume to round-off.
template <class Hardening>
struct FiniteJ2 {
  static_assert(
      HardeningPolicy<Hardening>,
      "stickslip: the Hardening of FiniteJ2 does not meet HardeningPolicy; see docs/policies.md, section Hardening.");
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real young = 0;         ///< [stress]
  Real poisson = 0;       ///< [-]
  Hardening hardening{};  ///< uniaxial flow stress over accumulated plastic strain

  template <class S, class TensorPattern>
  struct State {
    SymmetricTensor<S, TensorPattern> Cp_inverse = SymmetricTensor<S, TensorPattern>::identity();  ///< (Fp^T Fp)^-1
    S plastic_strain = S(0);                                                                       ///< accumulated, p

    template <class Self, class Visit>
    static constexpr void members(Self& self, Visit&& visit) {
      visit("Cp_inverse", self.Cp_inverse);
      visit("plastic_strain", self.plastic_strain);
    }
  };

  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old,
                                                                      Real dt) const {
    return respond(Deformation<S, TensorPattern>::of(F), old, dt);
  }
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Deformation<S, TensorPattern>& deformation,
                                                                      const State<S, TensorPattern>& old, Real) const {
    using std::exp;
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Tensor<S, TensorPattern> F_inverse = inverse(deformation.F);
    Tensor<S, TensorPattern> flowed = old.Cp_inverse.full();  // Cp^-1 - 1
    for (int i = 0; i < 3; ++i) flowed(i, i) -= S(1);
    const auto [b, e] = LogStrains<S, TensorPattern>(deformation, &flowed);
    const S mean = (e[0] + e[1] + e[2]) / S(3);
    const Vec<S, 3> deviator(e[0] - mean, e[1] - mean, e[2] - mean);

    MaterialResponse<S, TensorPattern, State<S, TensorPattern>> out;
    out.state = old;
    const RadialReturn<S> r = radial_return(hardening, contraction(deviator, deviator), old.plastic_strain, shear);
    out.cause = r.cause;
    if (r.cause != FailureCause::none) return out;
    if (r.flows) {
      out.state.plastic_strain = r.plastic_strain;
      // b_e = b exp(-2 increment flow direction); Cp^-1 = F^-1 b_e F^-T.
      const Tensor<S, TensorPattern> N = product(F_inverse, b.directions);
      Vec<S, 3> be;
      for (int A = 0; A < 3; ++A) be[A] = b.values[A] * exp(S(-2) * (S(1) - r.ratio) * deviator[A]);
      for (int a = 0; a < TensorPattern::symmetric_size; ++a) {
        const auto [i, j] = TensorPattern::symmetric_pairs[std::size_t(a)];
        S sum = S(0);
        for (int A = 0; A < 3; ++A)
          if (TensorPattern::couples(i, A) && TensorPattern::couples(j, A)) sum += be[A] * N(i, A) * N(j, A);
        out.state.Cp_inverse.v[a] = sum;
      }
    }
    PrincipalStress<S> stress;
    for (int A = 0; A < 3; ++A) {
      stress.tau[A] = S(2 * shear) * r.ratio * deviator[A] + S(bulk) * deformation.log_J;
      for (int B = 0; B < 3; ++B)
        stress.dtau_de(A, B) = S(bulk) + S(2 * shear) * (r.ratio * S((A == B ? 1. : 0.) - 1. / 3) -
                                                         r.softening * deviator[A] * deviator[B]);
    }
    stress.secant = S(2 * shear) * r.ratio;
    from_principal(b, F_inverse, stress, out);
    return out;
  }

  /// Stored elastic energy per reference volume at F and `state` [stress].
  template <class S, class TensorPattern>
  S energy(const Tensor<S, TensorPattern>& F, const State<S, TensorPattern>& state) const {
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Spectral<S, TensorPattern> b = spectral(product(product(F, state.Cp_inverse.full()), transpose(F)));
    return hencky_energy(b, bulk, shear);
  }

  /// Plastic work per reference volume up to `state` [stress], for hardening laws with a `work`.
  template <class TensorPattern>
  Real plastic_work(const State<Real, TensorPattern>& state) const requires requires {
    hardening.work(state.plastic_strain);
  }
  { return hardening.work(state.plastic_strain); }

  void validate() const { validate_j2(young, poisson, hardening); }
};

}  // namespace stickslip
