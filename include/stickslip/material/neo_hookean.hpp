// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/products.hpp>

namespace stickslip {

/// Compressible neo-Hookean law: W = shear/2 (tr b - 3 - 2 ln J) + lame/2 (ln J)^2 (theory.md, eq. 3.16-3.18). No
/// history.
struct NeoHookean {
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real young = 0;    ///< at small strain [stress]
  Real poisson = 0;  ///< at small strain [-]

  template <class S, class TensorPattern>
  struct State {};

  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old,
                                                                      Real dt) const {
    return respond(Deformation<S, TensorPattern>::of(F), old, dt);
  }
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Deformation<S, TensorPattern>& deformation,
                                                                      const State<S, TensorPattern>&, Real) const {
    const auto moduli = ElasticModuli::from(young, poisson);
    const Real shear = moduli.shear, lame = moduli.lame();
    const Tensor<S, TensorPattern> F_inverse = inverse(deformation.F), F_inverse_T = transpose(F_inverse);
    const S pressure = S(lame) * deformation.log_J;
    const S tension = pressure - S(shear);  // factor of F^-T in P
    MaterialResponse<S, TensorPattern, State<S, TensorPattern>> out;
    // F - F^-T = H + H^T F^-T, without cancellation at small strain.
    out.P.v = product(transpose(deformation.H), F_inverse_T).v;
    add(out.P.v, deformation.H.v);
    out.P.v = scaled(out.P.v, S(shear));
    add(out.P.v, F_inverse_T.v, pressure);
    out.dP_dF = isotropic<TensorPattern::size>(S(shear));
    for (int a = 0; a < TensorPattern::size; ++a)
      for (int b = 0; b < TensorPattern::size; ++b) {
        const auto [i, J] = TensorPattern::pairs[std::size_t(a)];
        const auto [k, L] = TensorPattern::pairs[std::size_t(b)];
        out.dP_dF(a, b) += S(lame) * F_inverse(J, i) * F_inverse(L, k);
        if (TensorPattern::couples(J, k) && TensorPattern::couples(L, i))
          out.dP_dF(a, b) -= tension * F_inverse(J, k) * F_inverse(L, i);
      }
    return out;
  }

  /// Stored energy per reference volume [stress].
  template <class S, class TensorPattern>
  S energy(const Tensor<S, TensorPattern>& F, const State<S, TensorPattern>&) const {
    using std::expm1;
    const auto moduli = ElasticModuli::from(young, poisson);
    const Vec<S, 3> e = log_strains(spectral(product(F, transpose(F))));
    const S volumetric = e[0] + e[1] + e[2];
    S coupled = S(0);  // tr b - 3 - 2 ln J, without cancellation at small strain
    for (int A = 0; A < 3; ++A) coupled += expm1(S(2) * e[A]) - S(2) * e[A];
    return S(0.5 * moduli.shear) * coupled + S(0.5 * moduli.lame()) * volumetric * volumetric;
  }

  void validate() const {
    ElasticModuli::validate(young, poisson);
    if (poisson < 0)
      throw std::invalid_argument(
          "neo-Hookean: Poisson's ratio must not be negative, or the energy has no lower bound");
  }
};

}  // namespace stickslip
