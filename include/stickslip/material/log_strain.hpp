// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/tensor/spectral.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Bulk and shear modulus of isotropic elasticity.
struct ElasticModuli {
  Real bulk, shear;

  static ElasticModuli from(Real young, Real poisson) {
    return {young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
  }
  static void validate(Real young, Real poisson) {
    if (!(young > 0)) throw std::invalid_argument("material: Young's modulus must be positive");
    if (!(poisson > -1 && poisson < 0.5))
      throw std::invalid_argument("material: Poisson's ratio must lie between -1 and 0.5, both excluded");
  }
};

/// Hencky's stored energy per reference volume at the elastic b (theory.md, eq. 3.1).
template <class S, class Shape>
S hencky_energy(const Spectral<S, Shape>& b, Real bulk, Real shear) {
  using std::log;
  S volumetric = S(0), square = S(0);
  for (int A = 0; A < 3; ++A) {
    const S e = S(0.5) * log(b.values[A]);
    volumetric += e;
    square += e * e;
  }
  return S(0.5 * bulk - shear / 3) * volumetric * volumetric + S(shear) * square;
}

/// Stress of an isotropic law in the frame of its principal logarithmic strains e_A.
template <class S>
struct PrincipalStress {
  Vec<S, 3> tau;      ///< principal Kirchhoff stresses
  Mat<S, 3> dtau_de;  ///< their derivatives by the strains
  S secant;           ///< tau_A - tau_B = secant (e_A - e_B): twice the secant shear modulus
};

/// First Piola-Kirchhoff stress and consistent tangent of a law that is isotropic in the trial elastic strain
/// e_A = ln(values_A) / 2 of b = F G F^T, G fixed (theory.md, eq. 3.4-3.7). `principal` is the spectral form of b.
template <class S, class Shape, class Response>
void from_principal(const Spectral<S, Shape>& principal, const Tensor<S, Shape>& F_inverse,
                    const PrincipalStress<S>& stress, Response& out) {
  constexpr int size = Shape::size;
  const Tensor<S, Shape>& n = principal.directions;
  const Tensor<S, Shape> N = product(F_inverse, n);  // column A: F^-1 n_A
  const auto& b = principal.values;

  // dF in the principal frame: dl_CD = n_kC dF_kL N_LD. Its matrix Q carries stress and moduli to F.
  Moduli<S, Shape> Q = Moduli<S, Shape>::Zero();
  for (int a = 0; a < size; ++a) {
    const auto [C, D] = Shape::pairs[std::size_t(a)];
    for (int f = 0; f < size; ++f) {
      const auto [k, L] = Shape::pairs[std::size_t(f)];
      if (Shape::couples(k, C) && Shape::couples(L, D)) Q(a, f) = n(k, C) * N(L, D);
    }
  }
  for (int f = 0; f < size; ++f) {
    S sum = S(0);
    for (int A = 0; A < 3; ++A) sum += stress.tau[A] * Q(Shape::at(A, A), f);
    out.P.v[f] = sum;
  }

  // a: d(tau) - tau dl^T by dl. Principal components couple among themselves, each shear pair with its mirror.
  Moduli<S, Shape> aQ = Moduli<S, Shape>::Zero();
  for (int A = 0; A < 3; ++A)
    for (int B = 0; B < 3; ++B)
      aQ.row(Shape::at(A, A)) += Q.row(Shape::at(B, B)) * S(stress.dtau_de(A, B) - (A == B ? stress.tau[A] : S(0)));
  for (int a = 0; a < size; ++a) {
    const auto [A, B] = Shape::pairs[std::size_t(a)];
    if (A == B) continue;
    const S t = stress.secant * S(0.5) * log_difference(b[A], b[B]);  // (tau_A - tau_B) / (b_A - b_B)
    aQ.row(a) += Q.row(a) * S(t * b[B]) + Q.row(Shape::at(B, A)) * S(t * b[A] - stress.tau[A]);
  }
  out.dP_dF.noalias() = Q.transpose() * aQ;
}

}  // namespace stickslip
