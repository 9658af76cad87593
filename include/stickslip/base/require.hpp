// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

/// What parameters must be: std::invalid_argument with one sentence that begins with `what`, the input's name. NaN
/// meets none of it.
namespace stickslip::require {

inline void finite(Real x, const char* what) {
  if (!std::isfinite(x)) throw std::invalid_argument(what + std::string(" must be finite"));
}
inline void positive(Real x, const char* what) {
  if (!(x > 0)) throw std::invalid_argument(what + std::string(" must be positive"));
  finite(x, what);
}
inline void not_negative(Real x, const char* what) {
  if (!(x >= 0)) throw std::invalid_argument(what + std::string(" must not be negative"));
  finite(x, what);
}

}  // namespace stickslip::require
