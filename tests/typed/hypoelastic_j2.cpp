// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <doctest/doctest.h>

TEST_CASE("Hypoelastic J2 plasticity: 24 of the 36 valid bundles press, drag, balance and agree over solvers") {
  CHECK(typed::run_all<stickslip::HypoelasticJ2<stickslip::LinearHardening>>() == 24);
}
