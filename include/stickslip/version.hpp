// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string_view>

namespace stickslip {

/// Version of the library; until 1.0 a change of `version_minor` may change names.
inline constexpr int version_major = 0, version_minor = 1, version_patch = 0;
/// The three numbers as text.
inline constexpr std::string_view version = "0.1.0";

}  // namespace stickslip
