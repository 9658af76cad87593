// SPDX-License-Identifier: BSL-1.0
// Friction laws against each other: at no friction, and as the steps shrink.
#include "sliding_block.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

namespace cross_laws {

using namespace scene;
using V3 = Vec<Real, 3>;

const Coulomb none{.mu = 0};
const CappedCoulomb capped_none{.mu = 0, .tau_max = 10};
const Tresca tresca_none{.tau = 0};
const SlipWeakeningCoulomb weakening_none{.mu_static = 0, .mu_dynamic = 0, .length = 1};
const Stribeck stribeck_none{.mu_static = 0, .mu_dynamic = 0, .speed = 1};
// Coefficients of the elliptic bound must be positive.
const AnisotropicCoulomb anisotropic_none{.mu_along = 1e-14, .mu_across = 2e-14};

Field finish(auto& problem) {
  auto march = problem.march({.end = 1, .steps = 4, .tolerance = 1e-11});
  const Outcome& outcome = march.finish();
  REQUIRE_MESSAGE(outcome, outcome.message());
  CHECK(march.report().max_penetration > 1e-4);
  return problem.displacement();
}
// A block pressed on a disc that is dragged along, or on a ball that is dragged along and across.
template <class F, class Law>
Field in_plane(const Law& law) {
  using M = Model<EigenDirect, F>;
  Contact<M> contact{.side = "bottom",
                     .tool = rigid::disc({5, -20}, 20),
                     .motion = [](Real t) { return V(std::max(0.0, t - 0.3), 0); },
                     .enforcement = {.normal = 1e5, .tangential = 2e4}};
  if constexpr (F::active) contact.friction = law;
  Problem<M> p({.body = mesh::rectangle({.size = {10, 5}, .cells = {6, 3}}),
                .material = material<Hencky>(),
                .contacts = {contact}});
  p.hold("top", 0).drive("top", 1, [](Real t) { return -0.5 * t; });
  return finish(p);
}
template <class F, class Law>
Field in_space(const Law& law) {
  using M = Model<EigenDirect, F, Hencky, ThreeDimensional, MeanDilatation<Hex8>>;
  Contact<M> contact{.side = "bottom",
                     .tool = rigid::sphere({5, -20, 2}, 20),
                     .motion = [](Real t) { return V3(std::max(0.0, t - 0.3), 0, 0.5 * t); },
                     .enforcement = {.normal = 1e5, .tangential = 2e4}};
  if constexpr (F::active) contact.friction = law;
  Problem<M> p({.body = mesh::box({.size = {10, 5, 4}, .cells = {4, 2, 2}}),
                .material = material<Hencky>(),
                .contacts = {contact}});
  p.hold("top", 0).hold("top", 2).drive("top", 1, [](Real t) { return -0.5 * t; });
  return finish(p);
}

void same(const Field& a, const Field& b) {
  CHECK((a - b).norm() < 1e-11 * b.norm());
}
TEST_CASE("every law with a bound of zero is frictionless, in the plane and in space") {
  const Field smooth = in_plane<Frictionless>(none);
  same(in_plane<Coulomb>(none), smooth);
  same(in_plane<CappedCoulomb>(capped_none), smooth);
  same(in_plane<Tresca>(tresca_none), smooth);
  same(in_plane<SlipWeakeningCoulomb>(weakening_none), smooth);
  same(in_plane<Stribeck>(stribeck_none), smooth);
  same(in_plane<ExtrapolatedCoulomb>(none), smooth);
  CHECK((in_plane<Coulomb>(Coulomb{.mu = 0.1}) - smooth).norm() > 1e-3 * smooth.norm());

  const Field ball = in_space<Frictionless>(none);
  same(in_space<Coulomb>(none), ball);
  same(in_space<CappedCoulomb>(capped_none), ball);
  same(in_space<Tresca>(tresca_none), ball);
  same(in_space<SlipWeakeningCoulomb>(weakening_none), ball);
  same(in_space<Stribeck>(stribeck_none), ball);
  same(in_space<AnisotropicCoulomb>(anisotropic_none), ball);
  same(in_space<QuasiCoulomb>(none), ball);
  CHECK((in_space<Coulomb>(Coulomb{.mu = 0.1}) - ball).norm() > 1e-3 * ball.norm());
}

// Of the difference of a bound from a source of the past to the same at the current pressure, at equal steps.
template <class F>
void check_order(const typename F::Law& law, const std::vector<Real>& exact, Real expected) {
  Real before = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    const Real error = std::abs(sliding_block<F>(law, 20 << k, 0.02)[0] / exact[k] - 1);
    const Index steps = 20 << k;
    MESSAGE(steps, " steps: error ", error, ", order ", std::log2(before / error));
    if (k == 0) CHECK(error > 1e-5);
    if (k > 0) CHECK(std::abs(std::log2(before / error) - expected) < 0.25);
    before = error;
  }
}
template <class Law>
void check_orders(const Law& law) {
  std::vector<Real> exact;
  for (std::size_t k = 0; k < 3; ++k) exact.push_back(sliding_block<Law>(law, 20 << k, 0.02)[0]);
  check_order<Quasi<Law>>(law, exact, 1);
  check_order<WithPressure<Law, Extrapolated>>(law, exact, 2);
}
TEST_CASE(
    "every bound that depends on pressure tends to its current value, at first order from the last converged pressure "
    "and at second from the extrapolated one") {
  check_orders(CappedCoulomb{.mu = 0.3, .tau_max = 1e6});
  check_orders(SlipWeakeningCoulomb{.mu_static = 0.3, .mu_dynamic = 0.2, .length = 2});
  check_orders(Stribeck{.mu_static = 0.3, .mu_dynamic = 0.2, .speed = 2});
}

}  // namespace cross_laws
