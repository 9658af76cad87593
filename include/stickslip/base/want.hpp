// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace stickslip {

/// What an evaluation is asked for. The residual is the same, bit for bit, either way.
enum class Want : unsigned char {
  residual,             ///< forces and memory alone
  tangent,              ///< and their derivative
  frictionless_tangent  ///< and their derivative but for that of friction
};

}  // namespace stickslip
