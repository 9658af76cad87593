// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/verify/contact.hpp>

#include <doctest/doctest.h>

#include <random>

// A node on flat, convex and concave tools, and the checks that every friction law has to stand.
namespace contact_states {

using namespace stickslip;
using V = Vec<Real, 2>;

constexpr Penalty penalty{.normal = 1000, .tangential = 100};
constexpr Real dt = 0.5, area = 2.5;

struct Touch {
  const char* name;
  rigid::Profile tool;
  V surface;  // a point of the tool
};
inline const std::vector<Touch> scenes{
    {"flat", rigid::line({0, 0}, {1, 0.3}), {0, 0}},
    {"convex", rigid::disc({0, 0}, 2), {2 * std::cos(0.7), 2 * std::sin(0.7)}},
    {"concave", rigid::path({0, 0}, {1, 0}).left(3, 2), {3 * std::sin(1.0), 3 - 3 * std::cos(1.0)}},
};

/// Places by depth below the surface and distance along it from the scene's point.
inline V place(const Touch& scene, Real depth, Real along) {
  const auto at = scene.tool.closest(V(scene.surface * (1 + 1e-12)));
  const V t = at.grad_surface.col(0).normalized();
  V x = scene.surface + along * t;
  for (int i = 0; i < 5; ++i) {
    const auto here = scene.tool.closest(x);
    x -= (here.gap + depth) * here.normal;
  }
  return x;
}

template <class Friction>
auto node_on(const Touch& scene, const typename Friction::Law& law) {
  return verify::SingleNode<Penalty, typename Friction::Law, Friction, rigid::Profile>{
      .enforcement = penalty, .law = law, .friction = {}, .tool = scene.tool, .weight = 1.7, .area = area};
}

/// The pressure that the bound takes at a node of the pressure `now`.
template <class Friction, class Memory>
Real bound_pressure(Real now, const Memory& old) {
  if constexpr (Friction::Law::depends_on_pressure)
    return Friction::Pressure::pressure(now, old.friction.pressure, dt);
  else
    return now;
}
/// The bound that a step must have ended at.
template <class Friction, class Node, class Memory>
Real bound_of(const typename Friction::Law& law, const Node& now, const Memory& old) {
  const Real slip = now.memory.friction.accumulated_slip, slid = slip - old.friction.accumulated_slip;
  return law.bound(InterfaceState<Real>{bound_pressure<Friction>(now.pressure.value, old), slip, area, slid / dt})
      .value;
}

enum class Expect { separated, sticking, sliding };

template <class Friction>
void check(const Touch& scene, const typename Friction::Law& law, const std::vector<V>& path, Expect expect) {
  CAPTURE(scene.name);
  const auto node = node_on<Friction>(scene, law);
  const auto old = node.template preloaded<Real>(path, dt);
  const auto now = node.template at<Real>(path.back(), old, dt);
  CHECK(now.touching == (expect != Expect::separated));
  CHECK(now.sliding == (expect == Expect::sliding));
  CHECK(now.dissipated >= 0);
  CHECK((now.dissipated > 0) == (expect == Expect::sliding && now.memory.friction.traction[0] != 0 &&
                                 now.memory.friction.accumulated_slip > old.friction.accumulated_slip));
  if (expect == Expect::sliding)
    CHECK(std::abs(now.memory.friction.traction[0]) ==
          doctest::Approx(bound_of<Friction>(law, now, old)).epsilon(1e-12));
  const auto r = verify::contact_tangent(node, path, dt);
  CHECK(r.by_duals < 1e-11);
  CHECK(r.by_differences < 1e-8);
  if constexpr (friction_symmetry<Friction>() == Symmetry::symmetric) CHECK(r.asymmetry < 1e-15);
  if (expect != Expect::separated) {
    // The pressure of an iteration that has not closed it. A node below its bound at one pressure may slide at another.
    for (const Real share : {0.97, 1.04}) {
      const Real pressure = share * now.pressure.value;
      const auto open = verify::relation_report<2>(path.back(), pressure, 1e-5, 1e-4 * pressure,
                                                   [&](const V& x, Real p) { return node.open(x, old, p, dt); });
      CHECK(open.gradient < 1e-8);
      CHECK(open.force < 1e-8);
      CHECK(open.tangent < 1e-8);
    }
    CHECK(now.pressure.residual == 0);
  }
  if (expect == Expect::separated) {
    CHECK(now.force.norm() == 0);
    CHECK(now.stiffness.norm() == 0);
  }
}

/// Every state of a node, for a law with a bound between about 0.1 and 0.5 of the pressure.
template <class Friction>
void check_states(const typename Friction::Law& law) {
  for (const Touch& scene : scenes) {
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

/// Along a walk from sticking into sliding: the slipped distance at the switch, by bisection.
template <class Friction>
void check_switch(const typename Friction::Law& law) {
  for (const Touch& scene : scenes) {
    const V out = place(scene, -0.01, 0), first = place(scene, 0.02, 0.0);
    const auto node = node_on<Friction>(scene, law);
    const auto at = [&](Real along) { return std::vector<V>{out, first, first, place(scene, 0.02, along)}; };
    const auto sliding = [&](Real along) {
      return node.template at<Real>(at(along).back(), node.template preloaded<Real>(at(along), dt), dt).sliding;
    };
    Real low = 0, high = 0.3;
    for (int i = 0; i < 80; ++i) (sliding(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    const auto below = at(low * (1 - 1e-7)), above = at(high * (1 + 1e-7));
    CHECK_FALSE(sliding(low * (1 - 1e-7)));
    CHECK(sliding(high * (1 + 1e-7)));
    CHECK(verify::contact_tangent(node, below, dt).by_duals < 1e-11);
    CHECK(verify::contact_tangent(node, above, dt).by_duals < 1e-11);
    const auto old = node.template preloaded<Real>(below, dt);
    const auto stick = node.template at<Real>(below.back(), old, dt),
               slip = node.template at<Real>(above.back(), old, dt);
    CHECK((stick.force - slip.force).norm() < 1e-5 * stick.force.norm());              // no jump of the force
    CHECK((stick.stiffness - slip.stiffness).norm() > 0.01 * stick.stiffness.norm());  // but of its slope
  }
}
/// Random walks in and out of contact: the second law of thermodynamics and the bound, at every step.
template <class Friction>
void check_walk(const typename Friction::Law& law) {
  std::mt19937 random(11);
  std::normal_distribution<Real> normal(0, 1);
  for (const Touch& scene : scenes) {
    const auto node = node_on<Friction>(scene, law);
    auto memory = node.template preloaded<Real>({place(scene, -0.01, 0), place(scene, -0.01, 0)}, dt);
    Real along = 0, slip = 0;
    int sliding = 0, sticking = 0, away = 0;
    for (int i = 0; i < 400; ++i) {
      along = std::clamp(along + 0.03 * normal(random), -0.8, 0.8);
      const auto now = node.template at<Real>(place(scene, 0.03 + 0.02 * normal(random), along), memory, dt);
      CHECK(now.dissipated >= 0);
      CHECK(now.memory.friction.accumulated_slip >= slip);
      slip = now.memory.friction.accumulated_slip;
      const Real bound = bound_of<Friction>(law, now, memory);
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
}  // namespace contact_states
