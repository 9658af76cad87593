// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace stickslip {

/// Structure of a tangent matrix. Known at compile time, it chooses the storage and admits the solvers. It says nothing
/// of definiteness: buckling and contact make symmetric tangents indefinite.
enum class Symmetry { symmetric, general };

/// Symmetry of a sum of tangents: symmetric only when every term is.
template <class... S>
constexpr Symmetry widest(S... terms) {
  return ((terms == Symmetry::symmetric) && ...) ? Symmetry::symmetric : Symmetry::general;
}

}  // namespace stickslip
