// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

namespace stickslip {

/// When an iterative solver has arrived, and when it gives up. The default keeps Newton's convergence quadratic. For
/// others derive a solver whose constructor sets its `limits`.
struct IterationLimits {
  Real tolerance = 1e-10;   ///< of the residual, relative to the right-hand side
  Index iterations = 5000;  ///< at most
};

}  // namespace stickslip
