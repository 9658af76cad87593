// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <charconv>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace stickslip {

/// A number for a sentence, in at most so many significant digits: small ones stay what they are, and no locale has a
/// say.
inline std::string brief(Real x, int precision = 6) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof(digits), x, std::chars_format::general, precision).ptr};
}

/// Pieces of a sentence, joined. A function of its own: sentences are many, and nothing of them depends on the model.
[[gnu::noinline, gnu::cold]] inline std::string joined(std::initializer_list<std::string_view> pieces) {
  std::string text;
  for (const std::string_view piece : pieces) text += piece;
  return text;
}
/// Names in a sentence, with commas between them.
[[gnu::noinline, gnu::cold]] inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace stickslip
