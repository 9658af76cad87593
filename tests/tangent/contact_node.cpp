// SPDX-License-Identifier: BSL-1.0
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/verify/contact.hpp>

#include <doctest/doctest.h>

#include <random>

namespace {

using namespace stickslip;
using V = Vec<Real, 2>;

// A user's law: friction that weakens as the interface slides, mu(s) = mu_d + (mu_s - mu_d) exp(-s / length).
struct SlipWeakening {
  using Role = role::Friction;
  using Law = SlipWeakening;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = true;
  static constexpr bool depends_on_slip = true;
  Real mu_static = 0.4, mu_dynamic = 0.15, length = 0.1;

  template <class S>
  FrictionBound<S> bound(const FrictionPoint<S>& at) const {
    using std::exp;
    const S fading = S(mu_static - mu_dynamic) * exp(at.slip * (-1 / length));
    const S mu = S(mu_dynamic) + fading;
    return {at.pressure * mu, mu, at.pressure * fading * S(-1 / length)};
  }
};
// A user's law that looks at nothing but the slip: a shear strength that hardens.
struct Adhesion {
  using Role = role::Friction;
  using Law = Adhesion;
  using Pressure = CurrentPressure;
  static constexpr bool active = true;
  static constexpr bool depends_on_pressure = false;
  static constexpr bool depends_on_slip = true;
  Real strength = 3, hardening = 5;
  template <class S>
  FrictionBound<S> bound(const FrictionPoint<S>& at) const {
    return {S(strength) + at.slip * hardening, S(0), S(hardening)};
  }
};
static_assert(FrictionPolicy<SlipWeakening> && FrictionPolicy<Quasi<SlipWeakening>> && FrictionPolicy<Adhesion>);
static_assert(friction_symmetry<Frictionless>() == Symmetry::symmetric);
static_assert(friction_symmetry<Coulomb>() == Symmetry::general);
static_assert(friction_symmetry<QuasiCoulomb>() == Symmetry::symmetric);
static_assert(friction_symmetry<SlipWeakening>() == Symmetry::general);
static_assert(friction_symmetry<Quasi<SlipWeakening>>() == Symmetry::symmetric);
static_assert(friction_symmetry<Adhesion>() == Symmetry::symmetric);

constexpr Penalty penalty{.normal = 1000, .tangential = 100};

struct Scene {
  const char* name;
  rigid::Profile tool;
  V surface;  // a point of the tool
};
const std::vector<Scene> scenes{
    {"flat", rigid::line({0, 0}, {1, 0.3}), {0, 0}},
    {"convex", rigid::disc({0, 0}, 2), {2 * std::cos(0.7), 2 * std::sin(0.7)}},
    {"concave", rigid::path({0, 0}, {1, 0}).left(3, 2), {3 * std::sin(1.0), 3 - 3 * std::cos(1.0)}},
};

// Places by depth below the surface and distance along it from the scene's point.
V place(const Scene& scene, Real depth, Real along) {
  const auto at = scene.tool.closest(V(scene.surface * (1 + 1e-12)));
  const V t = at.grad_place.col(0).normalized();
  V x = scene.surface + along * t;
  for (int i = 0; i < 5; ++i) {
    const auto here = scene.tool.closest(x);
    x -= (here.gap + depth) * here.normal;
  }
  return x;
}

template <class Friction>
auto node_on(const Scene& scene, const typename Friction::Law& law) {
  return verify::LoneNode<Penalty, typename Friction::Law, Friction, rigid::Profile>{
      .enforcement = penalty, .law = law, .friction = {}, .tool = scene.tool, .weight = 1.7};
}

enum class Expect { separated, sticking, sliding };

template <class Friction>
void check(const Scene& scene, const typename Friction::Law& law, const std::vector<V>& path, Expect expect) {
  CAPTURE(scene.name);
  const auto node = node_on<Friction>(scene, law);
  const auto old = node.template preloaded<Real>(path);
  const auto now = node.template at<Real>(path.back(), old);
  CHECK(now.touching == (expect != Expect::separated));
  CHECK(now.sliding == (expect == Expect::sliding));
  CHECK(now.dissipated >= 0);
  CHECK((now.dissipated > 0) == (expect == Expect::sliding && now.memory.friction.traction[0] != 0 &&
                                 now.memory.friction.slip > old.friction.slip));
  const auto r = verify::contact_tangent(node, path);
  CHECK(r.by_duals < 1e-11);
  CHECK(r.by_differences < 1e-8);
  if constexpr (friction_symmetry<Friction>() == Symmetry::symmetric) CHECK(r.asymmetry < 1e-15);
  if (expect != Expect::separated) {
    // The pressure of an iteration that has not closed it. A node below its bound at one pressure may slide at another.
    for (const Real share : {0.97, 1.04}) {
      const Real pressure = share * now.pressure.value;
      const auto open = verify::relation_report<2>(path.back(), pressure, 1e-5, 1e-4 * pressure,
                                                   [&](const V& x, Real p) { return node.open(x, old, p); });
      CHECK(open.slope < 1e-8);
      CHECK(open.excess < 1e-8);
      CHECK(open.tangent < 1e-8);
    }
    CHECK(now.pressure.defect == 0);
  }
  if (expect == Expect::separated) {
    CHECK(now.force.norm() == 0);
    CHECK(now.stiffness.norm() == 0);
  }
}

// Every state of a node, for a law with a bound between about 0.1 and 0.5 of the pressure.
template <class Friction>
void check_states(const typename Friction::Law& law) {
  for (const Scene& scene : scenes) {
    const V out = place(scene, -0.01, 0), first = place(scene, 0.02, 0.001), stuck = place(scene, 0.02, 0.004);
    check<Friction>(scene, law, {out, place(scene, -0.02, 0.1)}, Expect::separated);
    check<Friction>(scene, law, {out, first, place(scene, -0.005, 0.002)}, Expect::separated);
    check<Friction>(scene, law, {out, first, first, stuck}, Expect::sticking);
    check<Friction>(scene, law, {out, first, first, stuck, place(scene, 0.03, 0.003)}, Expect::sticking);
    for (const Real direction : {-1.0, 1.0}) {
      check<Friction>(scene, law, {out, first, first, place(scene, 0.021, direction * 0.4)}, Expect::sliding);
      check<Friction>(scene, law,
                      {out, first, first, place(scene, 0.03, direction * 0.3), place(scene, 0.02, direction * 0.6)},
                      Expect::sliding);
      // turning back: from sliding into sticking
      check<Friction>(scene, law,
                      {out, first, first, place(scene, 0.03, direction * 0.3), place(scene, 0.03, direction * 0.295)},
                      Expect::sticking);
    }
  }
}

TEST_CASE("Coulomb: every state of a node") {
  check_states<Coulomb>({.mu = 0.3});
  for (const Scene& scene : scenes) {  // first contact: the current pressure binds at once
    check<Coulomb>(scene, {.mu = 0.3}, {place(scene, -0.01, 0), place(scene, 0.02, 0.01)}, Expect::sticking);
    check<Coulomb>(scene, {.mu = 0.3}, {place(scene, -0.01, 0), place(scene, 0.02, 0.2)}, Expect::sliding);
  }
}
TEST_CASE("Quasi-Coulomb: every state of a node") {
  check_states<QuasiCoulomb>({.mu = 0.3});
  for (const Scene& scene : scenes) {  // first contact: no converged pressure, the node slides freely
    const std::vector<V> path{place(scene, -0.01, 0), place(scene, 0.02, 0.2)};
    check<QuasiCoulomb>(scene, {.mu = 0.3}, path, Expect::sliding);
    const auto node = node_on<QuasiCoulomb>(scene, {.mu = 0.3});
    const auto now = node.at<Real>(path.back(), node.preloaded<Real>(path));
    CHECK(now.memory.friction.traction[0] == 0);
    CHECK(now.bound == doctest::Approx(0.3 * now.pressure.value));
    CHECK(now.lag == doctest::Approx(0.3 * now.pressure.value));
    CHECK(now.memory.friction.pressure.pressure == now.pressure.value);
  }
}
TEST_CASE("a user's slip weakening: every state of a node") {
  check_states<SlipWeakening>({});
  check_states<Quasi<SlipWeakening>>({});
}
TEST_CASE("a user's adhesion that hardens: every state of a node") {
  check_states<Adhesion>({});
}

TEST_CASE("frictionless: every state of a node") {
  for (const Scene& scene : scenes) {
    const verify::LoneNode<Penalty, Nothing<Scene>, Frictionless, rigid::Profile> node{
        .enforcement = penalty, .law = {}, .friction = {}, .tool = scene.tool};
    for (const Real depth : {-0.02, 0.01, 0.2}) {
      const std::vector<V> path{place(scene, depth, 0.1)};
      const auto r = verify::contact_tangent(node, path);
      CHECK(r.by_duals < 1e-12);
      CHECK(r.by_differences < 1e-9);
      CHECK(r.asymmetry < 1e-15);
      const auto now = node.at<Real>(path[0], {});
      CHECK(now.touching == (depth > 0));
      if (now.touching) {
        CHECK(now.pressure.value == doctest::Approx(penalty.normal * depth).epsilon(1e-10));
        CHECK((now.force + scene.tool.closest(path[0]).normal * now.pressure.value).norm() <
              1e-12 * now.pressure.value);
      }
    }
  }
}

// Along a walk from sticking into sliding: the slipped distance at the switch, by bisection.
template <class Friction>
void check_switch(const typename Friction::Law& law) {
  for (const Scene& scene : scenes) {
    const V out = place(scene, -0.01, 0), first = place(scene, 0.02, 0.0);
    const auto node = node_on<Friction>(scene, law);
    const auto at = [&](Real along) { return std::vector<V>{out, first, first, place(scene, 0.02, along)}; };
    const auto sliding = [&](Real along) {
      return node.template at<Real>(at(along).back(), node.template preloaded<Real>(at(along))).sliding;
    };
    Real low = 0, high = 0.3;
    for (int i = 0; i < 80; ++i) (sliding(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    const auto below = at(low * (1 - 1e-7)), above = at(high * (1 + 1e-7));
    CHECK_FALSE(sliding(low * (1 - 1e-7)));
    CHECK(sliding(high * (1 + 1e-7)));
    CHECK(verify::contact_tangent(node, below).by_duals < 1e-11);
    CHECK(verify::contact_tangent(node, above).by_duals < 1e-11);
    const auto old = node.template preloaded<Real>(below);
    const auto stick = node.template at<Real>(below.back(), old), slip = node.template at<Real>(above.back(), old);
    CHECK((stick.force - slip.force).norm() < 1e-5 * stick.force.norm());              // no jump of the force
    CHECK((stick.stiffness - slip.stiffness).norm() > 0.01 * stick.stiffness.norm());  // but of its slope
  }
}
TEST_CASE("either side of the stick-slip switch") {
  check_switch<Coulomb>({.mu = 0.3});
  check_switch<QuasiCoulomb>({.mu = 0.3});
  check_switch<SlipWeakening>({});
  check_switch<Quasi<SlipWeakening>>({});
  check_switch<Adhesion>({});
}

TEST_CASE("Coulomb's tangent is not symmetric while a node slides, and is while it sticks or mu is 0") {
  for (const Scene& scene : scenes) {
    const V out = place(scene, -0.01, 0), first = place(scene, 0.02, 0.0);
    const std::vector<V> slide{out, first, place(scene, 0.02, 0.3)}, stick{out, first, place(scene, 0.02, 0.001)};
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0.3}), slide).asymmetry > 0.1);
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0.3}), stick).asymmetry < 1e-15);
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0}), slide).asymmetry < 1e-15);
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0}), slide).by_duals < 1e-12);
  }
}

TEST_CASE("Quasi-Coulomb on a flat tool: the tangent of sliding has no tangential part at all (paper, eq. 22)") {
  const Scene flat{"flat", rigid::line({0, 0}, {1, 0}), {0, 0}};
  const auto node = node_on<QuasiCoulomb>(flat, {.mu = 0.3});
  const std::vector<V> path{V(0, 0.01), V(0, -0.02), V(0.5, -0.03)};
  const auto now = node.at<Real>(path.back(), node.preloaded<Real>(path));
  CHECK(now.sliding);
  CHECK(now.memory.friction.traction[0] == doctest::Approx(0.3 * 1.7 * 1000 * 0.02));
  CHECK(now.stiffness(0, 0) == 0);
  CHECK(now.stiffness(0, 1) == 0);
  CHECK(now.stiffness(1, 0) == 0);
  CHECK(now.stiffness(1, 1) == 1.7 * 1000);
  // Coulomb keeps the coupling -mu eps_C T N^T (eq. 19).
  const auto coulomb = node_on<Coulomb>(flat, {.mu = 0.3});
  const auto exact = coulomb.at<Real>(path.back(), coulomb.preloaded<Real>(path));
  CHECK(exact.stiffness(0, 1) == doctest::Approx(-0.3 * 1.7 * 1000));
  CHECK(exact.stiffness(1, 0) == 0);
}

// Random walks in and out of contact: the second law of thermodynamics and the bound, at every step.
template <class Friction>
void check_walk(const typename Friction::Law& law) {
  std::mt19937 random(11);
  std::normal_distribution<Real> normal(0, 1);
  for (const Scene& scene : scenes) {
    const auto node = node_on<Friction>(scene, law);
    auto memory = node.template preloaded<Real>({place(scene, -0.01, 0), place(scene, -0.01, 0)});
    Real along = 0, slip = 0;
    int sliding = 0, sticking = 0, away = 0;
    for (int i = 0; i < 400; ++i) {
      along = std::clamp(along + 0.03 * normal(random), -0.8, 0.8);
      const Real pressure_before = [&] {
        if constexpr (requires { memory.friction.pressure.pressure; })
          return memory.friction.pressure.pressure;
        else
          return 0.0;
      }();
      const auto now = node.template at<Real>(place(scene, 0.03 + 0.02 * normal(random), along), memory);
      CHECK(now.dissipated >= 0);
      CHECK(now.memory.friction.slip >= slip);
      slip = now.memory.friction.slip;
      const Real source = Friction::Pressure::follows_current ? now.pressure.value : pressure_before;
      const Real bound = law.bound(FrictionPoint<Real>{source, slip}).value;
      if (now.touching) CHECK(std::abs(now.memory.friction.traction[0]) <= bound * (1 + 1e-12) + 1e-13);
      if (!now.touching) CHECK(now.memory.friction.traction[0] == 0);
      now.sliding ? ++sliding : now.touching ? ++sticking : ++away;
      memory = now.memory;
    }
    CHECK(sliding > 20);
    CHECK(sticking > 20);
    CHECK(away > 5);
  }
}
TEST_CASE("friction never gives energy and never exceeds its bound") {
  check_walk<Coulomb>({.mu = 0.3});
  check_walk<QuasiCoulomb>({.mu = 0.3});
  check_walk<SlipWeakening>({});
  check_walk<Quasi<SlipWeakening>>({});
  check_walk<Adhesion>({});
}

}  // namespace
