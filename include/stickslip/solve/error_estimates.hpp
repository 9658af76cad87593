// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/types.hpp>

#include <cmath>

namespace stickslip {

/// What a step is estimated to err by [-] (theory.md, section 6.6). Lag, time and penetration are work over the work
/// that the step takes, which under one drive is the error of its force; space is an error of the stress.
struct ErrorEstimates {
  Real lag = 0;          ///< the friction bounds' lag; 0 for laws that follow the current pressure
  Real time = 0;         ///< the size of the step
  Real penetration = 0;  ///< tools that give way
  Real space = 0;        ///< the mesh; only where MarchOptions::mesh_error_interval asks for it

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("lag", self.lag);
    visit("time", self.time);
    visit("penetration", self.penetration);
    visit("space", self.space);
  }
};

/// Predicts the force along a path, work over time, from the last two steps (theory.md, eq. 6.18).
class ForcePredictor {
 public:
  /// Half the part of a step's force that was not to be expected [-]; 0 while there is nothing to expect it by.
  Real error(Real work, Real dt) const {
    if (steps_ < 2 || !(work > 0)) return 0;
    const Real force = work / dt;
    return 0.5 * std::abs(force - last_ - dt * rate_) / force;
  }
  /// Takes a step that has been accepted.
  void take(Real work, Real dt) {
    const Real force = work / dt;
    rate_ = (force - last_) / dt;
    last_ = force;
    ++steps_;
  }

  void serialize(Archive& archive) {
    archive("predictor, force", last_);
    archive("predictor, rate", rate_);
    archive("predictor, steps", steps_);
  }

 private:
  Real last_ = 0, rate_ = 0;
  Index steps_ = 0;
};

}  // namespace stickslip
