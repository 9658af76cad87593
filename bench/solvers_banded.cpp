// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <stickslip/linear_solver/banded.hpp>

[[maybe_unused]] static const bool banded_cholesky = bench::offer<stickslip::BandedCholesky>("BandedCholesky");
[[maybe_unused]] static const bool banded_lu = bench::offer<stickslip::BandedLu>("BandedLu");
