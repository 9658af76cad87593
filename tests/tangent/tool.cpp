// SPDX-License-Identifier: BSL-1.0
#include <stickslip/geometry/pose.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/verify/tool.hpp>

#include <doctest/doctest.h>

#include <random>

namespace tool {

using namespace stickslip;
using rigid::Profile;
using V = Vec<Real, 2>;

Real far_from(const std::vector<V>& points, const V& x) {
  Real nearest = 1e300;
  for (const V& p : points) nearest = std::min(nearest, (x - p).norm());
  return nearest;
}

// Derivatives at random points of a box, and the distance against a fine picture of the tool. `reach`: of endless ends.
void check_tool(const Profile& tool, const V& low, const V& high, Real reach, Real spacing = 1e-3) {
  const std::vector<V> picture = tool.sample(spacing, reach);
  // Straight pieces come as their two ends: fill them in.
  std::vector<V> points;
  for (std::size_t i = 0; i + 1 < picture.size(); ++i) {
    const int n = std::max(1, int((picture[i + 1] - picture[i]).norm() / spacing));
    for (int k = 0; k < n; ++k) points.push_back(picture[i] + (picture[i + 1] - picture[i]) * k / n);
  }
  points.push_back(picture.back());
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> u(0, 1);
  Real worst = 0, worst_distance = 0;
  for (int i = 0; i < 400; ++i) {
    const V x(low[0] + (high[0] - low[0]) * u(random), low[1] + (high[1] - low[1]) * u(random));
    worst = std::max(worst, verify::tool_derivatives(tool, x).worst());
    // A picture is off by up to half the spacing along the tool: s^2 / (8 d) at distance d, and the chord's sagitta.
    const Real d = far_from(points, x);
    if (d > 10 * spacing) worst_distance = std::max(worst_distance, std::abs(std::abs(tool.closest(x).gap) - d));
  }
  CHECK(worst < 1e-10);
  CHECK(worst_distance < 0.1 * spacing);
}

TEST_CASE("a line has the exact gap, normal and derivatives") {
  check_tool(rigid::line({1, 2}, {3, 1}), {-1, -1}, {3, 4}, 20);
}
TEST_CASE("a convex arc has the exact gap, normal and derivatives") {
  check_tool(rigid::path({0, 0}, {0, 1}).right(2, pi / 2), {0.5, 0.5}, {1.9, 1.9}, 1);
}
TEST_CASE("a concave arc has the exact gap, normal and derivatives") {
  check_tool(rigid::path({0, 0}, {1, 0}).left(2, pi / 2), {0.4, 0.1}, {1.9, 1.2}, 1);
}
TEST_CASE("a path with smooth joints has the exact gap, normal and derivatives") {
  const Profile path =
      rigid::path({0, 0}, {1, 0}).straight(1).left(0.7, 1.1).straight(0.5).right(0.9, 1.4).straight(1).endless();
  check_tool(path, {-1, 0}, {4, 2}, 10);
}
TEST_CASE("a convex corner has the exact gap, normal and derivatives") {
  check_tool(rigid::path({0, 0}, {1, 0}).straight(1).corner(-1.2).straight(1).endless(), {0, -1}, {3, 2}, 10);
}
TEST_CASE("a re-entrant corner has the exact gap, normal and derivatives") {
  check_tool(rigid::path({0, 0}, {1, 0}).straight(1).corner(1.2).straight(1).endless(), {-1, -2}, {2, 1}, 10);
}
TEST_CASE("a disc has the exact gap, normal and derivatives") {
  check_tool(rigid::disc({1, 2}, 1.5), {-1.5, -0.5}, {3.5, 4.5}, 1);
  const auto disc = rigid::disc({1, 2}, 1.5);
  CHECK(disc.closest(V(1, 4)).gap == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(disc.closest(V(1, 3)).gap == doctest::Approx(-0.5).epsilon(1e-14));
  CHECK(disc.length() == doctest::Approx(3 * pi).epsilon(1e-14));
}
TEST_CASE("rounded and sharp polygon lines have the exact gap, normal and derivatives") {
  const std::vector<V> points{{0, 0}, {2, 0}, {3, 1.5}, {5, 1}, {6, 3}};
  check_tool(rigid::rounded(points, 0.3), {0.3, -1}, {5.5, 3}, 1);
  check_tool(rigid::rounded(points, 0), {0.3, -1}, {5.5, 3}, 1);
  // Both go from the first point to the last.
  for (const Real radius : {0.0, 0.3}) {
    const auto tool = rigid::rounded(points, radius);
    const auto picture = tool.sample(0.01, 1);
    CHECK((picture.front() - points.front()).norm() < 1e-14);
    CHECK((picture.back() - points.back()).norm() < 1e-13);
  }
}

TEST_CASE("the gap of a corner is the distance with the sign of the side") {
  const auto out = rigid::path({-1, 0}, {1, 0}).straight(1).corner(-pi / 2).straight(1);  // body above and to the right
  CHECK(out.closest(V(0.3, 0.4)).gap == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(out.closest(V(-0.1, -0.2)).gap == doctest::Approx(-0.1).epsilon(1e-14));
  const auto in = rigid::path({-1, 0}, {1, 0}).straight(1).corner(pi / 2).straight(1);  // body above and to the left
  CHECK(in.closest(V(0.3, -0.4)).gap == doctest::Approx(-0.5).epsilon(1e-14));
  CHECK(in.closest(V(-0.1, 0.2)).gap == doctest::Approx(0.1).epsilon(1e-14));
}

TEST_CASE("gap, normal and surface coordinate are continuous at smooth joints") {
  const Profile path = rigid::path({0, 0}, {1, 0}).straight(1).left(0.7, 1.1).straight(0.5).right(0.9, 1.4).straight(1);
  V at(1, 0), heading(1, 0);
  const auto turn = [](const V& v, Real a) {
    return V(std::cos(a) * v[0] - std::sin(a) * v[1], std::sin(a) * v[0] + std::cos(a) * v[1]);
  };
  std::vector<std::pair<V, V>> joints{{at, heading}};
  V left(-heading[1], heading[0]);
  at = at + 0.7 * left + turn(V(-0.7 * left), 1.1);
  heading = turn(heading, 1.1);
  joints.push_back({at, heading});
  at += 0.5 * heading;
  joints.push_back({at, heading});
  left = V(-heading[1], heading[0]);
  at = at - 0.9 * left + turn(V(0.9 * left), -1.4);
  heading = turn(heading, -1.4);
  joints.push_back({at, heading});
  constexpr Real h = 1e-9;
  Real expected_place = 1;
  const std::array<Real, 4> lengths{0.7 * 1.1, 0.5, 0.9 * 1.4, 0};
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto& [joint, along] = joints[j];
    const V across(-along[1], along[0]);
    for (const Real d : {-0.2, -1e-3, 0.0, 1e-3, 0.2}) {
      const auto before = path.closest(V(joint + d * across - h * along)),
                 after = path.closest(V(joint + d * across + h * along));
      CHECK(std::abs(before.gap - d) < 1e-14);
      CHECK(std::abs(after.gap - d) < 1e-14);
      CHECK((before.normal - after.normal).norm() < 10 * h);
      CHECK(std::abs(after.surface_coordinate[0] - before.surface_coordinate[0] - 2 * h) < 2 * h);
      CHECK(std::abs(before.surface_coordinate[0] - expected_place) < 3 * h);
    }
    expected_place += lengths[j];
  }
}

TEST_CASE("the seam of a closed chain counts the short way") {
  const auto disc = rigid::disc({0, 0}, 2);  // seam at (-2, 0)
  const Real before = disc.closest(V(-2.1, -0.01)).surface_coordinate[0],
             after = disc.closest(V(-2.1, 0.01)).surface_coordinate[0];
  CHECK(std::abs(after - before) > 6 * pi / 2);
  CHECK(std::abs(disc.difference(after, before) - 2 * 2 * std::atan2(0.01, 2.1)) < 1e-12);
  CHECK(std::abs(disc.difference(before, after) + 2 * 2 * std::atan2(0.01, 2.1)) < 1e-12);
  CHECK((disc.closest(V(-2.1, -1e-9)).normal - disc.closest(V(-2.1, 1e-9)).normal).norm() < 1e-8);
}

TEST_CASE("past an open end there is no contact") {
  const auto plate = rigid::path({0, 0}, {1, 0}).straight(1);
  CHECK(plate.closest(V(0.5, -0.1)).gap == doctest::Approx(-0.1));
  CHECK(plate.closest(V(1.1, -0.1)).gap > 0);
  CHECK(plate.closest(V(-0.1, -0.1)).gap > 0);
  const auto arc = rigid::path({0, 0}, {0, 1}).right(2, pi / 2);
  CHECK(arc.closest(V(1, -0.5)).gap > 0);
  CHECK(verify::tool_derivatives(arc, V(1, -0.5)).worst() < 1e-10);
}

TEST_CASE("a disc has a normal at its centre and no gap at NaN") {
  const auto disc = rigid::disc({1, 2}, 1.5);
  const auto middle = disc.closest(V(1, 2));
  CHECK(middle.gap == doctest::Approx(-1.5));
  CHECK(middle.normal.norm() == doctest::Approx(1));
  CHECK(std::isnan(disc.closest(V(std::nan(""), 0)).gap));
}

TEST_CASE("a pose rotates about its centre") {
  const auto pose = rigid::turned(pi / 2, {1, 0}, {0, 3});
  const V x = pose.rotation * V(2, 0) + pose.translation;
  CHECK((x - V(1, 4)).norm() < 1e-14);
  CHECK((rigid::Motion<2>{}.at(5).translation).norm() == 0);
  const rigid::Motion<2> slide([](Real t) { return V(t, 2 * t); });
  CHECK((slide.at(2).translation - V(2, 4)).norm() == 0);
  const rigid::Motion<2> spin([](Real t) { return rigid::turned(t, {0, 0}); });
  CHECK(spin.at(pi / 2).rotation(1, 0) == doctest::Approx(1));
}

}  // namespace tool
