// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

#include <type_traits>

namespace stickslip {

/// Eigen's L D L^T for symmetric systems, its LU for the others: needs only Eigen and accepts every model.
struct EigenDirect {
  using Role = role::LinearSolver;
  template <Symmetry system>
  using For = std::conditional_t<system == Symmetry::symmetric, EigenLdlt, EigenLu>;
};

}  // namespace stickslip
