// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <doctest/doctest.h>

TEST_CASE("Neo-Hookean: 24 of the 60 valid bundles press, drag, balance and agree over solvers") {
  CHECK(typed::run_all<stickslip::NeoHookean>() == 24);
}
