// SPDX-License-Identifier: BSL-1.0
#include "planar.hpp"

#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;
using Path = verify::DeformationPath<Planar>;

using Linear = HypoelasticJ2<LinearHardening>;
using Voce = HypoelasticJ2<VoceHardening>;
const Linear linear{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 30, .modulus = 260}};
const Linear elastic{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 1e9, .modulus = 0}};
const Voce voce{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 100, .saturation = 250, .rate = 10}};

// The last steps of the long paths turn the principal axes: the old stress is not coaxial with the step.
const std::vector<Path> paths{
    {gradient(1.2, 0.3, -0.1, 0.9, 1.1)},
    {gradient(1.1, 0, 0.2, 0.95, 1), gradient(1.4, 0.3, 0.2, 0.8, 1.05)},
    {gradient(1.01, 0.02, 0, 1, 1), gradient(1.3, -0.4, 0.3, 0.9, 0.8), gradient(1.9, -0.4, 0.6, 0.7, 0.7)},
    {gradient(1.2, 0.3, -0.1, 0.9, 1.1), gradient(0.1, -1.1, 0.9, 0.2, 1)},  // a quarter turn
};

template <class Material>
bool flows(const Material& material, const Path& path) {
  const auto old = verify::detail::preloaded<Real, Planar>(material, path, 1);
  return material.respond(path.back(), old, 1).state.plastic_strain > old.plastic_strain;
}
// What a path of `steps` equal steps of F(t), t from 0 to 1, ends in: answer and work done.
template <class Material, class Motion>
auto follow(const Material& material, Motion&& F, int steps) {
  struct {
    MaterialResponse<Real, Planar, typename Material::template State<Real, Planar>> answer;
    Real work = 0;
    F2 tau;
  } r;
  F2 P, before = F(Real(0));
  for (int k = 1; k <= steps; ++k) {
    const F2 now = F(Real(k) / steps);
    r.answer = material.respond(now, r.answer.state, 1);
    r.work += 0.5 * (P.v + r.answer.P.v).dot(now.v - before.v);
    P = r.answer.P;
    before = now;
  }
  r.tau = kirchhoff(r.answer.P, before);
  return r;
}
F2 shear(Real gamma) {
  return gradient(1, gamma, 0, 1, 1);
}

template <class Material>
void check(const Material& material, const Path& path) {
  const auto r = verify::material_tangent(material, path);
  CHECK(r.by_duals < 1e-10);
  CHECK(r.by_differences < 1e-8);
  CHECK(verify::material_memory(material, path) < 1e-10);
  CHECK(verify::material_objectivity(material, path, 0.7) < 1e-11);
  CHECK(verify::material_objectivity(material, path, 2.9) < 1e-11);
}
TEST_CASE("hypoelastic J2 has an exact tangent and history and is objective, elastic and in flow") {
  static_assert(MaterialPolicy<Linear, Planar>);
  for (const Path& path : paths) {
    CHECK(flows(linear, path));
    CHECK(flows(voce, path));
    CHECK_FALSE(flows(elastic, path));
    check(linear, path);
    check(voce, path);
    check(elastic, path);
  }
}
TEST_CASE("hypoelastic J2's tangent is exact for steps without stretch or with equal stretches") {
  const F2 G = gradient(1.2, 0.3, -0.1, 0.9, 1.1);
  for (const F2& step :
       {F2::identity(), verify::rotation<Planar>(0.6), gradient(1.1, 0, 0, 1.1, 0.95), gradient(0, -1.1, 1.1, 0, 1)}) {
    CHECK(verify::material_tangent<Planar>(elastic, {G, product(step, G)}).by_differences < 1e-9);
    if (determinant(step) > 1.01) {
      CHECK(flows(linear, {G, product(step, G)}));
      CHECK(verify::material_tangent<Planar>(linear, {G, product(step, G)}).by_differences < 1e-8);
    }
  }
}
TEST_CASE("under hypoelastic J2 a rotation only rotates the stress") {
  const auto before = verify::detail::preloaded<Real, Planar>(voce, {paths[0][0], F2::identity()}, 1);
  for (const Real angle : {0.3, pi / 2, 3.0}) {
    const F2 Q = verify::rotation<Planar>(angle);
    const auto after = voce.respond(product(Q, paths[0][0]), before, 1).state;
    const F2 expected = product(product(Q, before.tau.full()), transpose(Q));
    CHECK(verify::relative_error(after.tau.full().v, expected.v) < 1e-12);
    CHECK(after.plastic_strain == doctest::Approx(before.plastic_strain).epsilon(1e-12));
  }
}
TEST_CASE("hypoelastic J2's tangent is symmetric from the virgin state, else unsymmetric in proportion to the step") {
  CHECK(verify::material_tangent<Planar>(linear, {paths[0][0]}).asymmetry < 1e-13);
  CHECK(verify::material_tangent<Planar>(elastic, {paths[0][0]}).asymmetry < 1e-13);
  const auto asymmetry = [](const auto& material, Real h) {
    const F2 G = gradient(1.2, 0.3, -0.1, 0.9, 1.1);
    return verify::material_tangent<Planar>(material, {G, product(gradient(1 + h, 0.3 * h, 0.8 * h, 1, 1 - h), G)})
        .asymmetry;
  };
  CHECK(asymmetry(elastic, 0.1) > 1e-3);
  CHECK(asymmetry(elastic, 1e-3) / asymmetry(elastic, 5e-4) == doctest::Approx(2).epsilon(0.02));
  CHECK(asymmetry(linear, 0.1) > 1e-8);  // small as the elastic strains are, but not round-off
}
TEST_CASE("hypoelastic elasticity without rotation is Hencky's, in any number of steps") {
  const Hencky hencky{.young = 69e3, .poisson = 0.33};
  const auto stretch = [](Real t) { return gradient(std::exp(0.4 * t), 0, 0, std::exp(-0.3 * t * t), 1 + 0.1 * t); };
  const auto expected = hencky.respond(stretch(1), {}, 1);
  CHECK(verify::relative_error(elastic.respond(stretch(1), {}, 1).dP_dF, expected.dP_dF) < 1e-13);
  for (const int steps : {1, 3, 50}) {
    const auto end = follow(elastic, stretch, steps);
    CHECK(verify::relative_error(end.answer.P.v, expected.P.v) < 1e-12);
    CHECK(elastic.energy(stretch(1), end.answer.state) ==
          doctest::Approx(hencky.energy(stretch(1), {})).epsilon(1e-12));
  }
}
// Dienes (1979): the Zaremba-Jaumann rate of the Kirchhoff stress in simple shear.
TEST_CASE("hypoelastic simple shear converges to tau_12 = mu sin gamma at second order in the step") {
  const Real mu = 69e3 / 2.66;
  Real error[2];
  int k = 0;
  for (const int steps : {50, 100}) {
    const F2 tau = follow(
                       elastic, [](Real t) { return shear(3 * t); }, steps)
                       .tau;
    CHECK(tau(0, 1) == doctest::Approx(tau(1, 0)).epsilon(1e-12));
    CHECK(std::abs(trace(tau)) < 1e-9 * mu);
    error[k++] = std::abs(tau(0, 1) / mu - std::sin(3)) + std::abs(tau(0, 0) / mu - (1 - std::cos(3)));
  }
  CHECK(error[1] < 1e-3);
  CHECK(error[0] / error[1] == doctest::Approx(4).epsilon(0.05));
}
// On the yield circle tau_12 = k cos(phi), (tau_11 - tau_22) / 2 = k sin(phi) the angle obeys
// d phi / d gamma = 1 - mu / k sin(phi).
TEST_CASE("hypoelastic perfect plasticity in simple shear has the limit sin(phi) = k / mu") {
  const Real mu = 100, k = 10;
  const HypoelasticJ2<PerfectPlasticity> soft{.young = 260, .poisson = 0.3, .hardening = {.yield = k * std::sqrt(3.0)}};
  const F2 tau = follow(
                     soft, [](Real t) { return shear(2 * t); }, 4000)
                     .tau;
  CHECK(tau(0, 1) == doctest::Approx(k * std::sqrt(1 - k * k / (mu * mu))).epsilon(1e-4));
  CHECK(0.5 * (tau(0, 0) - tau(1, 1)) == doctest::Approx(k * k / mu).epsilon(1e-2));
}
TEST_CASE("hypoelastic and multiplicative J2 agree where elastic strains are small") {
  const FiniteJ2<VoceHardening> finite{.young = voce.young, .poisson = voce.poisson, .hardening = voce.hardening};
  const auto compare = [&](auto motion) {
    const auto a = follow(voce, motion, 200);
    const auto b = follow(finite, motion, 200);
    CHECK((a.tau.v - b.tau.v).norm() < 0.005 * b.tau.v.norm());
    CHECK(a.answer.state.plastic_strain == doctest::Approx(b.answer.state.plastic_strain).epsilon(0.005));
    CHECK(b.answer.state.plastic_strain > 0.3);
  };
  compare([](Real t) { return shear(t); });
  compare([](Real t) { return gradient(std::exp(0.4 * t), 0, 0, std::exp(-0.4 * t), 1); });
  compare([](Real t) { return gradient(std::exp(0.4 * t), 0, 0, std::exp(-0.2 * t), std::exp(-0.2 * t)); });
  compare([](Real t) {
    return product(verify::rotation<Planar>(2 * t), gradient(1 + 0.5 * t, 0.3 * t, 0, 1 / (1 + 0.5 * t), 1));
  });
}
// Free sides by Newton's method on the law's own tangent, against the flow curve.
TEST_CASE("hypoelastic J2's Kirchhoff stress in uniaxial tension is the flow stress at ln(stretch) - tau / young") {
  Voce::State<Real, Planar> state;
  Real side = 1;
  for (int k = 1; k <= 60; ++k) {
    const Real stretch = 1 + 0.005 * k;
    MaterialResponse<Real, Planar, Voce::State<Real, Planar>> r;
    for (int iteration = 0; iteration < 20; ++iteration) {
      r = voce.respond(gradient(stretch, 0, 0, side, side), state, 1);
      if (std::abs(r.P(2, 2)) < 1e-9) break;
      side -= r.P(2, 2) / (r.dP_dF(4, 4) + r.dP_dF(4, 3));
    }
    CHECK(std::abs(r.P(2, 2)) < 1e-9);
    state = r.state;
    const Real tau = r.P(0, 0) * stretch;
    CHECK(tau == doctest::Approx(voce.hardening.flow(state.plastic_strain).value).epsilon(1e-10));
    CHECK(state.plastic_strain == doctest::Approx(std::log(stretch) - tau / voce.young).epsilon(1e-10));
  }
}
TEST_CASE("hypoelastic J2's work is stored energy and plastic work, up to the error of the quadrature") {
  const auto motion = [](Real t) { return gradient(1 + 0.2 * t, 0.3 * t * t, -0.1 * t, 1 - 0.15 * t, 1); };
  Real error[2];
  int k = 0;
  for (const int steps : {400, 800}) {
    const auto end = follow(voce, motion, steps);
    const Real booked = voce.energy(motion(1), end.answer.state) + voce.plastic_work(end.answer.state);
    error[k++] = std::abs(end.work / booked - 1);
    CHECK(voce.energy(motion(1), end.answer.state) > 0);
  }
  CHECK(error[0] < 1e-4);
  CHECK(error[1] < 0.5 * error[0]);
}
TEST_CASE("a wrong parameter of hypoelastic J2 is named") {
  CHECK_NOTHROW(voce.validate());
  CHECK_THROWS_WITH_AS((Linear{.young = 1, .poisson = 0.5, .hardening = {.yield = 1}}.validate()),
                       "material: Poisson's ratio must lie between -1 and 0.5, both excluded", std::invalid_argument);
  CHECK_THROWS_WITH_AS((Linear{.young = 1, .poisson = 0.3}.validate()),
                       "linear hardening: the yield stress must be positive", std::invalid_argument);
}

}  // namespace
