// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/products.hpp>

namespace stickslip {

/// Compressible neo-Hookean law: W = shear/2 (tr b - 3 - 2 ln J) + lame/2 (ln J)^2 (theory.md, eq. 3.15-3.17). No
/// memory.
struct NeoHookean {
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;

  Real young = 0;    ///< at small strain [stress]
  Real poisson = 0;  ///< at small strain [-]

  template <class S, class Shape>
  struct State {};

  template <class S, class Shape>
  MaterialResponse<S, Shape, State<S, Shape>> respond(const Tensor<S, Shape>& F, const State<S, Shape>& old,
                                                      Real dt) const {
    return respond(Deformation<S, Shape>::of(F), old, dt);
  }
  template <class S, class Shape>
  MaterialResponse<S, Shape, State<S, Shape>> respond(const Deformation<S, Shape>& deformation, const State<S, Shape>&,
                                                      Real) const {
    const auto moduli = ElasticModuli::from(young, poisson);
    const Real shear = moduli.shear, lame = moduli.lame();
    const Tensor<S, Shape> F_inverse = inverse(deformation.F), F_inverse_T = transpose(F_inverse);
    const S pressure = S(lame) * deformation.log_J;
    const S tension = pressure - S(shear);  // factor of F^-T in P
    MaterialResponse<S, Shape, State<S, Shape>> out;
    // F - F^-T = H + H^T F^-T, which keeps its digits at small strain.
    out.P.v = product(transpose(deformation.H), F_inverse_T).v;
    add(out.P.v, deformation.H.v);
    out.P.v = scaled(out.P.v, S(shear));
    add(out.P.v, F_inverse_T.v, pressure);
    out.dP_dF = isotropic<Shape::size>(S(shear));
    for (int a = 0; a < Shape::size; ++a)
      for (int b = 0; b < Shape::size; ++b) {
        const auto [i, J] = Shape::pairs[std::size_t(a)];
        const auto [k, L] = Shape::pairs[std::size_t(b)];
        out.dP_dF(a, b) += S(lame) * F_inverse(J, i) * F_inverse(L, k);
        if (Shape::couples(J, k) && Shape::couples(L, i))
          out.dP_dF(a, b) -= tension * F_inverse(J, k) * F_inverse(L, i);
      }
    return out;
  }

  /// Stored energy per reference volume.
  template <class S, class Shape>
  S energy(const Tensor<S, Shape>& F, const State<S, Shape>&) const {
    using std::expm1;
    const auto moduli = ElasticModuli::from(young, poisson);
    const Vec<S, 3> e = log_strains(spectral(product(F, transpose(F))));
    const S volumetric = e[0] + e[1] + e[2];
    S coupled = S(0);  // tr b - 3 - 2 ln J, without taking 1 from what is nearly 1
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
