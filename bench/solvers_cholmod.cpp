// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <stickslip/linear_solver/cholmod.hpp>

[[maybe_unused]] static const bool cholmod = bench::offer<stickslip::Cholmod>("Cholmod");
