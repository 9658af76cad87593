// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/material/log_strain.hpp>
#include <stickslip/policy/material.hpp>

#include <cmath>
#include <stdexcept>

namespace stickslip {

/// What the return to the yield surface of J2 plasticity leaves of a trial stress (theory.md, eq. 3.9-3.11).
template <class S>
struct RadialReturn {
  S ratio = S(1);           ///< |dev tau| over that of the trial: the secant of the return [-]
  S softening = S(0);       ///< what the consistent tangent loses along the trial deviator, over 2 shear [-]
  S plastic_strain = S(0);  ///< accumulated, at the end of the step [-]
  bool flows = false;
  Cause cause = Cause::none;
};

namespace detail {
/// Solves trial - 3 shear d - sigma(p + d) = 0 for d in (0, trial / (3 shear)): Newton's method inside a bracket that
/// shrinks, for the power law starts almost vertically. One last step squares the error and carries the derivatives
/// of a dual number.
template <class S, class Hardening>
auto return_map(const Hardening& hardening, const S& trial, const S& p, const FlowStress<S>& now, Real shear) {
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
}  // namespace detail

/// Returns a trial stress to the yield surface. `squared` is |dev tau / (2 shear)|^2 of the trial, `p` the plastic
/// strain at the start of the step.
template <class S, class Hardening>
RadialReturn<S> radial_return(const Hardening& hardening, const S& squared, const S& p, Real shear) {
  using std::sqrt;
  RadialReturn<S> out;
  out.plastic_strain = p;
  const FlowStress<S> now = hardening.flow(p);
  if (!(value_of(now.value) > 0)) {  // softened away: no stress follows
    out.cause = Cause::material_failed;
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

/// Parameters of a J2 law: throws a sentence that names the wrong one.
template <class Hardening>
void validate_j2(Real young, Real poisson, const Hardening& hardening) {
  ElasticModuli::validate(young, poisson);
  if constexpr (requires { hardening.validate(); }) hardening.validate();
  if (!(hardening.flow(Real(0)).slope > -3 * ElasticModuli::from(young, poisson).shear))
    throw std::invalid_argument(
        "material: the hardening softens faster than 3 times the shear modulus; no stress follows");
}

}  // namespace stickslip
