// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <stdexcept>
#include <string>

namespace stickslip {

/// Parameters of an iterative solver. The defaults keep Newton's convergence quadratic.
struct IterationLimits {
  Real tolerance = 1e-10;   ///< of the residual, relative to the right-hand side
  Index iterations = 5000;  ///< largest number

  /// Throws std::invalid_argument, naming what is wrong, on behalf of the solver `name`.
  void validate(const std::string& name) const {
    if (!(tolerance > 0 && tolerance < 1))
      throw std::invalid_argument(name + ": the tolerance must lie between 0 and 1");
    if (iterations < 1) throw std::invalid_argument(name + ": needs at least one iteration");
  }
};

}  // namespace stickslip
