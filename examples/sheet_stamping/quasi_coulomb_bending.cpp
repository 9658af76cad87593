// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

template int stamp<SolvedStamping<stickslip::QuasiCoulomb, stickslip::run_time::Takes::triangle,
                                  stickslip::AssumedStrain<stickslip::Hex8>>>(const examples::Options&);
