// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

namespace stickslip {

/// Convergence criterion and iteration limit of an iterative solver. The default keeps Newton's convergence quadratic.
/// For other values derive a solver whose constructor sets its `limits`.
struct IterationLimits {
  Real tolerance = 1e-10;   ///< of the residual, relative to the right-hand side
  Index iterations = 5000;  ///< largest number
};

}  // namespace stickslip
