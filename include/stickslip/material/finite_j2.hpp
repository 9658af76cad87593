// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/log_strain.hpp>
#include <stickslip/policy/material.hpp>

#include <cmath>

namespace stickslip {

/// Multiplicative J2 plasticity with isotropic hardening: F = Fe Fp, Hencky elasticity, exponential return map in
/// principal axes, exact algorithmic tangent (theory.md, section 3.3). Plastic flow keeps the volume to round-off.
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

  template <class S, class Shape>
  struct State {
    SymmetricTensor<S, Shape> Cp_inverse = SymmetricTensor<S, Shape>::identity();  ///< (Fp^T Fp)^-1
    S plastic_strain = S(0);                                                       ///< accumulated, p
  };

  template <class S, class Shape>
  MaterialResponse<S, Shape, State<S, Shape>> respond(const Tensor<S, Shape>& F, const State<S, Shape>& old,
                                                      Real) const {
    using std::exp, std::log, std::sqrt;
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Tensor<S, Shape> F_inverse = inverse(F);
    const Spectral<S, Shape> b = spectral(product(product(F, old.Cp_inverse.full()), transpose(F)));

    Vec<S, 3> e;
    for (int A = 0; A < 3; ++A) e[A] = S(0.5) * log(b.values[A]);
    const S volumetric = e[0] + e[1] + e[2];
    const Vec<S, 3> deviator = e - Vec<S, 3>::Constant(volumetric / S(3));
    const S squared = deviator.squaredNorm();

    MaterialResponse<S, Shape, State<S, Shape>> out;
    out.state = old;
    PrincipalStress<S> stress;
    S ratio = S(1);      // |dev tau| over that of the trial: the secant of the return
    S softening = S(0);  // what the consistent tangent loses along the flow direction, over 2 shear
    const FlowStress<S> now = hardening.flow(old.plastic_strain);
    if (!(value_of(now.value) > 0)) {  // softened away: no stress follows
      out.cause = Cause::material_failed;
      return out;
    }
    if (value_of(squared) * 6 * shear * shear > value_of(now.value) * value_of(now.value)) {
      const S trial = sqrt(squared * S(6)) * shear;  // von Mises equivalent of the trial stress
      const auto r = return_map(trial, old.plastic_strain, now, shear);
      out.cause = r.cause;
      ratio = S(1) - S(3 * shear) * r.increment / trial;
      softening = (S(3 * shear) / (S(3 * shear) + r.slope) - S(3 * shear) * r.increment / trial) / squared;
      out.state.plastic_strain = old.plastic_strain + r.increment;
      // b_e = b exp(-2 increment flow direction); Cp^-1 = F^-1 b_e F^-T.
      const Tensor<S, Shape> N = product(F_inverse, b.directions);
      Vec<S, 3> be;
      for (int A = 0; A < 3; ++A) be[A] = b.values[A] * exp(S(-2) * (S(1) - ratio) * deviator[A]);
      for (int a = 0; a < Shape::symmetric_size; ++a) {
        const auto [i, j] = Shape::symmetric_pairs[std::size_t(a)];
        S sum = S(0);
        for (int A = 0; A < 3; ++A)
          if (Shape::couples(i, A) && Shape::couples(j, A)) sum += be[A] * N(i, A) * N(j, A);
        out.state.Cp_inverse.v[a] = sum;
      }
    }
    for (int A = 0; A < 3; ++A) {
      stress.tau[A] = S(2 * shear) * ratio * deviator[A] + S(bulk) * volumetric;
      for (int B = 0; B < 3; ++B)
        stress.dtau_de(A, B) =
            S(bulk) + S(2 * shear) * (ratio * S((A == B ? 1. : 0.) - 1. / 3) - softening * deviator[A] * deviator[B]);
    }
    stress.secant = S(2 * shear) * ratio;
    from_principal(b, F_inverse, stress, out);
    return out;
  }

  /// Elastic energy stored per reference volume at F and the memory `state`.
  template <class S, class Shape>
  S energy(const Tensor<S, Shape>& F, const State<S, Shape>& state) const {
    const auto [bulk, shear] = ElasticModuli::from(young, poisson);
    const Spectral<S, Shape> b = spectral(product(product(F, state.Cp_inverse.full()), transpose(F)));
    return hencky_energy(b, bulk, shear);
  }

  /// Plastic work per reference volume spent up to the memory `state`, where the hardening offers its integral.
  template <class Shape>
  Real plastic_work(const State<Real, Shape>& state) const
    requires requires { hardening.work(state.plastic_strain); }
  {
    return hardening.work(state.plastic_strain);
  }

  void validate() const {
    ElasticModuli::validate(young, poisson);
    if constexpr (requires { hardening.validate(); }) hardening.validate();
    if (!(hardening.flow(Real(0)).slope > -3 * ElasticModuli::from(young, poisson).shear))
      throw std::invalid_argument(
          "material: the hardening softens faster than 3 times the shear modulus; no stress follows");
  }

 private:
  /// Solves trial - 3 shear d - sigma(p + d) = 0 for d in (0, trial / (3 shear)): Newton's method inside a bracket that
  /// shrinks, for the power law starts almost vertically. One last step squares the error and carries the derivatives
  /// of a dual number.
  template <class S>
  auto return_map(const S& trial, const S& p, const FlowStress<S>& now, Real shear) const {
    struct Return {
      S increment, slope;
      Cause cause;
    };
    const Real tolerance = 1e-9 * value_of(trial);  // the last step squares it
    Real low = 0, high = value_of(trial) / (3 * shear);
    S d = S(0);
    FlowStress<S> flow = now;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const S excess = trial - S(3 * shear) * d - flow.value;
      (value_of(excess) > 0 ? low : high) = value_of(d);
      const bool last = std::abs(value_of(excess)) <= tolerance || high - low <= 1e-16 * high;
      S next = d + excess / (S(3 * shear) + flow.slope);
      if (!last && !(value_of(next) > low && value_of(next) < high)) next = S(0.5 * (low + high));
      d = next;
      flow = hardening.flow(S(p + d));
      if (last) return Return{d, flow.slope, value_of(flow.value) > 0 ? Cause::none : Cause::material_failed};
    }
    return Return{d, flow.slope, Cause::material_failed};
  }
};

}  // namespace stickslip
