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

/// Bulk and shear modulus of isotropic elasticity.
struct ElasticModuli {
  Real bulk, shear;

  Real lame() const { return bulk - 2 * shear / 3; }  ///< the first one of Lame
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
template <class S, class Shape>
Vec<S, 3> log_strains(const Spectral<S, Shape>& b) {
  using std::log;
  Vec<S, 3> e;
  for (int A = 0; A < 3; ++A) e[A] = S(0.5) * log(b.values[A]);
  return e;
}

/// b = F G F^T, G = 1 + D, by its principal values and directions, and the logarithmic strains with the digits that
/// F - 1 = H has (theory.md, eq. 3.3a).
template <class S, class Shape>
struct LogStrains {
  Spectral<S, Shape> b;
  Vec<S, 3> e;  ///< ln(b_A) / 2

  LogStrains(const Deformation<S, Shape>& deformation, const Tensor<S, Shape>* D) {
    const Tensor<S, Shape>& H = deformation.H;
    Tensor<S, Shape> less_one;  // b - 1 = H + H^T + H H^T + F D F^T
    less_one.v = product(H, transpose(H)).v;
    for (int a = 0; a < Shape::size; ++a) {
      const auto [i, j] = Shape::pairs[std::size_t(a)];
      less_one.v[a] += H(i, j) + H(j, i);
    }
    if (D) add(less_one.v, product(product(deformation.F, *D), transpose(deformation.F)).v);
    Real largest = 0;
    for (int a = 0; a < Shape::size; ++a) largest = std::max(largest, std::abs(value_of(less_one.v[a])));
    if (largest < 0.1) {
      b = spectral(less_one);
      for (int A = 0; A < 3; ++A) {
        e[A] = S(0.5) * log_one_plus(b.values[A]);
        b.values[A] += S(1);
      }
    } else {  // the digits are in b, and the smallest value keeps its own
      b = spectral(plus_one(less_one));
      e = log_strains(b);
    }
  }
};

/// Hencky's stored energy per reference volume at the elastic b (theory.md, eq. 3.1).
template <class S, class Shape>
S hencky_energy(const Spectral<S, Shape>& b, Real bulk, Real shear) {
  const Vec<S, 3> e = log_strains(b);
  const S volumetric = e[0] + e[1] + e[2];
  return S(0.5 * bulk - shear / 3) * volumetric * volumetric + S(shear) * contraction(e, e);
}

/// Stress of an isotropic law in the frame of its principal logarithmic strains e_A.
template <class S>
struct PrincipalStress {
  Vec<S, 3> tau;      ///< principal Kirchhoff stresses
  Mat<S, 3> dtau_de;  ///< their derivatives by the strains
  S secant;           ///< tau_A - tau_B = secant (e_A - e_B): twice the secant shear modulus
};

/// Matrix Q that takes dF to dl = dF F^-1 in the frame n_A: dl_CD = n_kC dF_kL N_LD, where n_A and N_A = F^-1 n_A are
/// the columns of `n` and `N`. Its transpose carries stress and moduli to P and F (theory.md, eq. 3.6).
template <class S, class Shape>
Moduli<S, Shape> to_principal_frame(const Tensor<S, Shape>& n, const Tensor<S, Shape>& N) {
  Moduli<S, Shape> Q = Moduli<S, Shape>::Zero();
  for (int a = 0; a < Shape::size; ++a) {
    const auto [C, D] = Shape::pairs[std::size_t(a)];
    for (int f = 0; f < Shape::size; ++f) {
      const auto [k, L] = Shape::pairs[std::size_t(f)];
      if (Shape::couples(k, C) && Shape::couples(L, D)) Q(a, f) = n(k, C) * N(L, D);
    }
  }
  return Q;
}

/// First Piola-Kirchhoff stress and consistent tangent of a law that is isotropic in the trial elastic strain
/// e_A = ln(values_A) / 2 of b = F G F^T, G fixed (theory.md, eq. 3.4-3.7). `principal` is the spectral form of b.
template <class S, class Shape, class Response>
void from_principal(const Spectral<S, Shape>& principal, const Tensor<S, Shape>& F_inverse,
                    const PrincipalStress<S>& stress, Response& out) {
  constexpr int size = Shape::size;
  const Tensor<S, Shape>& n = principal.directions;
  const Tensor<S, Shape> N = product(F_inverse, n);  // column A: F^-1 n_A
  const auto& b = principal.values;

  const Moduli<S, Shape> Q = to_principal_frame(n, N);
  for (int f = 0; f < size; ++f) {
    S sum = S(0);
    for (int A = 0; A < 3; ++A) sum += stress.tau[A] * Q(Shape::at(A, A), f);
    out.P.v[f] = sum;
  }

  // a: d(tau) - tau dl^T by dl. Principal components couple among themselves, each shear pair with its mirror.
  Moduli<S, Shape> aQ = Moduli<S, Shape>::Zero();
  const auto add_row = [&](int C, int D, const S& factor, int to) {
    for (int f = 0; f < size; ++f) aQ(to, f) += factor * Q(Shape::at(C, D), f);
  };
  for (int A = 0; A < 3; ++A)
    for (int B = 0; B < 3; ++B)
      add_row(B, B, S(stress.dtau_de(A, B) - (A == B ? stress.tau[A] : S(0))), Shape::at(A, A));
  for (int a = 0; a < size; ++a) {
    const auto [A, B] = Shape::pairs[std::size_t(a)];
    if (A == B) continue;
    const S t = stress.secant * S(0.5) * log_difference(b[A], b[B]);  // (tau_A - tau_B) / (b_A - b_B)
    add_row(A, B, t * b[B], a);
    add_row(B, A, t * b[A] - stress.tau[A], a);
  }
  // Eigen's, not a loop: in space it saves a twentieth of the element.
  out.dP_dF.noalias() = Q.transpose().lazyProduct(aQ);
}

}  // namespace stickslip
