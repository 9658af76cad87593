// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <charconv>
#include <string>

namespace stickslip {

/// A number for a sentence, in at most so many significant digits: small ones stay what they are, and no locale has a
/// say.
inline std::string brief(Real x, int precision = 6) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof(digits), x, std::chars_format::general, precision).ptr};
}

}  // namespace stickslip
