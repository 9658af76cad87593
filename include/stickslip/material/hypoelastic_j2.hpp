// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/material/radial_return.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/products.hpp>

#include <cmath>

namespace stickslip {

/// Hypoelastic J2 plasticity with isotropic hardening: the Kirchhoff stress turns with the step and grows by the
/// logarithm of its stretch, objective for steps of any size; radial return, exact algorithmic tangent (theory.md,
/// section 3.5). Its tangent is symmetric in the limit of small steps only.
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

  template <class S, class Shape>
  struct State {
    Tensor<S, Shape> F_inverse = Tensor<S, Shape>::identity();  ///< of the deformation gradient
    SymmetricTensor<S, Shape> tau{};                            ///< Kirchhoff stress [stress]
    S plastic_strain = S(0);                                    ///< accumulated, p
  };

  template <class S, class Shape>
  MaterialResponse<S, Shape, State<S, Shape>> respond(const Tensor<S, Shape>& F, const State<S, Shape>& old,
                                                      Real) const {
    using std::sqrt;
    using T = Tensor<S, Shape>;
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    // The step alone: f = F F_n^-1 = sum_A lambda_A n_A m_A^T.
    const T f = product(F, old.F_inverse);
    const Spectral<S, Shape> b = spectral(product(f, transpose(f)));
    const T& n = b.directions;
    const Vec<S, 3> e = log_strains(b);
    const S volumetric = e[0] + e[1] + e[2];
    Vec<S, 3> stretch;
    for (int A = 0; A < 3; ++A) stretch[A] = sqrt(b.values[A]);
    T m = product(transpose(f), n);
    for (const auto& [i, A] : Shape::pairs) m(i, A) /= stretch[A];

    // Trial stress in the frame n_A: the old one has the components that it had in the frame m_A.
    T deviator = product(product(transpose(m), old.tau.full()), m);
    const S old_mean = trace(deviator) / S(3);
    deviator.v = scaled(deviator.v, S(0.5 / shear));
    for (int A = 0; A < 3; ++A) deviator(A, A) += e[A] - volumetric / S(3) - old_mean / S(2 * shear);

    MaterialResponse<S, Shape, State<S, Shape>> out;
    out.state = old;
    const RadialReturn<S> r = radial_return(hardening, contraction(deviator.v, deviator.v), old.plastic_strain, shear);
    out.cause = r.cause;
    if (r.cause != Cause::none) return out;
    T tau;
    tau.v = scaled(deviator.v, S(2 * shear * r.ratio));
    for (int A = 0; A < 3; ++A) tau(A, A) += old_mean + S(bulk) * volumetric;

    const T F_inverse = inverse(F);
    const T spatial = product(product(n, tau), transpose(n));
    out.state.F_inverse = F_inverse;
    out.state.plastic_strain = r.plastic_strain;
    for (int a = 0; a < Shape::symmetric_size; ++a) {
      const auto [i, j] = Shape::symmetric_pairs[std::size_t(a)];
      out.state.tau.v[a] = spatial(i, j);
    }

    // a: d(tau) - tau dl^T by dl, a column for each component of dl = dF F^-1 in the frame n_A.
    Moduli<S, Shape> moduli;
    for (int c = 0; c < Shape::size; ++c) {
      const auto [C, D] = Shape::pairs[std::size_t(c)];
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
        if (Shape::couples(A, C)) change(A, C) -= tau(A, D);
      for (int a = 0; a < Shape::size; ++a) moduli(a, c) = change.v[a];
    }
    const Moduli<S, Shape> Q = to_principal_frame(n, product(F_inverse, n));
    out.P.v = transposed_product(Q, tau.v);
    out.dP_dF = transposed_product(Q, product(moduli, Q));
    return out;
  }

  /// Energy that the stress would give back on unloading, per reference volume (theory.md, eq. 3.25).
  template <class S, class Shape>
  S energy(const Tensor<S, Shape>&, const State<S, Shape>& state) const {
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Tensor<S, Shape> tau = state.tau.full();
    const S mean = trace(tau) / S(3);
    return (contraction(tau.v, tau.v) - S(3) * mean * mean) / S(4 * shear) + mean * mean / S(2 * bulk);
  }

  /// Plastic work per reference volume spent up to the memory `state`, where the hardening offers its integral.
  template <class Shape>
  Real plastic_work(const State<Real, Shape>& state) const requires requires {
    hardening.work(state.plastic_strain);
  }
  { return hardening.work(state.plastic_strain); }

  void validate() const { validate_j2(young, poisson, hardening); }
};

}  // namespace stickslip
