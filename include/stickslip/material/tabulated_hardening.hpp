// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/flow_points.hpp>
#include <stickslip/policy/material.hpp>

#include <math.h>  // Boost 1.74 calls isnan without a namespace

#include <boost/math/interpolators/pchip.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// Flow stress beyond the last point of a table.
enum class BeyondTable {
  constant,  ///< stress of the last point: perfect plasticity; the slope jumps to zero
  linear     ///< straight line with the slope of the last two points
};

/// Flow stress through measured points: monotone cubic interpolation (theory.md, eq. 3.15; PCHIP of Boost.Math),
/// without extrema between the points. Value and slope are continuous up to the last point.
class TabulatedHardening {
 public:
  using Role = role::Hardening;

  TabulatedHardening() = default;
  /// Points of ascending plastic strain from zero. Throws std::invalid_argument for the first fault (fault_of).
  TabulatedHardening(std::vector<FlowPoint> points, BeyondTable beyond = BeyondTable::constant)
      : points_(std::move(points)), beyond_(beyond) {
    validate();
    std::vector<Real> strain, stress;
    for (const FlowPoint& point : points_) {
      strain.push_back(point.strain);
      stress.push_back(point.stress);
    }
    curve_.emplace(std::move(strain), std::move(stress));
    work_.push_back(0);
    for (std::size_t k = 1; k < points_.size(); ++k) work_.push_back(work_[k - 1] + piece(k - 1, points_[k].strain));
  }

  /// For a dual p the value carries the derivative; the slope carries none.
  template <class S>
  FlowStress<S> flow(const S& p) const {
    const FlowStress<Real> at = read(value_of(p));
    return {S(at.value) + at.slope * (p - S(value_of(p))), S(at.slope)};
  }
  /// Plastic work per reference volume up to p, the integral of the flow stress [stress].
  Real work(Real p) const {
    const FlowPoint& last = points_.back();
    if (p >= last.strain) return work_.back() + 0.5 * (p - last.strain) * (last.stress + read(p).value);
    std::size_t k = points_.size() - 2;
    while (k > 0 && p < points_[k].strain) --k;
    return work_[k] + piece(k, p);
  }
  void validate() const {
    if (const auto fault = fault_of(points_))
      throw std::invalid_argument(
          "tabulated hardening: " + fault->what +
          (fault->point.value_or(0) > 0 ? ", see point " + std::to_string(*fault->point + 1) : ""));
  }

 private:
  FlowStress<Real> read(Real p) const {
    const FlowPoint& last = points_.back();
    if (p < last.strain) return {(*curve_)(p), curve_->prime(p)};
    const Real slope = beyond_ == BeyondTable::linear ? curve_->prime(last.strain) : 0;
    return {last.stress + slope * (p - last.strain), slope};
  }
  // Work from point k to p in the same interval. Simpson's rule is exact for a cubic.
  Real piece(std::size_t k, Real p) const {
    const Real from = points_[k].strain;
    return (p - from) / 6 * (points_[k].stress + 4 * read(0.5 * (from + p)).value + read(p).value);
  }

  std::vector<FlowPoint> points_;
  BeyondTable beyond_ = BeyondTable::constant;
  std::vector<Real> work_;  // up to each point
  std::optional<boost::math::interpolators::pchip<std::vector<Real>>> curve_;
};

}  // namespace stickslip
