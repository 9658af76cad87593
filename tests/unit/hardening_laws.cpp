// SPDX-License-Identifier: BSL-1.0
// Every hardening law: its slope is the derivative of its value, its work the integral, its sentences name the input.
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/tensor/dual.hpp>

#include "hardening_check.hpp"

#include <doctest/doctest.h>

namespace {

using namespace stickslip;

const PerfectPlasticity perfect{.yield = 250};
const LinearHardening linear{.yield = 31, .modulus = 261.2};
const SwiftHardening swift{.strength = 589, .offset = 1e-2, .exponent = 0.216};
const VoceHardening voce{.yield = 450, .saturation = 715, .rate = 16.93, .modulus = 129.24};

TEST_CASE("slope, dual derivative and work of the hardening laws agree with the flow stress") {
  const std::vector<Real> strains{1e-3, 0.02, 0.3, 2};
  hardening_check::calculus(perfect, strains);
  hardening_check::calculus(linear, strains);
  hardening_check::calculus(swift, strains);
  hardening_check::calculus(voce, strains);
  hardening_check::calculus(VoceHardening{.yield = 300, .saturation = 200, .rate = 5}, strains);
}
TEST_CASE("Voce's law starts at yield, ends at saturation and is halfway at ln 2 / rate") {
  const VoceHardening pure{.yield = 100, .saturation = 250, .rate = 8};
  CHECK(pure.flow(0.0).value == 100);
  CHECK(pure.flow(0.0).slope == doctest::Approx(1200).epsilon(1e-15));
  CHECK(pure.flow(std::log(2) / 8).value == doctest::Approx(175).epsilon(1e-14));
  CHECK(pure.flow(10.0).value == doctest::Approx(250).epsilon(1e-14));
  // Simo's necking bar, after 0.1 of plastic strain.
  CHECK(voce.flow(0.1).value == doctest::Approx(715 - 265 * std::exp(-1.693) + 12.924).epsilon(1e-14));
  CHECK(pure.work(1e-9) == doctest::Approx(1e-7).epsilon(1e-6));
}
TEST_CASE("Swift's law and perfect plasticity have the values of their formulas") {
  CHECK(swift.flow(0.0).value == doctest::Approx(589 * std::pow(1e-2, 0.216)).epsilon(1e-15));
  CHECK(swift.flow(0.99).value == doctest::Approx(589).epsilon(1e-15));
  CHECK(swift.flow(0.99).slope == doctest::Approx(0.216 * 589).epsilon(1e-15));
  CHECK(perfect.flow(0.7).value == 250);
  CHECK(perfect.flow(0.7).slope == 0);
  CHECK(perfect.work(0.7) == doctest::Approx(175).epsilon(1e-15));
}
TEST_CASE("perfect plasticity is linear hardening without a modulus, bit for bit") {
  const FiniteJ2<PerfectPlasticity> a{.young = 69e3, .poisson = 0.3, .hardening = {.yield = 30}};
  const FiniteJ2<LinearHardening> b{.young = 69e3, .poisson = 0.3, .hardening = {.yield = 30}};
  Tensor<Real, Planar> F = Tensor<Real, Planar>::identity();
  F(0, 1) = 0.3;
  CHECK(a.respond(F, {}, 1).P.v == b.respond(F, {}, 1).P.v);
}
TEST_CASE("a wrong parameter of a hardening law is named") {
  CHECK_THROWS_WITH_AS(PerfectPlasticity{}.validate(), "perfect plasticity: the yield stress must be positive",
                       std::invalid_argument);
  const auto refuses = [](VoceHardening law, const char* sentence) {
    CHECK_THROWS_WITH_AS(law.validate(), sentence, std::invalid_argument);
  };
  CHECK_NOTHROW(voce.validate());
  refuses({.yield = 0, .saturation = 1, .rate = 1}, "Voce hardening: the yield stress must be positive");
  refuses({.yield = 1, .saturation = -1, .rate = 1}, "Voce hardening: the saturation stress must be positive");
  refuses({.yield = 1, .saturation = 2}, "Voce hardening: the rate must be positive");
  refuses({.yield = 1, .saturation = 2, .rate = 1, .modulus = NAN}, "Voce hardening: the modulus must be finite");
}

}  // namespace
