// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <stickslip/linear_solver/eigen_iterative.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

[[maybe_unused]] static const bool eigen_ldlt = bench::offer<stickslip::EigenLdlt>("EigenLdlt");
[[maybe_unused]] static const bool eigen_lu = bench::offer<stickslip::EigenLu>("EigenLu");
[[maybe_unused]] static const bool conjugate_gradients =
    bench::offer<stickslip::ConjugateGradients>("ConjugateGradients");
[[maybe_unused]] static const bool bicgstab = bench::offer<stickslip::Bicgstab>("Bicgstab");
