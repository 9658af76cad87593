// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/policy/friction.hpp>
#include <stickslip/tensor/products.hpp>

#include <cmath>
#include <utility>

namespace stickslip {

/// Where the friction of a step ends: on the predictor, or back on the bound.
template <class S, int m>
struct FrictionReturn {
  Vec<S, m> traction = Vec<S, m>::Zero();    ///< t_F [force]
  Mat<S, m> d_surface = Mat<S, m>::Zero();   ///< d traction / d place [force / length]
  Vec<S, m> d_pressure = Vec<S, m>::Zero();  ///< d traction / d felt pressure [-]
  S slip_increment = S(0);                   ///< lambda, slid distance of the step [length]
  S bound = S(0);                            ///< at the end of the slide [force]
  bool sliding = false;
  FailureCause cause = FailureCause::none;
};

/// The bound of a law at a felt pressure and at the end of a slide; its d_slip is the whole derivative by the slide,
/// that of the speed slide / dt included (theory.md, eq. 5.19). In a step without duration there is no speed.
template <class Law, class S>
FrictionBound<S> bound_after(const Law& law, const S& pressure, const S& old_slip, [[maybe_unused]] const S& slide,
                             [[maybe_unused]] Real area, [[maybe_unused]] Real dt) {
  InterfaceState<S> point{pressure, old_slip};
  if constexpr (depends_on_area<Law>()) point.area = area;
  if constexpr (Law::depends_on_slip) point.accumulated_slip += slide;
  if constexpr (depends_on_rate<Law>()) {
    const Real per_time = dt > 0 ? 1 / dt : 0;
    point.rate = slide * per_time;
    FrictionBound<S> there = law.bound(point);
    there.d_slip += there.d_rate * per_time;
    return there;
  } else {
    return law.bound(point);
  }
}

namespace detail {

// The magnitude of one component is exact; a root would lose the derivative at zero.
template <class S, int m>
S magnitude(const Vec<S, m>& v) {
  using std::sqrt;
  if constexpr (m == 1)
    return value_of(v[0]) < 0 ? S(-v[0]) : S(v[0]);
  else {
    const S square = contraction(v, v);
    return value_of(square) > 0 ? S(sqrt(square)) : S(0);
  }
}

/// Inverse of a small symmetric positive definite matrix, on any scalar.
template <class S>
Mat<S, 3> inverse(const Mat<S, 3>& a) {
  Mat<S, 3> adjugate;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      adjugate(j, i) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  const S det = a(0, 0) * adjugate(0, 0) + a(0, 1) * adjugate(1, 0) + a(0, 2) * adjugate(2, 0);
  return scaled<S>(adjugate, S(1) / det);
}

}  // namespace detail

/// Whether a friction force of that size is within the bound (theory.md, eq. 5.3). Where nothing pulls yet and nothing
/// presses, it is if the bound will rise with the pressure.
template <class S>
bool sticks(const S& size, const FrictionBound<S>& bound) {
  return value_of(size) < value_of(bound.value) || (!(value_of(size) > 0) && value_of(bound.d_pressure) > 0);
}

/// Radial return to an isotropic bound, |t_F| = |trial| - stiffness lambda = bound(pressure, slip + lambda) (theory.md,
/// eq. 5.3-5.8). bound(slide) gives the FrictionBound.
template <class Law, class S, int m, class Bound>
FrictionReturn<S, m> radial_return(const Vec<S, m>& trial, const S& stiffness, Bound&& bound_at) {
  const S size = detail::magnitude<S, m>(trial);
  FrictionBound<S> bound = bound_at(S(0));
  FrictionReturn<S, m> out{.traction = trial, .d_surface = isotropic<m>(stiffness)};
  out.bound = bound.value;
  if (sticks(size, bound)) return out;
  out.sliding = true;
  S lambda = S(0);
  if (value_of(stiffness) > 0) lambda = (size - bound.value) / stiffness;
  if constexpr (Law::depends_on_slip || depends_on_rate<Law>()) {
    // The excess is not negative without a slide and not positive at size / stiffness: Newton's method between the
    // two, halving where it leaves them or would go up a slope (eq. 5.20).
    Real low = 0, high = value_of(size) / value_of(stiffness);
    bool converged = value_of(stiffness) <= 0;
    for (int i = 0; i < 60 && !converged; ++i) {
      bound = bound_at(lambda);
      const S excess = size - stiffness * lambda - bound.value;
      const S next = lambda + excess / (stiffness + bound.d_slip);
      converged = std::abs(value_of(excess)) <= 1e-14 * value_of(size);
      (value_of(excess) > 0 ? low : high) = value_of(lambda);
      lambda = converged || (value_of(next) > low && value_of(next) < high) ? next : S(0.5 * (low + high));
    }
    if (!converged) out.cause = FailureCause::friction_failed;
    // At the slide of the last step, which carries the derivatives of a dual number.
    bound = bound_at(lambda);
  }
  Vec<S, m> direction;
  for (int i = 0; i < m; ++i) direction[i] = value_of(size) > 0 ? S(trial[i] / size) : S(0);
  // A slide at which the bound falls faster than the stiffness unloads is not an equilibrium that could last; no
  // stiffness, no slip to solve for.
  const S resistance = stiffness + bound.d_slip;
  if (value_of(stiffness) > 0 && !(value_of(resistance) > 0)) out.cause = FailureCause::friction_failed;
  const S share = value_of(stiffness) > 0 ? S(stiffness / resistance) : S(0);
  const S ratio = value_of(size) > 0 ? S(bound.value / size) : S(0);
  out.traction = scaled(direction, bound.value);
  const S across = ratio * stiffness, along = share * bound.d_slip;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      const S n_n = direction[i] * direction[j];
      out.d_surface(i, j) = (S(i == j ? 1 : 0) - n_n) * across + n_n * along;
    }
  out.d_pressure = scaled<S>(direction, share * bound.d_pressure);
  out.slip_increment = lambda;
  out.bound = bound.value;
  return out;
}

/// Return to an elliptic bound, sqrt(t_F . M t_F) = bound, the slide along its outward normal M t_F: that of the
/// largest dissipation (theory.md, eq. 5.28-5.30).
template <class S>
FrictionReturn<S, 3> elliptic_return(const Vec<S, 3>& trial, const S& stiffness, const Mat<Real, 3>& metric,
                                     const FrictionBound<S>& bound) {
  using std::sqrt;
  FrictionReturn<S, 3> out{.traction = trial, .d_surface = isotropic<3>(stiffness)};
  out.bound = bound.value;
  Mat<S, 3> M;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) M(i, j) = S(metric(i, j));
  const S square = contraction(trial, product(M, trial));
  const S size = value_of(square) > 0 ? S(sqrt(square)) : S(0);
  if (sticks(size, bound)) return out;
  out.sliding = true;
  if (!(value_of(bound.value) > 0)) {  // nothing to bear
    out.traction.setZero();
    out.d_surface.setZero();
    out.slip_increment = value_of(stiffness) > 0 ? S(detail::magnitude<S, 3>(trial) / stiffness) : S(0);
    return out;
  }
  // |t(eta)| of t = (1 + eta M)^-1 trial is convex and falls: Newton's method from zero comes from one side.
  S eta = S(0);
  Mat<S, 3> A;
  Vec<S, 3> traction;
  bool converged = false, last = false;
  for (int i = 0; i < 100; ++i) {
    Mat<S, 3> to_trial = isotropic<3>(S(1));
    add(to_trial, M, eta);
    A = detail::inverse<S>(to_trial);
    traction = product(A, trial);
    const Vec<S, 3> pull = product(M, traction);
    const S now = sqrt(contraction(traction, pull));
    if (last) break;
    const S slope = contraction(pull, product(A, pull)) / now;
    converged = std::abs(value_of(now) - value_of(bound.value)) <= 1e-14 * value_of(size);
    last = converged;  // one step more carries the derivatives of a dual number
    eta += (now - bound.value) / slope;
  }
  if (!converged) out.cause = FailureCause::friction_failed;
  const Vec<S, 3> normal = scaled<S>(product(M, traction), S(1) / bound.value), along = product(A, normal);
  const S through = contraction(normal, along);
  out.traction = traction;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) out.d_surface(i, j) = (A(i, j) - along[i] * along[j] / through) * stiffness;
  out.d_pressure = scaled<S>(along, bound.d_pressure / through);
  out.slip_increment = value_of(stiffness) > 0 ? S(eta * bound.value / stiffness) : S(0);
  return out;
}

}  // namespace stickslip
