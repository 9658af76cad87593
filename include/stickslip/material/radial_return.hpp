// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/material/log_strain.hpp>
#include <stickslip/policy/material.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// Result of the radial return of a J2 trial stress (theory.md, eq. 3.10-3.12).
template <class S>
struct RadialReturn {
  S ratio = S(1);           ///< |dev tau| over its trial value [-]
  S softening = S(0);       ///< reduction of the consistent tangent along the trial deviator, over 2 shear [-]
  S plastic_strain = S(0);  ///< accumulated, at the end of the step [-]
  bool flows = false;
  FailureCause cause = FailureCause::none;
};

namespace detail {
/// Solves trial - 3 shear d - sigma(p + d) = 0 for d in (0, trial / (3 shear)): Newton's method in a shrinking bracket,
/// because the power law is very steep at its start. A last step squares the error and propagates the derivatives of a
/// dual number.
template <class S, class Hardening>
auto return_map(const Hardening& hardening, const S& trial, const S& p, const FlowStress<S>& now, Real shear) {
  struct Return {
    S increment, slope;
    FailureCause cause;
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
    if (last)
      return Return{d, flow.slope, value_of(flow.value) > 0 ? FailureCause::none : FailureCause::material_failed};
  }
  return Return{d, flow.slope, FailureCause::material_failed};
}
}  // namespace detail

/// Returns a trial stress to the yield surface; `cause` reports a failure. `squared` is |dev tau / (2 shear)|^2 of the
/// trial [-], `p` the accumulated plastic strain at the start of the step [-], `shear` the shear modulus [stress].
template <class S, class Hardening>
RadialReturn<S> radial_return(const Hardening& hardening, const S& squared, const S& p, Real shear) {
  using std::sqrt;
  RadialReturn<S> out;
  out.plastic_strain = p;
  const FlowStress<S> now = hardening.flow(p);
  if (!(value_of(now.value) > 0)) {  // fully softened: no yield surface is left
    out.cause = FailureCause::material_failed;
    return out;
  }
  if (!(value_of(squared) * 6 * shear * shear > value_of(now.value) * value_of(now.value))) return out;
  const S trial = sqrt(squared * S(6)) * shear;  // von Mises equivalent of the trial stress
  const auto r = detail::return_map(hardening, trial, p, now, shear);
  out.flows = true;
  out.cause = r.cause;
  out.ratio = S(1) - S(3 * shear) * r.increment / trial;
  out.softening = (S(3 * shear) / (S(3 * shear) + r.slope) - S(3 * shear) * r.increment / trial) / squared;
  out.plastic_strain = p + r.increment;
  return out;
}

/// Throws std::invalid_argument, naming the parameter, if one of a J2 law is invalid.
template <class Hardening>
void validate_j2(Real young, Real poisson, const Hardening& hardening) {
  ElasticModuli::validate(young, poisson);
  if constexpr (requires { hardening.validate(); }) hardening.validate();
  if (!(hardening.flow(Real(0)).slope > -3 * ElasticModuli::from(young, poisson).shear))
    throw std::invalid_argument(
        "material: the hardening softens faster than 3 times the shear modulus; no stress follows");
}

}  // namespace stickslip
