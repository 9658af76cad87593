// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <stickslip/linear_solver/mumps.hpp>

[[maybe_unused]] static const bool mumps_ldlt = bench::offer<stickslip::MumpsLdlt>("MumpsLdlt");
[[maybe_unused]] static const bool mumps_lu = bench::offer<stickslip::MumpsLu>("MumpsLu");
