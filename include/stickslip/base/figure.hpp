// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>
#include <charconv>
#include <string>

namespace stickslip {

/// A number for a sentence: two digits, of any magnitude, whatever the locale.
inline std::string figure(Real value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 2).ptr;
  return {text.data(), end};
}

}  // namespace stickslip
