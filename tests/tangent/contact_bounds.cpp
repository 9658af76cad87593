// SPDX-License-Identifier: BSL-1.0
// Every bound of the library with every pressure source.
#include "contact_states.hpp"

#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>

namespace contact_bounds {

using namespace contact_states;

constexpr Real cap = 4;  // the depth of 0.02 asks for 10.2
constexpr CappedCoulomb capped{.mu = 0.3, .tau_max = cap / area}, uncapped{.mu = 0.3, .tau_max = 100 / area};
constexpr Tresca tresca{.tau = 3 / area};
constexpr SlipWeakeningCoulomb weakening{.mu_static = 0.4, .mu_dynamic = 0.15, .length = 0.1};
constexpr Stribeck stribeck{.mu_static = 0.4, .mu_dynamic = 0.15, .speed = 0.3};

// The claims on symmetry: general only where a bound looks at the pressure of the iterate.
template <class Law>
constexpr bool symmetric_unless_current =
    friction_symmetry<Law>() == Symmetry::general&& friction_symmetry<Quasi<Law>>() ==
    Symmetry::symmetric&& friction_symmetry<WithPressure<Law, Extrapolated>>() == Symmetry::symmetric;
static_assert(symmetric_unless_current<Coulomb> && symmetric_unless_current<CappedCoulomb>);
static_assert(symmetric_unless_current<SlipWeakeningCoulomb> && symmetric_unless_current<Stribeck>);
static_assert(friction_symmetry<Tresca>() == Symmetry::symmetric);
static_assert(friction_symmetry<WithPressure<Tresca, CurrentPressure>>() == Symmetry::symmetric);
static_assert(FrictionPolicy<Tresca> && FrictionPolicy<WithPressure<Tresca, Extrapolated>>);
// Who looks at what.
static_assert(!depends_on_area<Coulomb>() && !depends_on_rate<Coulomb>());
static_assert(depends_on_area<Tresca>() && depends_on_area<CappedCoulomb>() && depends_on_rate<Stribeck>());

template <class Friction>
void check_all(const typename Friction::Law& law) {
  check_states<Friction>(law);
  check_switch<Friction>(law);
  check_walk<Friction>(law);
}
template <class Law>
void check_sources(const Law& law) {
  check_all<WithPressure<Law, CurrentPressure>>(law);
  check_all<WithPressure<Law, LastConverged>>(law);
  check_all<WithPressure<Law, Extrapolated>>(law);
}
TEST_CASE("Coulomb's contact tangent at the extrapolated pressure is the derivative of its force") {
  check_all<ExtrapolatedCoulomb>({.mu = 0.3});
}
TEST_CASE("capped Coulomb's tangent is exact below the cap and at it with every pressure source") {
  check_sources(uncapped);
  check_sources(capped);
}
TEST_CASE("Tresca's tangent is exact with every pressure source") {
  check_sources(tresca);
}
TEST_CASE("slip weakening's tangent is exact with every pressure source") {
  check_sources(weakening);
}
TEST_CASE("Stribeck's tangent is exact with every pressure source") {
  check_sources(stribeck);
}

template <class Friction>
auto slide(const Touch& scene, const typename Friction::Law& law, Real depth, Real along) {
  const auto node = node_on<Friction>(scene, law);
  const std::vector<V> path{place(scene, -0.01, 0), place(scene, depth, 0), place(scene, depth, along)};
  const auto now = node.template at<Real>(path.back(), node.template preloaded<Real>(path, dt), dt);
  return std::pair(now, verify::contact_tangent(node, path, dt));
}
TEST_CASE("capped Coulomb is Coulomb bit for bit below the cap, tau_max A and symmetric at it") {
  for (const Touch& scene : scenes) {
    const auto [coulomb, exact] = slide<Coulomb>(scene, {.mu = 0.3}, 0.02, 0.3);
    const auto [below, low] = slide<CappedCoulomb>(scene, uncapped, 0.02, 0.3);
    CHECK(below.force == coulomb.force);
    CHECK(below.stiffness == coulomb.stiffness);
    CHECK(low.asymmetry > 0.1);
    const auto [at, high] = slide<CappedCoulomb>(scene, capped, 0.02, 0.3);
    CHECK(at.memory.friction.traction[0] == cap);
    CHECK(high.asymmetry < 1e-15);
    const Real kink = cap / (0.3 * 1.7 * penalty.normal);
    for (const Real side : {1 - 1e-6, 1 + 1e-6}) {
      const auto [near, report] = slide<CappedCoulomb>(scene, capped, kink * side, 0.3);
      CHECK(near.memory.friction.traction[0] == doctest::Approx(cap).epsilon(2e-6));
      CHECK(report.by_duals < 1e-11);
      CHECK((report.asymmetry > 0.1) == (side < 1));
    }
  }
}
TEST_CASE("Tresca's bound is tau A at every depth and keeps no pressure") {
  for (const Touch& scene : scenes)
    for (const Real depth : {1e-6, 0.01, 0.2}) {
      const auto now = slide<WithPressure<Tresca, Extrapolated>>(scene, tresca, depth, -0.3).first;
      CHECK(now.sliding);
      CHECK(now.memory.friction.traction[0] == -tresca.tau * area);
      CHECK(now.bound == tresca.tau * area);
      CHECK(now.lag == 0);
    }
  static_assert(sizeof(NodeMemory<Real, 2, Penalty, WithPressure<Tresca, Extrapolated>>) == 3 * sizeof(Real));
}
TEST_CASE("slip weakening and Stribeck have the exact derivatives of mu and its limits") {
  for (const Real x : {0.0, 1e-4, 0.05, 0.7}) {
    const auto slipping = weakening.bound(InterfaceState<Dual<1>>{3, Dual<1>::variable(x, 0)});
    CHECK(slipping.d_slip.value == doctest::Approx(slipping.value.slope[0]).epsilon(1e-14));
    const auto rating = stribeck.bound(InterfaceState<Dual<1>>{3, 0, 0, Dual<1>::variable(x, 0)});
    CHECK(rating.d_rate.value == doctest::Approx(rating.value.slope[0]).epsilon(1e-14));
    CHECK(rating.value.value == doctest::Approx(3 * stribeck.coefficient(x)).epsilon(1e-15));
  }
  CHECK(weakening.bound(InterfaceState<Real>{1, 0}).value == doctest::Approx(0.4));
  CHECK(weakening.bound(InterfaceState<Real>{1, 0.1}).value == doctest::Approx(0.15 + 0.25 * std::exp(-1)));
  CHECK(weakening.bound(InterfaceState<Real>{1, 10}).value == doctest::Approx(0.15));
  CHECK(stribeck.coefficient(0) == doctest::Approx(0.4));
  CHECK(stribeck.bound(InterfaceState<Real>{1, 0}).d_rate == 0);
  CHECK(stribeck.coefficient(0.3) == doctest::Approx(0.15 + 0.25 * std::exp(-1)).epsilon(0.02));
  CHECK(stribeck.coefficient(10) == doctest::Approx(0.15));
}
TEST_CASE("the friction return has a solution where Stribeck's bound falls faster than the sticking spring unloads") {
  const Real blink = 1e-4;
  for (const Touch& scene : scenes)
    for (const Real along : {0.1366, 0.14, 0.2, 0.5}) {  // from hardly above the static bound on
      const auto node = node_on<Quasi<Stribeck>>(scene, stribeck);
      const V first = place(scene, 0.02, 0);
      const std::vector<V> path{place(scene, -0.01, 0), first, place(scene, 0.02, along)};
      const auto old = node.preloaded<Real>(path, blink);
      const auto now = node.at<Real>(path.back(), old, blink);
      REQUIRE(now.sliding);
      CHECK(now.cause == FailureCause::none);
      CHECK(now.dissipated > 0);
      const Real slid = now.memory.friction.accumulated_slip - old.friction.accumulated_slip,
                 p = old.friction.pressure.pressure;
      CHECK(now.memory.friction.traction[0] == doctest::Approx(stribeck.coefficient(slid / blink) * p).epsilon(1e-12));
      CHECK(verify::contact_tangent(node, path, blink).by_duals < 1e-9);
    }
}

TEST_CASE("in a step without duration the slip rate is zero") {
  for (const Touch& scene : scenes) {
    const auto node = node_on<Stribeck>(scene, stribeck);
    const std::vector<V> path{place(scene, -0.01, 0), place(scene, 0.02, 0.3)};
    const auto now = node.at<Real>(path.back(), node.preloaded<Real>(path, 0), 0);
    CHECK(now.sliding);
    CHECK(now.cause == FailureCause::none);
    CHECK(std::abs(now.memory.friction.traction[0]) == doctest::Approx(0.4 * now.pressure.value).epsilon(1e-12));
  }
}

TEST_CASE("a law with a bound of zero has the force and stiffness of no friction") {
  for (const Touch& scene : scenes) {
    const auto smooth = slide<Coulomb>(scene, {}, 0.02, 0.3).first;
    const auto equal = [&](const auto& now) {
      CHECK(now.force == smooth.force);
      CHECK(now.stiffness == smooth.stiffness);
      CHECK(now.dissipated == 0);
    };
    equal(slide<Tresca>(scene, {}, 0.02, 0.3).first);
    equal(slide<CappedCoulomb>(scene, {.mu = 0, .tau_max = 1}, 0.02, 0.3).first);
    equal(slide<SlipWeakeningCoulomb>(scene, {.length = 1}, 0.02, 0.3).first);
    equal(slide<Stribeck>(scene, {.speed = 1}, 0.02, 0.3).first);
    equal(slide<ExtrapolatedCoulomb>(scene, {}, 0.02, 0.3).first);
  }
}

// Pressures of converged steps -> what is remembered.
Extrapolated::Memory<Real> after(std::initializer_list<std::pair<Real, Real>> steps) {
  Extrapolated::Memory<Real> memory{};
  for (const auto& [size, pressure] : steps) memory = Extrapolated::advance(pressure, memory, size);
  return memory;
}
TEST_CASE("the extrapolated pressure is linear in time, limited, and the last converged one without a history of two") {
  const auto foretold = [](const auto& memory, Real h) { return Extrapolated::pressure(123.0, memory, h); };
  CHECK(foretold(after({{0.5, 2}, {0.2, 3}}), 0.1) == doctest::Approx(3.5));
  CHECK(foretold(after({{0.5, 2}, {0.2, 1.5}}), 0.4) == doctest::Approx(0.5));
  CHECK(foretold(after({{0.5, 2}, {0.2, 3}}), 5) == 6);  // at most twice the last one
  CHECK(foretold(after({{0.5, 2}, {0.2, 1}}), 5) == 0);  // and not negative
  CHECK(foretold(after({}), 1) == 0);                    // nothing is known
  CHECK(foretold(after({{0.5, 2}}), 1) == 2);            // first contact
  CHECK(foretold(after({{0.5, 2}, {0.2, 0}, {0.2, 3}}), 0.1) == 3);
  CHECK(foretold(after({{0.5, 2}, {0, 3}}), 0.1) == 3);  // a step without duration
  // A node that was let go has forgotten, and slides freely when it comes back, as with the last converged pressure.
  const Touch& scene = scenes[0];
  const auto node = node_on<ExtrapolatedCoulomb>(scene, {.mu = 0.3});
  const V in = place(scene, 0.02, 0), deep = place(scene, 0.03, 0.1), out = place(scene, -0.01, 0.1);
  const auto left = node.preloaded<Real>({out, in, deep, out, in}, dt);
  CHECK(left.friction.pressure.pressure == 0);
  CHECK(left.friction.pressure.trend == 0);
  const auto back = node.at<Real>(in, left, dt);
  CHECK(back.memory.friction.traction[0] == 0);
  CHECK(back.memory.friction.pressure.pressure == back.pressure.value);
  CHECK(back.memory.friction.pressure.trend == 0);
  CHECK(node.at<Real>(deep, back.memory, dt).memory.friction.pressure.trend > 0);
}

// A sliding node whose pressure friction lowers, p = load(t) - kappa times the pressure in the bound: its error against
// the current pressure, load / (1 + kappa), after so many equal steps of size h (theory.md, eq. 5.13 and 5.27).
template <class Source, class Load>
Real error_after(int steps, Real h, Real kappa, Load&& load) {
  typename Source::template Memory<Real> memory{};
  Real p = 0;
  for (int i = 1; i <= steps; ++i) {
    p = load(i * h) - kappa * Source::pressure(0.0, memory, h);
    memory = Source::advance(p, memory, h);
  }
  return p - load(steps * h) / (1 + kappa);
}
TEST_CASE("lagged pressures have the errors and the critical feedback of the theory") {
  const auto constant = [](Real) { return 1.0; };
  CHECK(std::abs(error_after<LastConverged>(400, 1, 0.95, constant)) < 1e-6);
  CHECK(std::abs(error_after<LastConverged>(400, 1, 1.01, constant)) > 0.1);
  CHECK(std::abs(error_after<Extrapolated>(400, 1, 0.32, constant)) < 1e-3);
  CHECK(std::abs(error_after<Extrapolated>(400, 1, 0.35, constant)) > 0.01);
  const auto settles = [&]<class Source>(Source) {
    const Real critical = Source::critical_feedback;
    CHECK(std::abs(error_after<Source>(4000, 1, 0.98 * critical, constant)) < 1e-6);
    CHECK(std::abs(error_after<Source>(4000, 1, 1.02 * critical, constant)) > 1e-2);
  };
  settles(LastConverged{});
  settles(Extrapolated{});
  const Real h = 0.01, kappa = 0.2;
  const auto growing = [](Real t) { return 5 + t * t; };
  const Real slope = 2 * h * (200 * h - 0.5 * h), bend = 2 * h * h;  // last and second difference of the load
  CHECK(error_after<LastConverged>(200, h, kappa, growing) ==
        doctest::Approx(kappa * slope / (1 + kappa) / (1 + kappa)).epsilon(0.01));
  CHECK(error_after<Extrapolated>(200, h, kappa, growing) ==
        doctest::Approx(kappa * bend / (1 + kappa) / (1 + kappa)).epsilon(1e-6));
}

}  // namespace contact_bounds
