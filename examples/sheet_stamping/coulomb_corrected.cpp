// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

template int stamp<Stamping<stickslip::Coulomb, examples::ChosenCorrected>>(const examples::Options&);
