// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/any_of.hpp>
#include <stickslip/geometry/extruded.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/geometry/revolution.hpp>

#include <type_traits>

namespace stickslip::rigid {

/// Default tool type of a model: a Profile in the plane, a Revolution or an Extruded in three dimensions.
template <int dim>
using Tool = std::conditional_t<dim == 2, Profile, AnyOf<Revolution, Extruded>>;

}  // namespace stickslip::rigid
