// SPDX-License-Identifier: BSL-1.0
// Friction in space: two directions on the tangent plane, on a user's own tools.
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/anisotropic_coulomb.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/verify/contact.hpp>
#include <stickslip/verify/tool.hpp>

#include <doctest/doctest.h>

#include <random>

namespace contact_space {

using namespace stickslip;
using V = Vec<Real, 3>;

struct Ball {
  Real radius = 2;
  bool empty() const { return false; }
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    using std::sqrt;
    const S r = sqrt(x.squaredNorm());
    const Vec<S, 3> n = x * S(S(1) / r);
    return {r - radius, n, (Mat<S, 3>::Identity() - n * n.transpose()) * S(S(1) / r)};
  }
};
struct Floor {
  bool empty() const { return false; }
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    return {x[2] - 2, Vec<S, 3>{S(0), S(0), S(1)}, Mat<S, 3>::Zero()};
  }
};
static_assert(RigidTool<Ball, 3> && RigidTool<Floor, 3> && !RigidTool<Ball, 2> && !RigidTool<rigid::Profile, 3>);

constexpr Penalty penalty{.normal = 1000, .tangential = 100};
constexpr Real dt = 0.5;

// Above (0, 0, 2), which both tools have in common: along x and y, and below the surface.
template <class Tool>
V place(const Tool&, Real depth, Real along, Real across) {
  if constexpr (std::is_same_v<Tool, Ball>)
    return (2 - depth) * V(std::sin(along / 2) * std::cos(across / 2), std::sin(across / 2),
                           std::cos(along / 2) * std::cos(across / 2));
  else
    return {along, across, 2 - depth};
}

template <class Friction, class Tool, class Enforcement = Penalty>
auto node_on(const Tool& tool, const typename Friction::Law& law, const Enforcement& enforcement = penalty) {
  return verify::SingleNode<Enforcement, typename Friction::Law, Friction, Tool, 3>{
      .enforcement = enforcement, .law = law, .friction = {}, .tool = tool, .weight = 1.7, .area = 2.5};
}

template <class Friction, class Tool>
void check_tangents(const Tool& tool, const typename Friction::Law& law) {
  const auto node = node_on<Friction>(tool, law);
  const V out = place(tool, -0.01, 0, 0), first = place(tool, 0.02, 0.001, -0.001);
  const std::vector<std::pair<std::vector<V>, bool>> paths{
      {{out, first, first, place(tool, 0.021, 0.004, -0.003)}, false},
      {{out, first, first, place(tool, 0.021, 0.3, 0.2)}, true},
      {{out, first, first, place(tool, 0.03, 0.3, 0.2), place(tool, 0.02, 0.1, 0.5)}, true},
      {{out, first, first, place(tool, 0.03, 0.3, 0.2), place(tool, 0.03, 0.28, 0.19)}, false}};
  for (const auto& [path, sliding] : paths) {
    const auto now = node.template at<Real>(path.back(), node.template preloaded<Real>(path, dt), dt);
    CHECK(now.sliding == sliding);
    CHECK(now.dissipated >= 0);
    const auto r = verify::contact_tangent(node, path, dt);
    CHECK(r.by_duals < 1e-11);
    CHECK(r.by_differences < 1e-8);
    if constexpr (friction_symmetry<Friction>() == Symmetry::symmetric) CHECK(r.asymmetry < 1e-15);
    // The force that is kept lies in the tangent plane and has the size that the law gave it.
    const Vec<Real, 3>& t = now.memory.friction.traction;
    CHECK(std::abs(t.dot(surface_point<Real, 3>(tool, path.back()).normal)) < 1e-13 * t.norm());
    for (const Real share : {0.97, 1.04}) {
      const auto old = node.template preloaded<Real>(path, dt);
      const auto open =
          verify::relation_report<3>(path.back(), share * now.pressure.value, 1e-5, 1e-4 * now.pressure.value,
                                     [&](const V& x, Real p) { return node.open(x, old, p, dt); });
      CHECK(open.gradient < 1e-8);
      CHECK(open.force < 1e-8);
      CHECK(open.tangent < 1e-8);
    }
  }
}

TEST_CASE("tools of a user in space have exact surface coordinates and derivatives") {
  std::mt19937 random(3);
  std::normal_distribution<Real> normal(0, 1);
  for (int i = 0; i < 50; ++i) {
    const V x(normal(random), normal(random), normal(random) + 1);
    CHECK(verify::tool_derivatives(Ball{}, x).worst() < 1e-9 / std::min(1.0, std::pow(x.norm(), 3)));
    CHECK(verify::tool_derivatives(Floor{}, x).worst() < 1e-14);
    CHECK(surface_point<Real, 3>(Ball{}, x).surface_coordinate.norm() == doctest::Approx(2).epsilon(1e-13));
  }
}

TEST_CASE(
    "contact tangents in space are exact in every state of a node, and symmetric where the pressure source promises "
    "it") {
  const Ball ball;
  const Floor floor;
  const AnisotropicCoulomb grooved{.mu_along = 0.2, .mu_across = 0.4, .direction = {1, 0.3, 0.1}};
  check_tangents<Coulomb>(ball, {.mu = 0.3});
  check_tangents<Coulomb>(floor, {.mu = 0.3});
  check_tangents<QuasiCoulomb>(ball, {.mu = 0.3});
  check_tangents<QuasiCoulomb>(floor, {.mu = 0.3});
  check_tangents<Quasi<SlipWeakeningCoulomb>>(ball, {.mu_static = 0.3, .mu_dynamic = 0.1, .length = 0.2});
  check_tangents<SlipWeakeningCoulomb>(ball, {.mu_static = 0.3, .mu_dynamic = 0.1, .length = 0.2});
  check_tangents<Tresca>(ball, {.tau = 3});
  check_tangents<AnisotropicCoulomb>(ball, grooved);
  check_tangents<AnisotropicCoulomb>(floor, grooved);
  check_tangents<Quasi<AnisotropicCoulomb>>(ball, grooved);
  check_tangents<Quasi<AnisotropicCoulomb>>(floor, grooved);
}

TEST_CASE("a tool and a path in space that rotate together rotate the force and add no slip") {
  const auto R = verify::rotation<Spatial>(0.9);
  Mat<Real, 3> turn;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turn(i, j) = R(i, j);
  const Ball ball;  // looks the same from all sides, its memory does not
  const auto node = node_on<Coulomb>(ball, {.mu = 0.3});
  std::vector<V> path{place(ball, -0.01, 0, 0), place(ball, 0.02, 0, 0), place(ball, 0.02, 0.3, 0.1),
                      place(ball, 0.03, 0.3, 0.11)};
  std::vector<V> turned;
  for (const V& x : path) turned.push_back(turn * x);
  const auto a = node.at<Real>(path.back(), node.preloaded<Real>(path, dt), dt);
  const auto b = node.at<Real>(turned.back(), node.preloaded<Real>(turned, dt), dt);
  CHECK((turn * a.force - b.force).norm() < 1e-13 * a.force.norm());
  CHECK((turn * a.stiffness * turn.transpose() - b.stiffness).norm() < 1e-13 * a.stiffness.norm());
}

TEST_CASE("friction on a ball along a plane through its centre is that on a disc, to second order in the step") {
  const Ball ball;
  const rigid::Profile disc = rigid::disc({0, 0}, 2);
  const auto node = node_on<Coulomb>(ball, {.mu = 0.3});
  const verify::SingleNode<Penalty, Coulomb, Coulomb, rigid::Profile> flat{
      .enforcement = penalty, .law = {.mu = 0.3}, .friction = {}, .tool = disc, .weight = 1.7};
  std::vector<Real> errors;
  for (const int steps : {40, 80, 160}) {
    std::vector<V> path{place(ball, -0.01, 0, 0), place(ball, 0.02, 0, 0)};
    for (int i = 1; i <= steps; ++i) path.push_back(place(ball, 0.02, 2.0 * i / steps, 0));
    std::vector<Vec<Real, 2>> section;
    for (const V& x : path) section.push_back({x[0], x[2]});
    const auto a = node.at<Real>(path.back(), node.preloaded<Real>(path, dt), dt);
    const auto b = flat.at<Real>(section.back(), flat.preloaded<Real>(section, dt), dt);
    CHECK(std::abs(a.force[1]) < 1e-12);
    errors.push_back((Vec<Real, 2>(a.force[0], a.force[2]) - b.force).norm() / b.force.norm());
    CHECK(a.memory.friction.accumulated_slip ==
          doctest::Approx(b.memory.friction.accumulated_slip).epsilon(0.05 / steps));
  }
  CHECK(errors[0] < 2e-4);
  CHECK(std::log2(errors[0] / errors[1]) > 1.7);
  CHECK(std::log2(errors[1] / errors[2]) > 1.8);
}

TEST_CASE("the sticking force on a ball returns after a closed path") {
  const Ball ball;
  const auto node = node_on<Coulomb>(ball, {.mu = 0.3});
  // Loaded once, then dragged within the bound around a loop: the force returns, but for the angle that a tangent
  // vector gains on its way around an area of a ball, and an error of second order in the steps.
  const std::vector<std::pair<Real, Real>> corners{{0.05, 0}, {0.05, 0.03}, {0.0, 0.03}, {0.0, 0.0}, {0.05, 0.0}};
  const Real gained = 0.05 * 0.03 / 4;  // area over the square of the radius
  std::vector<Real> errors;
  for (const int steps : {1, 4, 16}) {
    auto memory = node.preloaded<Real>({place(ball, -0.01, 0, 0), place(ball, 0.02, 0, 0), V(0, 0, 0)}, dt);
    const auto loaded = node.at<Real>(place(ball, 0.02, 0.05, 0), memory, dt);
    REQUIRE(!loaded.sliding);
    memory = loaded.memory;
    for (std::size_t c = 1; c < corners.size(); ++c)
      for (int i = 1; i <= steps; ++i) {
        const Real part = Real(i) / steps;
        const auto now =
            node.at<Real>(place(ball, 0.02, corners[c - 1].first + part * (corners[c].first - corners[c - 1].first),
                                corners[c - 1].second + part * (corners[c].second - corners[c - 1].second)),
                          memory, dt);
        REQUIRE(!now.sliding);
        memory = now.memory;
      }
    errors.push_back((memory.friction.traction - loaded.memory.friction.traction).norm() /
                     loaded.memory.friction.traction.norm());
    if (steps > 1) CHECK(errors.back() < 1.05 * gained);
  }
  CHECK(errors[0] < 5e-3);
  CHECK(errors[2] < errors[1]);
}

TEST_CASE("anisotropic Coulomb slides on its ellipse along the normal, and equal coefficients give Coulomb's circle") {
  const Floor floor;
  const AnisotropicCoulomb law{.mu_along = 0.1, .mu_across = 0.3, .direction = {2, 0, 0}};
  const auto node = node_on<AnisotropicCoulomb>(floor, law);
  const V first = place(floor, 0.02, 0, 0);
  const Real pressure = 1.7 * 1000 * 0.02;
  for (int k = 0; k < 16; ++k) {
    const Real angle = 2 * pi * (k + 0.5) / 16;
    // Far enough for the return to forget where it came from: the slide's direction is the drag's.
    const std::vector<V> path{V(0, 0, 2.1), first, place(floor, 0.02, 1e4 * std::cos(angle), 1e4 * std::sin(angle))};
    const auto now = node.at<Real>(path.back(), node.preloaded<Real>(path, dt), dt);
    const V t = now.memory.friction.traction;
    CHECK(now.sliding);
    CHECK(std::hypot(t[0] / 0.1, t[1] / 0.3) == doctest::Approx(pressure).epsilon(1e-12));
    const V normal(t[0] / 0.01, t[1] / 0.09, 0);
    CHECK(normal.normalized().dot(V(std::cos(angle), std::sin(angle), 0)) > 1 - 1e-6);
    // Of all forces that the ellipse allows, this one dissipates the most.
    for (int j = 0; j < 64; ++j) {
      const Real b = 2 * pi * j / 64;
      const V other(0.1 * pressure * std::cos(b), 0.3 * pressure * std::sin(b), 0);
      CHECK(other.dot(V(std::cos(angle), std::sin(angle), 0)) <
            t.dot(V(std::cos(angle), std::sin(angle), 0)) * (1 + 1e-6));
    }
    CHECK(now.dissipated == doctest::Approx(t.dot(V(1e4 * std::cos(angle), 1e4 * std::sin(angle), 0))).epsilon(1e-4));
  }
  const std::vector<V> path{V(0, 0, 2.1), first, place(floor, 0.025, 0.4, 0.3)};
  const auto round = node_on<AnisotropicCoulomb>(floor, {.mu_along = 0.3, .mu_across = 0.3, .direction = {1, 2, 3}});
  const auto plain = node_on<Coulomb>(floor, {.mu = 0.3});
  const auto a = round.at<Real>(path.back(), round.preloaded<Real>(path, dt), dt);
  const auto b = plain.at<Real>(path.back(), plain.preloaded<Real>(path, dt), dt);
  CHECK((a.force - b.force).norm() < 1e-12 * b.force.norm());
  CHECK((a.stiffness - b.stiffness).norm() < 1e-12 * b.stiffness.norm());
  CHECK(a.memory.friction.accumulated_slip == doctest::Approx(b.memory.friction.accumulated_slip).epsilon(1e-12));
  CHECK_THROWS_WITH(AnisotropicCoulomb{}.validate(),
                    "anisotropic Coulomb friction: both coefficients must be positive");
}

TEST_CASE("the multiplier of the augmented Lagrangian presses through an open gap with exact tangents") {
  const Ball ball;
  const AugmentedLagrangian augmented{.normal = 1000, .tangential = 100};
  for (const Real gap : {-0.01, 0.005, 0.05}) {
    const auto node = node_on<Coulomb>(ball, {.mu = 0.3}, augmented);
    auto old = node.preloaded<Real>({place(ball, 0, 0, 0), place(ball, 0, 0, 0)}, dt);
    old.enforcement.pressure = 17;
    const V x = place(ball, -gap, 0.2, 0.1);
    const auto now = node.at<Real>(x, old, dt);
    const Real expected = std::max(0.0, 17 - 1700 * gap);
    CHECK(now.touching == (expected > 0));
    CHECK(now.pressure.value == doctest::Approx(expected).epsilon(1e-10));
    CHECK(now.memory.enforcement.pressure == doctest::Approx(expected).epsilon(1e-10));
    const Mat<Real, 3> by_differences =
        verify::differentiate<3, 3>(x, 1e-5, [&](const V& y) { return node.at<Real>(y, old, dt).force; });
    CHECK(verify::relative_error(Mat<Real, 3>(now.stiffness + now.coupling()), by_differences) < 1e-8);
  }
}

}  // namespace contact_space
