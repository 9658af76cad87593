// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/dual.hpp>

#include <doctest/doctest.h>

#include <vector>

// What holds for every hardening law.
namespace hardening_check {

using namespace stickslip;

/// Slope against differences of the value, the derivative of a dual number against the slope, work against Gauss'
/// rule, at the plastic strains given; 0 is added for all but the differences.
template <class Law>
void calculus(const Law& law, const std::vector<Real>& strains) {
  static_assert(HardeningPolicy<Law>);
  CHECK(law.work(0) == 0);
  Real from = 0;
  for (const Real p : strains) {
    CAPTURE(p);
    const Real h = 1e-4 * p;
    const auto value = [&](Real x) { return law.flow(x).value; };
    const Real by_differences = (8 * (value(p + h) - value(p - h)) - (value(p + 2 * h) - value(p - 2 * h))) / (12 * h);
    CHECK(law.flow(p).slope == doctest::Approx(by_differences).epsilon(1e-8).scale(value(p)));
    for (const Real at : {0.0, p}) {
      const FlowStress<Dual<1>> dual = law.flow(Dual<1>::variable(at, 0));
      CHECK(dual.value.value == value(at));
      CHECK(dual.slope.value == law.flow(at).slope);
      CHECK(dual.value.slope[0] == doctest::Approx(law.flow(at).slope).epsilon(1e-14));
    }
    Real integral = 0;  // two points a piece, many pieces
    const int pieces = 20000;
    for (int k = 0; k < pieces; ++k)
      for (const Real x : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)})
        integral += 0.5 * (p - from) / pieces * value(from + (p - from) * (k + x) / pieces);
    CHECK(law.work(p) - law.work(from) == doctest::Approx(integral).epsilon(1e-10));
    from = p;
  }
}

}  // namespace hardening_check
