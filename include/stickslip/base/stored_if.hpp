// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <type_traits>

namespace stickslip {

/// Memory of an effect that the scene does not call for. As a `[[no_unique_address]]` member it takes no byte; the tag
/// keeps two absent effects of one owner apart, for two members of one empty type would need different addresses.
template <class Tag>
struct Empty {
  friend constexpr bool operator==(Empty, Empty) { return true; }
};

/// `T` where the effect is there, otherwise nothing.
template <bool present, class T, class Tag>
using StoredIf = std::conditional_t<present, T, Empty<Tag>>;

}  // namespace stickslip
