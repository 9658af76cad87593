// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/policy/material.hpp>

namespace stickslip {

/// Hencky's hyperelastic law: W = bulk/2 (ln J)^2 + shear |dev e|^2, e = ln(b)/2 (theory.md, eq. 3.1-3.3). No history.
struct Hencky {
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real young = 0;    ///< [stress]
  Real poisson = 0;  ///< [-]

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
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const auto [b, e] = LogStrains<S, TensorPattern>(deformation, nullptr);
    const S mean = (e[0] + e[1] + e[2]) / S(3);
    PrincipalStress<S> stress;
    for (int A = 0; A < 3; ++A) {
      stress.tau[A] = S(2 * shear) * (e[A] - mean) + S(bulk) * deformation.log_J;
      for (int B = 0; B < 3; ++B) stress.dtau_de(A, B) = S(bulk - 2 * shear / 3 + (A == B ? 2 * shear : 0));
    }
    stress.secant = S(2 * shear);
    MaterialResponse<S, TensorPattern, State<S, TensorPattern>> out;
    from_principal(b, inverse(deformation.F), stress, out);
    return out;
  }

  /// Stored energy per reference volume [stress].
  template <class S, class TensorPattern>
  S energy(const Tensor<S, TensorPattern>& F, const State<S, TensorPattern>&) const {
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Spectral<S, TensorPattern> b = spectral(product(F, transpose(F)));
    return hencky_energy(b, bulk, shear);
  }

  void validate() const { ElasticModuli::validate(young, poisson); }
};

}  // namespace stickslip
