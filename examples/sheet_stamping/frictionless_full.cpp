// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

template int stamp<Stamping<stickslip::Frictionless, examples::ChosenFull>>(const examples::Options&);
