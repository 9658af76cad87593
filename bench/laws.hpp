// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/material/neo_hookean.hpp>

namespace bench {

using J2Linear = stickslip::FiniteJ2<stickslip::LinearHardening>;
using J2Power = stickslip::FiniteJ2<stickslip::PowerHardening>;
using HypoLinear = stickslip::HypoelasticJ2<stickslip::LinearHardening>;

// The sheet of the punch stretching test, in MPa.
template <class Material>
Material sheet_metal() {
  return {.young = 69004, .poisson = 0.3};
}
template <>
inline J2Linear sheet_metal() {
  return {.young = 69004, .poisson = 0.3, .hardening = {.yield = 80, .modulus = 800}};
}
template <>
inline HypoLinear sheet_metal() {
  return {.young = 69004, .poisson = 0.3, .hardening = {.yield = 80, .modulus = 800}};
}
template <>
inline J2Power sheet_metal() {
  return {.young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};
}

// Strains well below and well above yield.
inline constexpr double elastic = 2e-4;
inline constexpr double plastic = 2e-2;

}  // namespace bench
