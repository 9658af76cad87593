// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/base/require.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>
#include <stickslip/tensor/spectral.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Bulk and shear modulus of isotropic elasticity [stress].
struct ElasticModuli {
  Real bulk, shear;

  Real lame() const { return bulk - 2 * shear / 3; }  ///< Lame's first parameter [stress]
  static ElasticModuli from(Real young, Real poisson) {
    return {young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
  }
  static void validate(Real young, Real poisson) {
    require::positive(young, "material: Young's modulus");
    if (!(poisson > -1 && poisson < 0.5))
      throw std::invalid_argument("material: Poisson's ratio must lie between -1 and 0.5, both excluded");
  }
};

/// Principal logarithmic strains e_A = ln(b_A) / 2 (theory.md, eq. 3.2).
template <class S, class TensorPattern>
Vec<S, 3> log_strains(const Spectral<S, TensorPattern>& b) {
  using std::log;
  Vec<S, 3> e;
  for (int A = 0; A < 3; ++A) e[A] = S(0.5) * log(b.values[A]);
  return e;
}

/// Spectral form and logarithmic strains of b = F G F^T, G = 1 + D (null D: G = 1), computed from H = F - 1 without
/// cancellation at small strain (theory.md, eq. 3.4).
template <class S, class TensorPattern>
struct LogStrains {
  Spectral<S, TensorPattern> b;
  Vec<S, 3> e;  ///< ln(b_A) / 2

  LogStrains(const Deformation<S, TensorPattern>& deformation, const Tensor<S, TensorPattern>* D) {
    const Tensor<S, TensorPattern>& H = deformation.H;
    Tensor<S, TensorPattern> less_one;  // b - 1 = H + H^T + H H^T + F D F^T
    less_one.v = product(H, transpose(H)).v;
    for (int a = 0; a < TensorPattern::size; ++a) {
      const auto [i, j] = TensorPattern::pairs[std::size_t(a)];
      less_one.v[a] += H(i, j) + H(j, i);
    }
    if (D) add(less_one.v, product(product(deformation.F, *D), transpose(deformation.F)).v);
    Real largest = 0;
    for (int a = 0; a < TensorPattern::size; ++a) largest = std::max(largest, std::abs(value_of(less_one.v[a])));
    if (largest < 0.1) {
      b = spectral(less_one);
      for (int A = 0; A < 3; ++A) {
        e[A] = S(0.5) * log_one_plus(b.values[A]);
        b.values[A] += S(1);
      }
    } else {  // no cancellation here, and the smallest value of b keeps its digits
      b = spectral(plus_one(less_one));
      e = log_strains(b);
    }
  }
};

/// Hencky's stored energy per reference volume at the elastic b [stress] (theory.md, eq. 3.1).
template <class S, class TensorPattern>
S hencky_energy(const Spectral<S, TensorPattern>& b, Real bulk, Real shear) {
  const Vec<S, 3> e = log_strains(b);
  const S volumetric = e[0] + e[1] + e[2];
  return S(0.5 * bulk - shear / 3) * volumetric * volumetric + S(shear) * contraction(e, e);
}

/// Stress of an isotropic law in the frame of its principal logarithmic strains e_A.
template <class S>
struct PrincipalStress {
  Vec<S, 3> tau;      ///< principal Kirchhoff stresses [stress]
  Mat<S, 3> dtau_de;  ///< derivatives d tau_A / d e_B [stress]
  S secant;           ///< tau_A - tau_B = secant (e_A - e_B): twice the secant shear modulus [stress]
};

/// Matrix Q that maps dF to dl = dF F^-1 in the frame n_A: dl_CD = n_kC dF_kL N_LD, where n_A and N_A = F^-1 n_A are
/// the columns of `n` and `N`. P = Q^T tau, dP_dF = Q^T a Q (theory.md, eq. 3.7).
template <class S, class TensorPattern>
Moduli<S, TensorPattern> to_principal_frame(const Tensor<S, TensorPattern>& n, const Tensor<S, TensorPattern>& N) {
  Moduli<S, TensorPattern> Q = Moduli<S, TensorPattern>::Zero();
  for (int a = 0; a < TensorPattern::size; ++a) {
    const auto [C, D] = TensorPattern::pairs[std::size_t(a)];
    for (int f = 0; f < TensorPattern::size; ++f) {
      const auto [k, L] = TensorPattern::pairs[std::size_t(f)];
      if (TensorPattern::couples(k, C) && TensorPattern::couples(L, D)) Q(a, f) = n(k, C) * N(L, D);
    }
  }
  return Q;
}

/// First Piola-Kirchhoff stress and consistent tangent of a law that is isotropic in the trial elastic strain
/// e_A = ln(values_A) / 2 of b = F G F^T, G fixed (theory.md, eq. 3.5-3.8). `principal` is the spectral form of b.
template <class S, class TensorPattern, class Response>
void from_principal(const Spectral<S, TensorPattern>& principal, const Tensor<S, TensorPattern>& F_inverse,
                    const PrincipalStress<S>& stress, Response& out) {
  constexpr int size = TensorPattern::size;
  const Tensor<S, TensorPattern>& n = principal.directions;
  const Tensor<S, TensorPattern> N = product(F_inverse, n);  // column A: F^-1 n_A
  const auto& b = principal.values;

  const Moduli<S, TensorPattern> Q = to_principal_frame(n, N);
  for (int f = 0; f < size; ++f) {
    S sum = S(0);
    for (int A = 0; A < 3; ++A) sum += stress.tau[A] * Q(TensorPattern::at(A, A), f);
    out.P.v[f] = sum;
  }

  // a maps dl to d(tau) - tau dl^T. Principal components couple, and each shear component with its transpose.
  Moduli<S, TensorPattern> aQ = Moduli<S, TensorPattern>::Zero();
  const auto add_row = [&](int C, int D, const S& factor, int to) {
    for (int f = 0; f < size; ++f) aQ(to, f) += factor * Q(TensorPattern::at(C, D), f);
  };
  for (int A = 0; A < 3; ++A)
    for (int B = 0; B < 3; ++B)
      add_row(B, B, S(stress.dtau_de(A, B) - (A == B ? stress.tau[A] : S(0))), TensorPattern::at(A, A));
  for (int a = 0; a < size; ++a) {
    const auto [A, B] = TensorPattern::pairs[std::size_t(a)];
    if (A == B) continue;
    const S t = stress.secant * S(0.5) * log_difference(b[A], b[B]);  // (tau_A - tau_B) / (b_A - b_B)
    add_row(A, B, t * b[B], a);
    add_row(B, A, t * b[A] - stress.tau[A], a);
  }
  // Eigen's product, not a loop: it saves a twentieth of the element's time in three dimensions.
  out.dP_dF.noalias() = Q.transpose().lazyProduct(aQ);
}

}  // namespace stickslip
