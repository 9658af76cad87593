// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

/// What parameters must be: std::invalid_argument with one sentence that begins with `what`, the input's name. NaN
/// meets none of it.
namespace stickslip::require {

[[noreturn, gnu::cold, gnu::noinline]] inline void refuse(const char* what, const char* rule) {
  throw std::invalid_argument(what + std::string(rule));
}
inline void finite(Real x, const char* what) {
  if (!std::isfinite(x)) refuse(what, " must be finite");
}
inline void positive(Real x, const char* what) {
  if (!(x > 0)) refuse(what, " must be positive");
  finite(x, what);
}
inline void not_negative(Real x, const char* what) {
  if (!(x >= 0)) refuse(what, " must not be negative");
  finite(x, what);
}

}  // namespace stickslip::require
