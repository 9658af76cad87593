// SPDX-License-Identifier: BSL-1.0
#include "contact_states.hpp"

#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>

namespace contact_node {

using namespace contact_states;

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
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    using std::exp;
    const S fading = S(mu_static - mu_dynamic) * exp(at.accumulated_slip * (-1 / length));
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
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    return {S(strength) + at.accumulated_slip * hardening, S(0), S(hardening)};
  }
};
static_assert(FrictionPolicy<SlipWeakening> && FrictionPolicy<Quasi<SlipWeakening>> && FrictionPolicy<Adhesion>);
static_assert(friction_symmetry<Frictionless>() == Symmetry::symmetric);
static_assert(friction_symmetry<Coulomb>() == Symmetry::general);
static_assert(friction_symmetry<QuasiCoulomb>() == Symmetry::symmetric);
static_assert(friction_symmetry<SlipWeakening>() == Symmetry::general);
static_assert(friction_symmetry<Quasi<SlipWeakening>>() == Symmetry::symmetric);
static_assert(friction_symmetry<Adhesion>() == Symmetry::symmetric);

TEST_CASE("Coulomb's contact tangent is exact in every state of a node") {
  check_states<Coulomb>({.mu = 0.3});
  for (const Touch& scene : scenes) {  // first contact: the current pressure binds at once
    check<Coulomb>(scene, {.mu = 0.3}, {place(scene, -0.01, 0), place(scene, 0.02, 0.01)}, Expect::sticking);
    check<Coulomb>(scene, {.mu = 0.3}, {place(scene, -0.01, 0), place(scene, 0.02, 0.2)}, Expect::sliding);
  }
}
TEST_CASE("Quasi-Coulomb's contact tangent is exact in every state of a node") {
  check_states<QuasiCoulomb>({.mu = 0.3});
  for (const Touch& scene : scenes) {  // first contact: no converged pressure, the node slides freely
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
TEST_CASE("the contact tangent of a user's slip weakening is exact in every state of a node") {
  check_states<SlipWeakening>({});
  check_states<Quasi<SlipWeakening>>({});
}
TEST_CASE("the contact tangent of a user's hardening adhesion is exact in every state of a node") {
  check_states<Adhesion>({});
}

TEST_CASE("the frictionless contact tangent is exact and symmetric in every state of a node") {
  for (const Touch& scene : scenes) {
    const verify::SingleNode<Penalty, Empty<Touch>, Frictionless, rigid::Profile> node{
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

TEST_CASE("contact tangents are exact on either side of the stick-slip switch") {
  check_switch<Coulomb>({.mu = 0.3});
  check_switch<QuasiCoulomb>({.mu = 0.3});
  check_switch<SlipWeakening>({});
  check_switch<Quasi<SlipWeakening>>({});
  check_switch<Adhesion>({});
}

TEST_CASE("Coulomb's tangent is not symmetric while a node slides, and is while it sticks or mu is 0") {
  for (const Touch& scene : scenes) {
    const V out = place(scene, -0.01, 0), first = place(scene, 0.02, 0.0);
    const std::vector<V> slide{out, first, place(scene, 0.02, 0.3)}, stick{out, first, place(scene, 0.02, 0.001)};
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0.3}), slide).asymmetry > 0.1);
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0.3}), stick).asymmetry < 1e-15);
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0}), slide).asymmetry < 1e-15);
    CHECK(verify::contact_tangent(node_on<Coulomb>(scene, {.mu = 0}), slide).by_duals < 1e-12);
  }
}

TEST_CASE("Quasi-Coulomb's tangent of sliding on a flat tool has no tangential part (paper, eq. 22)") {
  const Touch flat{"flat", rigid::line({0, 0}, {1, 0}), {0, 0}};
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
  CHECK(exact.stiffness(0, 1) == 0);
  CHECK(exact.coupling()(0, 1) == doctest::Approx(-0.3 * 1.7 * 1000));
  CHECK(exact.coupling()(1, 0) == 0);
  CHECK(exact.stiffness(1, 0) == 0);
}

TEST_CASE("friction never gains energy and never exceeds its bound") {
  check_walk<Coulomb>({.mu = 0.3});
  check_walk<QuasiCoulomb>({.mu = 0.3});
  check_walk<SlipWeakening>({});
  check_walk<Quasi<SlipWeakening>>({});
  check_walk<Adhesion>({});
}

}  // namespace contact_node
