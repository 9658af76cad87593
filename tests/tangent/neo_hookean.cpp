// SPDX-License-Identifier: BSL-1.0
#include "planar.hpp"

#include <stickslip/material/hencky.hpp>
#include <stickslip/material/neo_hookean.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;

const NeoHookean rubber{.young = 6, .poisson = 0.4};
const Real shear = 6 / 2.8, lame = 6 * 0.4 / (1.4 * 0.2);
const std::vector<F2> gradients{gradient(1.2, 0.3, -0.1, 0.9, 1.1), gradient(0.5, 0.8, -0.6, 1.7, 0.7),
                                gradient(2.5, 0.1, 0, 0.4, 1),      gradient(0, -1.1, 0.9, 0, 1),
                                gradient(1.3, 0, 0, 1.3, 1),        F2::identity()};

TEST_CASE("the neo-Hookean law has an exact tangent, keeps no history and is objective") {
  static_assert(MaterialPolicy<NeoHookean, Planar>);
  for (const F2& F : gradients) {
    const auto r = verify::material_tangent<Planar>(rubber, {F});
    CHECK(r.by_duals < 1e-13);
    CHECK(r.by_differences < 1e-9);
    CHECK(r.asymmetry < 1e-14);
    CHECK(verify::material_memory<Planar>(rubber, {F}) == 0);
    if (F.v != F2::identity().v) CHECK(verify::material_objectivity<Planar>(rubber, {F}, 0.7) < 1e-13);
  }
}
TEST_CASE("neo-Hookean stress is the gradient of its energy") {
  for (std::size_t k = 0; k < 4; ++k) {
    Tensor<Dual<5>, Planar> dual;
    dual.v = verify::seeded<5>(gradients[k].v);
    const Vec<Real, 5> slope = rubber.energy(dual, {}).slope.matrix();
    CHECK(verify::relative_error(rubber.respond(gradients[k], {}, 1).P.v, slope) < 1e-12);
  }
  CHECK(rubber.energy(F2::identity(), {}) == 0);
}
TEST_CASE("the neo-Hookean energy keeps its digits at small strain") {
  const Real e = 1e-6;
  const F2 F = gradient(1 + e, 0, 0, 1, 1);
  const Real stretch = F(0, 0) - 1;
  CHECK(rubber.energy(F, {}) == doctest::Approx((shear + 0.5 * lame) * stretch * stretch).epsilon(1e-5));
}
// tau = shear (b - 1) + lame ln J 1, written out.
TEST_CASE("neo-Hookean simple shear has tau_12 = shear gamma and tau_11 = shear gamma^2 alone") {
  for (const Real gamma : {1e-4, 0.3, 2.0}) {
    const F2 F = gradient(1, gamma, 0, 1, 1);
    const F2 tau = kirchhoff(rubber.respond(F, {}, 1).P, F);
    CHECK(tau(0, 1) == doctest::Approx(shear * gamma).epsilon(1e-12));
    CHECK(tau(1, 0) == doctest::Approx(shear * gamma).epsilon(1e-12));
    CHECK(tau(0, 0) == doctest::Approx(shear * gamma * gamma).epsilon(1e-8));
    CHECK(std::abs(tau(1, 1)) < 1e-15 * 100);
    CHECK(std::abs(tau(2, 2)) < 1e-15 * 100);
  }
}
TEST_CASE("neo-Hookean uniaxial tension has no stress on the sides at the stretch of the closed formula") {
  for (const Real stretch : {0.4, 0.9, 1.5, 3.0}) {
    // shear (a^2 - 1) + lame ln(stretch a^2) = 0 for the stretch a of the sides
    Real low = 0.01, high = 10;
    for (int k = 0; k < 200; ++k) {
      const Real a = 0.5 * (low + high);
      (shear * (a * a - 1) + lame * std::log(stretch * a * a) > 0 ? high : low) = a;
    }
    const auto P = rubber.respond(gradient(stretch, 0, 0, low, low), {}, 1).P;
    CHECK(std::abs(P(1, 1)) < 1e-13);
    CHECK(std::abs(P(2, 2)) < 1e-13);
    CHECK(P(0, 0) == doctest::Approx(shear * (stretch - low * low / stretch)).epsilon(1e-12));
  }
}
TEST_CASE("the neo-Hookean law is Hencky's at small strain") {
  const Hencky hencky{.young = 6, .poisson = 0.4};
  const F2 F = gradient(1 + 2e-6, 1e-6, -3e-6, 1 - 1e-6, 1 + 4e-6);
  CHECK(verify::relative_error(rubber.respond(F, {}, 1).P.v, hencky.respond(F, {}, 1).P.v) < 1e-4);
  const F2 one = F2::identity();
  CHECK(verify::relative_error(rubber.respond(one, {}, 1).dP_dF, hencky.respond(one, {}, 1).dP_dF) < 1e-14);
}
TEST_CASE("a wrong parameter of the neo-Hookean law is named") {
  CHECK_NOTHROW(rubber.validate());
  CHECK_THROWS_WITH_AS((NeoHookean{.young = 0, .poisson = 0.3}.validate()),
                       "material: Young's modulus must be positive", std::invalid_argument);
  CHECK_THROWS_WITH_AS((NeoHookean{.young = 1, .poisson = -0.1}.validate()),
                       "neo-Hookean: Poisson's ratio must not be negative, or the energy has no lower bound",
                       std::invalid_argument);
}

}  // namespace
