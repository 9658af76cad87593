// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/require.hpp>
#include <stickslip/policy/time_integration.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Chung & Hulbert's second-order scheme (1993), parameterised by the spectral radius at infinite frequency [-]: 1
/// dissipates nothing, 0 annihilates the highest frequencies in one step. Throws std::invalid_argument outside [0, 1].
inline TimeScheme chung_hulbert(Real spectral_radius) {
  if (!(spectral_radius >= 0 && spectral_radius <= 1))
    throw std::invalid_argument("generalised-alpha: the spectral radius must lie between 0 and 1");
  const Real alpha_m = (2 * spectral_radius - 1) / (spectral_radius + 1),
             alpha_f = spectral_radius / (spectral_radius + 1);
  const Real sum = 1 - alpha_m + alpha_f;
  return {alpha_m, alpha_f, 0.25 * sum * sum, 0.5 - alpha_m + alpha_f};
}

/// Newmark's scheme; the defaults are the trapezoidal rule. Throws std::invalid_argument for beta <= 0, gamma < 1/2.
inline TimeScheme newmark(Real beta = 0.25, Real gamma = 0.5) {
  if (!(beta > 0 && gamma >= 0.5 && std::isfinite(beta) && std::isfinite(gamma)))
    throw std::invalid_argument("Newmark: beta must be positive and gamma at least 1/2, both finite");
  return {0, 0, beta, gamma};
}

/// Hilber, Hughes & Taylor's scheme; alpha from 0 (trapezoidal rule) to 1/3. Throws std::invalid_argument outside.
inline TimeScheme hht(Real alpha) {
  if (!(alpha >= 0 && alpha <= Real(1) / 3)) throw std::invalid_argument("HHT: alpha must lie between 0 and 1/3");
  return {0, alpha, 0.25 * (1 + alpha) * (1 + alpha), 0.5 + alpha};
}

/// Implicit dynamics by the generalised-alpha method. The mass matrix is consistent, or with `lumped` its row sums.
struct GeneralizedAlpha {
  using Role = role::TimeIntegration;
  static constexpr bool active = true;

  TimeScheme scheme = chung_hulbert(0.5);  ///< or newmark(), hht(alpha)
  bool lumped = false;

  void validate() const {
    require::positive(scheme.beta, "inertia: the scheme's beta");
    require::finite(scheme.gamma, "inertia: the scheme's gamma");
    require::finite(scheme.alpha_m, "inertia: the scheme's alpha_m");
    require::finite(scheme.alpha_f, "inertia: the scheme's alpha_f");
    if (!(scheme.alpha_m < 1 && scheme.alpha_f < 1))
      throw std::invalid_argument("inertia: the scheme's alpha_m and alpha_f must lie below 1");
  }
};

}  // namespace stickslip
