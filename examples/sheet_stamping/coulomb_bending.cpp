// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

template int
stamp<SolvedStamping<stickslip::Coulomb, stickslip::run_time::Takes::full, stickslip::AssumedStrain<stickslip::Hex8>>>(
    const examples::Options&);
