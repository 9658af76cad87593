// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <stickslip/linear_solver/umfpack.hpp>

[[maybe_unused]] static const bool umfpack = bench::offer<stickslip::Umfpack>("Umfpack");
