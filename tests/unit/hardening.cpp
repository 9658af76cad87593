// SPDX-License-Identifier: BSL-1.0
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;
using T = Tensor<Real, Planar>;

T shear(Real gamma) {
  T F = T::identity();
  F(0, 1) = gamma;
  return F;
}

// The return meets the yield surface, whatever the size of the step.
template <class Material>
void check_return(const Material& material, Real gamma) {
  const T F = shear(gamma);
  const auto r = material.respond(F, {}, 1);
  CAPTURE(gamma);
  CHECK(r.cause == FailureCause::none);
  const Real q = von_mises(kirchhoff(r.P, F)), p = r.state.plastic_strain;
  const Real flow = material.hardening.flow(p).value;
  if (p > 0)
    CHECK(q == doctest::Approx(flow).epsilon(1e-11));
  else
    CHECK(q <= flow * (1 + 1e-14));
}

const std::vector<Real> shears{1e-8, 1e-4, 5e-4, 1e-3, 1.5e-3, 2e-3, 3e-3, 1e-2, 0.1, 1, 5, 20};

TEST_CASE("the return map solves the power law 589 (1e-4 + p)^0.216 from its nearly vertical start") {
  const FiniteJ2<PowerHardening> material{
      .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};
  CHECK(material.hardening.flow(0.0).slope > 1e5);  // steeper than Young's modulus
  for (const Real gamma : shears) check_return(material, gamma);
  // From just at yield upwards.
  const Real yield = material.hardening.flow(0.0).value / (69004 / 2.6) / std::sqrt(3.0);
  for (const Real excess : {1e-14, 1e-10, 1e-6, 1e-3, 0.1}) {
    check_return(material, yield * (1 + excess));
    check_return(material, yield * (1 - excess));
  }
}
TEST_CASE("the return map solves power laws of still steeper starts") {
  for (const Real offset : {1e-6, 1e-9, 1e-12})
    for (const Real exponent : {0.05, 0.216, 0.7, 1.0})
      for (const Real gamma : shears)
        check_return(
            FiniteJ2<PowerHardening>{
                .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = offset, .exponent = exponent}},
            gamma);
}
TEST_CASE("the return map solves linear hardening, perfect plasticity and softening") {
  for (const Real modulus : {260.0, 0.0, 1e7, -5.0})
    for (const Real gamma : {1e-4, 1e-3, 0.01, 0.1, 1.0})
      check_return(
          FiniteJ2<LinearHardening>{.young = 69e3, .poisson = 0.3, .hardening = {.yield = 30, .modulus = modulus}},
          gamma);
  const FiniteJ2<LinearHardening> perfect{.young = 69e3, .poisson = 0.3, .hardening = {.yield = 30, .modulus = 0}};
  const T F = shear(0.7);
  CHECK(von_mises(kirchhoff(perfect.respond(F, {}, 1).P, F)) == doctest::Approx(30).epsilon(1e-12));
}
// A law that counts how often it is asked.
template <class Law>
struct Counted : Law {
  int* asked = nullptr;
  template <class S>
  FlowStress<S> flow(const S& p) const {
    ++*asked;
    return Law::flow(p);
  }
};
TEST_CASE("the return map takes one iteration where the flow stress is linear and few where it is steep") {
  int asked = 0;
  const auto work = [&](const auto& law, Real gamma) {
    asked = 0;
    const T F = shear(gamma);
    CHECK(FiniteJ2<std::remove_cvref_t<decltype(law)>>{.young = 69e3, .poisson = 0.3, .hardening = law}
              .respond(F, {}, 1)
              .state.plastic_strain > 0);
    return asked;
  };
  for (const Real gamma : {2e-3, 0.01, 0.1, 1.0, 20.0}) {
    CAPTURE(gamma);
    CHECK(work(Counted<LinearHardening>{{.yield = 30, .modulus = 260}, &asked}, gamma) == 3);  // start, end, once more
    CHECK(work(Counted<PowerHardening>{{.strength = 589, .offset = 1e-4, .exponent = 0.216}, &asked}, 5 * gamma) < 20);
  }
}
TEST_CASE("the plastic strain of many small steps is that of the deformation") {
  const FiniteJ2<LinearHardening> material{.young = 69e3, .poisson = 0.3, .hardening = {.yield = 0.3, .modulus = 0}};
  FiniteJ2<LinearHardening>::State<Real, Planar> state;
  const int steps = 2000;
  for (int i = 1; i <= steps; ++i) {
    T F = T::identity();  // isochoric extension with principal axes at rest
    F(0, 0) = std::exp(0.5 * i / steps);
    F(1, 1) = 1 / F(0, 0);
    state = material.respond(F, state, 1).state;
  }
  CHECK(state.plastic_strain == doctest::Approx(0.5 * 2 / std::sqrt(3.0)).epsilon(1e-4));
}
TEST_CASE("power and linear hardening have the flow stress and slope of their formulas") {
  const PowerHardening power{.strength = 589, .offset = 1e-4, .exponent = 0.216};
  CHECK(power.flow(0.0).value == doctest::Approx(589 * std::pow(1e-4, 0.216)).epsilon(1e-15));
  CHECK(power.flow(0.2).slope ==
        doctest::Approx((power.flow(0.2 + 1e-5).value - power.flow(0.2 - 1e-5).value) / 2e-5).epsilon(1e-7));
  const LinearHardening linear{.yield = 31, .modulus = 261.2};
  CHECK(linear.flow(0.5).value == doctest::Approx(31 + 130.6).epsilon(1e-15));
  CHECK(linear.flow(0.5).slope == 261.2);
}

}  // namespace
