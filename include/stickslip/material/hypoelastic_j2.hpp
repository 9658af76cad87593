// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/material/radial_return.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/products.hpp>

#include <cmath>

namespace stickslip {

/// Hypoelastic J2 plasticity with isotropic hardening: the rotation of the step rotates the Kirchhoff stress, and the
/// logarithm of its stretch increments it, which is objective for any step size; radial return, exact algorithmic
/// tangent (theory.md, section 3.5). The tangent is symmetric only in the limit of small steps.
template <class Hardening>
struct HypoelasticJ2 {
  static_assert(HardeningPolicy<Hardening>,
                "stickslip: the Hardening of HypoelasticJ2 does not meet HardeningPolicy; see docs/policies.md, "
                "section Hardening.");
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::general;

  Real young = 0;         ///< [stress]
  Real poisson = 0;       ///< [-]
  Hardening hardening{};  ///< uniaxial flow stress over accumulated plastic strain

  template <class S, class TensorPattern>
  struct State {
    Tensor<S, TensorPattern> F_inverse = Tensor<S, TensorPattern>::identity();  ///< inverse deformation gradient [-]
    SymmetricTensor<S, TensorPattern> tau{};                                    ///< Kirchhoff stress [stress]
    S plastic_strain = S(0);                                                    ///< accumulated, p

    template <class Self, class Visit>
    static constexpr void members(Self& self, Visit&& visit) {
      visit("F_inverse", self.F_inverse);
      visit("tau", self.tau);
      visit("plastic_strain", self.plastic_strain);
    }
  };

  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old, Real) const {
    using std::sqrt;
    using T = Tensor<S, TensorPattern>;
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    // Deformation gradient of the step: f = F F_n^-1 = sum_A lambda_A n_A m_A^T.
    const T f = product(F, old.F_inverse);
    const Spectral<S, TensorPattern> b = spectral(product(f, transpose(f)));
    const T& n = b.directions;
    const Vec<S, 3> e = log_strains(b);
    const S volumetric = e[0] + e[1] + e[2];
    Vec<S, 3> stretch;
    for (int A = 0; A < 3; ++A) stretch[A] = sqrt(b.values[A]);
    T m = product(transpose(f), n);
    for (const auto& [i, A] : TensorPattern::pairs) m(i, A) /= stretch[A];

    // Trial stress in the frame n_A, where the rotated old stress has the components of the old one in the frame m_A.
    T deviator = product(product(transpose(m), old.tau.full()), m);
    const S old_mean = trace(deviator) / S(3);
    deviator.v = scaled(deviator.v, S(0.5 / shear));
    for (int A = 0; A < 3; ++A) deviator(A, A) += e[A] - volumetric / S(3) - old_mean / S(2 * shear);

    MaterialResponse<S, TensorPattern, State<S, TensorPattern>> out;
    out.state = old;
    const RadialReturn<S> r = radial_return(hardening, contraction(deviator.v, deviator.v), old.plastic_strain, shear);
    out.cause = r.cause;
    if (r.cause != FailureCause::none) return out;
    T tau;
    tau.v = scaled(deviator.v, S(2 * shear * r.ratio));
    for (int A = 0; A < 3; ++A) tau(A, A) += old_mean + S(bulk) * volumetric;

    const T F_inverse = inverse(F);
    const T spatial = product(product(n, tau), transpose(n));
    out.state.F_inverse = F_inverse;
    out.state.plastic_strain = r.plastic_strain;
    for (int a = 0; a < TensorPattern::symmetric_size; ++a) {
      const auto [i, j] = TensorPattern::symmetric_pairs[std::size_t(a)];
      out.state.tau.v[a] = spatial(i, j);
    }

    // a maps dl = dF F^-1 to d(tau) - tau dl^T in the frame n_A, one column per component of dl.
    Moduli<S, TensorPattern> moduli;
    for (int c = 0; c < TensorPattern::size; ++c) {
      const auto [C, D] = TensorPattern::pairs[std::size_t(c)];
      T strain, spin;  // d(ln u) and d(r) r^T
      if (C == D) {
        strain(C, C) = S(1);
      } else {
        strain(C, D) = stretch[C] * stretch[D] * S(0.5) * log_difference(b.values[C], b.values[D]);
        strain(D, C) = strain(C, D);
        spin(C, D) = stretch[D] / (stretch[C] + stretch[D]);
        spin(D, C) = -spin(C, D);
      }
      T change;
      change.v = minus(product(spin, tau).v, product(tau, spin).v);
      add(change.v, strain.v, S(2 * shear * r.ratio));
      add(change.v, deviator.v, S(-2 * shear * r.softening * contraction(deviator.v, strain.v)));
      if (C == D)
        for (int A = 0; A < 3; ++A) change(A, A) += S(bulk) - S(2 * shear / 3) * r.ratio;
      for (int A = 0; A < 3; ++A)
        if (TensorPattern::couples(A, C)) change(A, C) -= tau(A, D);
      for (int a = 0; a < TensorPattern::size; ++a) moduli(a, c) = change.v[a];
    }
    const Moduli<S, TensorPattern> Q = to_principal_frame(n, product(F_inverse, n));
    out.P.v = transposed_product(Q, tau.v);
    out.dP_dF = transposed_product(Q, product(moduli, Q));
    return out;
  }

  /// Elastic energy recovered on unloading, per reference volume [stress] (theory.md, eq. 3.26).
  template <class S, class TensorPattern>
  S energy(const Tensor<S, TensorPattern>&, const State<S, TensorPattern>& state) const {
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Tensor<S, TensorPattern> tau = state.tau.full();
    const S mean = trace(tau) / S(3);
    return (contraction(tau.v, tau.v) - S(3) * mean * mean) / S(4 * shear) + mean * mean / S(2 * bulk);
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
