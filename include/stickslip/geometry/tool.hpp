// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/any_of.hpp>
#include <stickslip/geometry/extruded.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/geometry/revolution.hpp>

#include <type_traits>

namespace stickslip::rigid {

/// The kind of tool of a bundle that names none: a profile in a section, in space what profiles make.
template <int dim>
using Tool = std::conditional_t<dim == 2, Profile, AnyOf<Revolution, Extruded>>;

}  // namespace stickslip::rigid
