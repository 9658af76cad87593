// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/bicgstab.hpp>
#include <stickslip/linear_solver/conjugate_gradients.hpp>

#include <type_traits>

namespace stickslip {

/// Preconditioned conjugate gradients for symmetric systems, BiCGSTAB for the others: for solids too large to
/// factorise. Needs only Eigen.
struct EigenIterative {
  using Role = role::LinearSolver;
  template <Symmetry system>
  using For = std::conditional_t<system == Symmetry::symmetric, ConjugateGradients, Bicgstab>;
};

}  // namespace stickslip
