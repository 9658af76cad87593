// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/profile.hpp>

namespace stickslip::rigid {

namespace detail {
template <int dim>
struct DefaultTool;
template <>
struct DefaultTool<2> {
  using type = Profile;
};
}  // namespace detail

/// The kind of tool of a bundle that names none.
template <int dim>
using Tool = typename detail::DefaultTool<dim>::type;

}  // namespace stickslip::rigid
