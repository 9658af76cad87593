// SPDX-License-Identifier: BSL-1.0
#include <stickslip/dofs/index_map.hpp>
#include <stickslip/element/gradient_operator.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/mesh/extrude.hpp>
#include <stickslip/mesh/facet.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/mesh/quarter_disc.hpp>

#include <doctest/doctest.h>

#include <set>

namespace {

using namespace stickslip;

Real area(const Mesh<2, 4>& m, std::size_t cell) {
  Real twice = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto& p = m.nodes[std::size_t(m.cells[cell][a])];
    const auto& q = m.nodes[std::size_t(m.cells[cell][(a + 1) % 4])];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return 0.5 * twice;
}

TEST_CASE("a rectangle has every node and cell once, and its cells run counter-clockwise") {
  for (const auto& cells : {std::array<Index, 2>{3, 2}, {2, 3}, {1, 1}, {4, 4}, {1, 7}}) {
    const auto m = mesh::rectangle({.origin = {1, -2}, .size = {3, 4}, .cells = cells});
    CHECK(m.node_count() == (cells[0] + 1) * (cells[1] + 1));
    CHECK(m.cell_count() == cells[0] * cells[1]);
    Real sum = 0;
    std::set<std::array<Index, 4>> seen;
    for (std::size_t e = 0; e < m.cells.size(); ++e) {
      CHECK(area(m, e) == doctest::Approx(12.0 / m.cell_count()).epsilon(1e-14));
      sum += area(m, e);
      seen.insert(m.cells[e]);
    }
    CHECK(seen.size() == m.cells.size());
    CHECK(sum == doctest::Approx(12).epsilon(1e-14));
    std::set<std::pair<Real, Real>> places;
    for (const auto& n : m.nodes) places.insert({n[0], n[1]});
    CHECK(places.size() == m.nodes.size());
  }
}

TEST_CASE("a rectangle is numbered along the direction with fewer cells") {
  for (const auto& cells : {std::array<Index, 2>{9, 2}, {2, 9}}) {
    const auto m = mesh::rectangle({.cells = cells});
    Index widest = 0;
    for (const auto& c : m.cells)
      widest = std::max(widest, *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()));
    CHECK(widest == 4);  // 3 nodes a layer: the next layer's neighbour is 3 + 1 away
  }
}

TEST_CASE("the sides of a rectangle lie on their lines with the body on the left") {
  const auto m = mesh::rectangle({.origin = {1, -2}, .size = {3, 4}, .cells = {3, 2}});
  const auto check = [&](const char* name, int component, Real value, std::size_t count) {
    const auto& side = m.side(name);
    CHECK(side.nodes.size() == count + 1);
    CHECK(side.facets.size() == count);
    for (const Index n : side.nodes) CHECK(m.nodes[std::size_t(n)][component] == doctest::Approx(value).epsilon(1e-15));
    const Vec<Real, 2> middle(2.5, 0);
    for (const auto& f : side.facets) {
      const Vec<Real, 2> a = m.nodes[std::size_t(f[0])], along = m.nodes[std::size_t(f[1])] - a, to = middle - a;
      CHECK(along[0] * to[1] - along[1] * to[0] > 0);
    }
  };
  check("left", 0, 1, 2);
  check("right", 0, 4, 2);
  check("bottom", 1, -2, 3);
  check("top", 1, 2, 3);
}

TEST_CASE("the tributary areas of an edge are those of its kinematics") {
  const auto m = mesh::rectangle({.origin = {1, 0}, .size = {2, 1}, .cells = {1, 1}});
  const auto bottom = m.side("bottom").facets[0];
  CHECK(tributary_area(m, PlaneStrain{.thickness = 3}, bottom, bottom[0]) == doctest::Approx(3).epsilon(1e-15));
  CHECK(tributary_area(m, PlaneStrain{.thickness = 3}, bottom, bottom[1]) == doctest::Approx(3).epsilon(1e-15));
  CHECK(tributary_area(m, PlaneStrain{}, bottom, m.side("top").nodes[0]) == 0);
  // Axisymmetric, from r = 1 to 3: the integral of 2 pi r N_a dr.
  const Real inner = tributary_area(m, Axisymmetric{}, bottom, bottom[0]),
             outer = tributary_area(m, Axisymmetric{}, bottom, bottom[1]);
  CHECK(inner == doctest::Approx(2 * pi * (2 * (1.0 / 2 + 2.0 / 6))).epsilon(1e-14));
  CHECK(inner + outer == doctest::Approx(pi * (9 - 1)).epsilon(1e-14));
}

TEST_CASE("bilinear shape functions sum to one, and the quadrature integrates the area") {
  const auto rule = Quad4::quadrature();
  Mat<Real, 4, 2> X;
  X << 1.0, 0.1, 2.3, -0.2, 2.0, 1.4, 0.8, 0.9;
  Real sum = 0;
  for (const auto& q : rule) {
    CHECK(Quad4::shape(q.xi).sum() == doctest::Approx(1).epsilon(1e-15));
    CHECK(Quad4::gradient(q.xi).colwise().sum().norm() < 1e-15);
    const auto point = point_geometry<PlaneStrain, Quad4>({}, X, q.xi, q.weight);
    sum += point.weight;
    CHECK((X.transpose() * point.dN_dX - Mat<Real, 2>::Identity()).norm() < 1e-14);
  }
  Real twice = 0;
  for (int a = 0; a < 4; ++a) twice += X(a, 0) * X((a + 1) % 4, 1) - X(a, 1) * X((a + 1) % 4, 0);
  CHECK(sum == doctest::Approx(0.5 * twice).epsilon(1e-14));
}

using V3 = Vec<Real, 3>;
V3 cross(const V3& a, const V3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real volume(const Mesh<3, 8>& m, std::size_t cell) {
  Mat<Real, 8, 3> X;
  for (int a = 0; a < 8; ++a) X.row(a) = m.nodes[std::size_t(m.cells[cell][std::size_t(a)])].transpose();
  Real sum = 0;
  for (const auto& q : Hex8::quadrature()) sum += point_geometry<ThreeDimensional, Hex8>({}, X, q.xi, q.weight).weight;
  return sum;
}

TEST_CASE("a box has every node and cell once, and its volumes are positive and add up") {
  for (const auto& cells : {std::array<Index, 3>{3, 2, 4}, {4, 3, 2}, {2, 4, 3}, {1, 1, 1}, {2, 2, 2}, {1, 5, 1}}) {
    const auto m = mesh::box({.origin = {1, -2, 5}, .size = {3, 4, 2}, .cells = cells});
    CHECK(m.node_count() == (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1));
    CHECK(m.cell_count() == cells[0] * cells[1] * cells[2]);
    std::set<std::array<Index, 8>> seen;
    for (std::size_t e = 0; e < m.cells.size(); ++e) {
      CHECK(volume(m, e) == doctest::Approx(24.0 / m.cell_count()).epsilon(1e-14));
      seen.insert(m.cells[e]);
    }
    CHECK(seen.size() == m.cells.size());
    std::set<std::array<Real, 3>> places;
    for (const auto& n : m.nodes) places.insert({n[0], n[1], n[2]});
    CHECK(places.size() == m.nodes.size());
  }
}

TEST_CASE("a box is numbered along the direction with the fewest cells") {
  for (const auto& cells : {std::array<Index, 3>{9, 2, 4}, {2, 4, 9}, {4, 9, 2}}) {
    const auto m = mesh::box({.cells = cells});
    Index widest = 0;
    for (const auto& c : m.cells)
      widest = std::max(widest, *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()));
    CHECK(widest == 3 * 5 + 3 + 1);  // a layer of 3 x 5 nodes, a row of 3 and a node on
  }
}

TEST_CASE("the sides of a box lie on their planes with outward normals") {
  const V3 origin(1, -2, 5), size(3, 4, 2);
  const std::array<Index, 3> cells{3, 2, 4};
  const auto m = mesh::box({.origin = origin, .size = size, .cells = cells});
  const auto check = [&](const char* name, int normal, Real sign) {
    const auto& side = m.side(name);
    const std::size_t u = std::size_t(normal + 1) % 3, v = std::size_t(normal + 2) % 3;
    CHECK(side.facets.size() == std::size_t(cells[u] * cells[v]));
    CHECK(side.nodes.size() == std::size_t((cells[u] + 1) * (cells[v] + 1)));
    CHECK(std::set<Index>(side.nodes.begin(), side.nodes.end()).size() == side.nodes.size());
    const Real plane = origin[normal] + (sign > 0 ? size[normal] : 0);
    for (const Index n : side.nodes) CHECK(m.nodes[std::size_t(n)][normal] == doctest::Approx(plane).epsilon(1e-15));
    Real total = 0;
    for (const auto& f : side.facets) {
      std::array<V3, 4> x;
      for (std::size_t a = 0; a < 4; ++a) x[a] = m.nodes[std::size_t(f[a])];
      const V3 twice = cross(x[2] - x[0], x[3] - x[1]);
      CHECK(twice[normal] * sign == doctest::Approx(twice.norm()).epsilon(1e-14));
      total += 0.5 * twice.norm();
    }
    CHECK(total == doctest::Approx(size.prod() / size[normal]).epsilon(1e-14));
  };
  check("left", 0, -1);
  check("right", 0, 1);
  check("bottom", 1, -1);
  check("top", 1, 1);
  check("back", 2, -1);
  check("front", 2, 1);
}

TEST_CASE("a quarter disc has every node and cell once, convex cells and the area of its polygon") {
  for (const auto& cells : {std::array<Index, 2>{1, 1}, {2, 3}, {7, 7}, {9, 2}, {1, 6}}) {
    const Real radius = 3;
    const auto m = mesh::quarter_disc({.radius = radius, .cells = cells});
    const Index n = cells[0];
    CHECK(m.cell_count() == n * n + 2 * n * cells[1]);
    CHECK(m.node_count() == (n + 1) * (n + 1) + (2 * n + 1) * cells[1]);
    Real sum = 0, smallest = 1;
    std::set<std::set<Index>> seen;
    std::vector<int> used(m.nodes.size(), 0);
    for (std::size_t e = 0; e < m.cells.size(); ++e) {
      sum += area(m, e);
      seen.insert({m.cells[e].begin(), m.cells[e].end()});
      for (std::size_t a = 0; a < 4; ++a) {
        ++used[std::size_t(m.cells[e][a])];
        const auto at = [&](std::size_t b) { return m.nodes[std::size_t(m.cells[e][b % 4])]; };
        const Vec<Real, 2> u = (at(a + 1) - at(a)).normalized(), v = (at(a + 3) - at(a)).normalized();
        smallest = std::min(smallest, u[0] * v[1] - u[1] * v[0]);  // sine of the angle at the corner
      }
    }
    CHECK(seen.size() == m.cells.size());
    CHECK(*std::min_element(used.begin(), used.end()) > 0);
    CHECK(smallest > 0.75);  // between 49 and 131 degrees
    CHECK(sum == doctest::Approx(0.5 * radius * radius * 2 * n * std::sin(0.25 * pi / n)).epsilon(1e-14));
    std::set<std::pair<Real, Real>> places;
    for (const auto& x : m.nodes) places.insert({x[0], x[1]});
    CHECK(places.size() == m.nodes.size());
    for (const auto& x : m.nodes) CHECK(places.count({x[1], x[0]}) == 1);  // a mirror image of itself
  }
}

TEST_CASE("the sides of a quarter disc lie on the axes and the circle, with equal cells along the axes") {
  const auto m = mesh::quarter_disc({.radius = 14, .cells = {7, 7}});
  const auto inside = [&](const std::array<Index, 2>& facet) {
    const Vec<Real, 2> a = m.nodes[std::size_t(facet[0])], along = m.nodes[std::size_t(facet[1])] - a,
                       to = Vec<Real, 2>(4, 4) - a;
    return along[0] * to[1] - along[1] * to[0] > 0;
  };
  for (const auto& [name, count] : {std::pair("x=0", 14u), {"y=0", 14u}, {"rim", 14u}}) {
    const auto& side = m.side(name);
    CHECK(side.facets.size() == count);
    CHECK(side.nodes.size() == count + 1);
    for (const auto& facet : side.facets) CHECK(inside(facet));
  }
  for (std::size_t k = 0; k < 15; ++k) {
    const Real along = static_cast<Real>(k);
    const auto &x = m.nodes[std::size_t(m.side("y=0").nodes[k])],
               &y = m.nodes[std::size_t(m.side("x=0").nodes[14 - k])];
    CHECK((x - Vec<Real, 2>(along, 0)).norm() < 1e-13);
    CHECK((y - Vec<Real, 2>(0, along)).norm() < 1e-13);
    CHECK(x[1] == 0);
    CHECK(y[0] == 0);
    CHECK(m.nodes[std::size_t(m.side("rim").nodes[k])].norm() == doctest::Approx(14).epsilon(1e-15));
  }
  Index widest = 0;
  for (const auto& c : m.cells)
    widest = std::max(widest, *std::max_element(c.begin(), c.end()) - *std::min_element(c.begin(), c.end()));
  CHECK(widest == 16);  // 15 nodes an arc: the next arc's neighbour is 15 + 1 away
}

TEST_CASE("an extruded rectangle is a box") {
  const auto flat = mesh::rectangle({.origin = {1, -2}, .size = {3, 4}, .cells = {3, 5}});
  const auto m = mesh::extrude(flat, {.thickness = 2, .layers = 2, .from = 5});
  const auto b = mesh::box({.origin = {1, -2, 5}, .size = {3, 4, 2}, .cells = {3, 5, 2}});
  REQUIRE(m.node_count() == b.node_count());
  REQUIRE(m.cell_count() == b.cell_count());
  // Numbered alike, as there are fewer layers than cells across.
  for (std::size_t n = 0; n < m.nodes.size(); ++n) CHECK((m.nodes[n] - b.nodes[n]).norm() < 1e-14);
  CHECK(std::set(m.cells.begin(), m.cells.end()) == std::set(b.cells.begin(), b.cells.end()));
  REQUIRE(m.sides.size() == b.sides.size());
  for (const auto& [name, side] : b.sides) {
    const auto& mine = m.side(name);
    CHECK(std::set(mine.nodes.begin(), mine.nodes.end()) == std::set(side.nodes.begin(), side.nodes.end()));
    CHECK(mine.nodes.size() == side.nodes.size());
    CHECK(mine.facets.size() == side.facets.size());
    // The same facets, wherever their walk begins.
    std::set<std::array<Index, 4>> walks;
    for (const auto& [p, q, r, s] : side.facets) walks.insert({{p, q, r, s}, {q, r, s, p}, {r, s, p, q}, {s, p, q, r}});
    for (const auto& facet : mine.facets) CHECK(walks.count(facet) == 1);
  }
}

TEST_CASE("an extruded quarter disc has positive volumes, a closed surface and named faces") {
  const auto m = mesh::extrude(mesh::quarter_disc({.radius = 3, .cells = {4, 3}}),
                               {.thickness = 0.5, .layers = 2, .low = "bottom", .high = "top"});
  Real sum = 0;
  for (std::size_t e = 0; e < m.cells.size(); ++e) {
    CHECK(volume(m, e) > 0);
    sum += volume(m, e);
  }
  CHECK(sum == doctest::Approx(0.5 * 4.5 * 8 * std::sin(pi / 16)).epsilon(1e-14));
  V3 skin = V3::Zero();  // twice the vector area, which vanishes for a closed surface whose normals agree
  Real enclosed = 0;     // six times the volume, by the divergence theorem
  for (const auto& [name, side] : m.sides) {
    CHECK(std::set(side.nodes.begin(), side.nodes.end()).size() == side.nodes.size());
    for (const auto& f : side.facets) {
      std::array<V3, 4> x;
      for (std::size_t a = 0; a < 4; ++a) x[a] = m.nodes[std::size_t(f[a])];
      const V3 twice = cross(x[2] - x[0], x[3] - x[1]);
      skin += twice;
      enclosed += twice.dot(0.25 * (x[0] + x[1] + x[2] + x[3]));
    }
  }
  CHECK(skin.norm() < 1e-14);
  CHECK(enclosed == doctest::Approx(6 * sum).epsilon(1e-14));
  for (const auto& [name, z] : {std::pair("bottom", 0.0), {"top", 0.5}})
    for (const Index n : m.side(name).nodes) CHECK(m.nodes[std::size_t(n)][2] == z);
  CHECK(m.side("rim").facets.size() == 16);
  CHECK(m.side("x=0").nodes.size() == 24);
}

TEST_CASE("extrusion and quarter disc refuse wrong input by name") {
  const auto complaint = [](auto&& make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  const auto flat = mesh::rectangle({});
  const Real nan = std::nan("");
  CHECK(complaint([] { mesh::quarter_disc({.cells = {0, 3}}); }).find("cell") != std::string::npos);
  CHECK(complaint([] { mesh::quarter_disc({.cells = {3, 0}}); }).find("cell") != std::string::npos);
  CHECK(complaint([] { mesh::quarter_disc({.radius = -1}); }).find("radius") != std::string::npos);
  CHECK(complaint([&] { mesh::quarter_disc({.radius = nan}); }).find("radius") != std::string::npos);
  CHECK(complaint([&] { mesh::extrude(flat, {.layers = 0}); }).find("layer") != std::string::npos);
  CHECK(complaint([&] { mesh::extrude(flat, {.thickness = 0}); }).find("thickness") != std::string::npos);
  CHECK(complaint([&] { mesh::extrude(flat, {.from = nan}); }).find("start") != std::string::npos);
  CHECK(complaint([&] { mesh::extrude(flat, {.high = "left"}); }).find("\"left\"") != std::string::npos);
  CHECK(complaint([&] { mesh::extrude(flat, {.low = "a", .high = "a"}); }).find("\"a\"") != std::string::npos);
}

TEST_CASE("the tributary areas of a facet in space are the integrals of its shape functions") {
  Mesh<3, 8> m;
  const std::array<Index, 4> facet{0, 1, 2, 3};
  // Flat, no parallel edges, in a tilted plane: the integral of N_a over it, by quadrature.
  const V3 e(2. / 3, 2. / 3, 1. / 3), f(-2. / 3, 1. / 3, 2. / 3);
  Mat<Real, 4, 2> X;
  X << 0.1, 0, 2.3, -0.2, 2.0, 1.7, 0.4, 0.9;
  for (int a = 0; a < 4; ++a) m.nodes.push_back(V3(1, 2, 3) + X(a, 0) * e + X(a, 1) * f);
  Vec<Real, 4> expected = Vec<Real, 4>::Zero();
  for (const auto& q : Quad4::quadrature())
    expected += Quad4::shape(q.xi) * point_geometry<PlaneStrain, Quad4>({}, X, q.xi, q.weight).weight;
  for (const Index n : {0, 1, 2, 3})
    CHECK(tributary_area(m, ThreeDimensional{}, facet, n) == doctest::Approx(expected[n]).epsilon(1e-14));
  CHECK(tributary_area(m, ThreeDimensional{}, facet, 7) == 0);
  CHECK(expected.maxCoeff() > 1.2 * expected.minCoeff());
  // Warped: the shares are positive and add up to the projection along the mean normal.
  m.nodes[2] += 0.5 * cross(e, f);
  Real sum = 0;
  for (const Index n : {0, 1, 2, 3}) {
    CHECK(tributary_area(m, ThreeDimensional{}, facet, n) > 0);
    sum += tributary_area(m, ThreeDimensional{}, facet, n);
  }
  CHECK(sum == doctest::Approx(0.5 * cross(m.nodes[2] - m.nodes[0], m.nodes[3] - m.nodes[1]).norm()).epsilon(1e-14));
}

TEST_CASE("trilinear shape functions sum to one and reproduce a linear field") {
  Mat<Real, 8, 3> X;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
      X(a, i) = Hex8::corner[std::size_t(a)][std::size_t(i)] + 0.15 * std::sin(5.0 * a + 2 * i);
  for (const auto& q : Hex8::quadrature()) {
    CHECK(Hex8::shape(q.xi).sum() == doctest::Approx(1).epsilon(1e-15));
    CHECK(Hex8::gradient(q.xi).colwise().sum().norm() < 1e-15);
    const auto point = point_geometry<ThreeDimensional, Hex8>({}, X, q.xi, q.weight);
    CHECK(point.weight > 0);
    CHECK((X.transpose() * point.dN_dX - Mat<Real, 3>::Identity()).norm() < 1e-14);
  }
  for (int a = 0; a < 8; ++a) {
    const auto& c = Hex8::corner[std::size_t(a)];
    const Vec<Real, 8> N = Hex8::shape({c[0], c[1], c[2]});
    CHECK(N == Vec<Real, 8>::Unit(a));
  }
}

TEST_CASE("the index map numbers the free components and converts fields in both directions") {
  const IndexMap dofs(6, {false, true, false, false, true, false});
  CHECK(dofs.unknowns() == 4);
  CHECK(dofs.components() == 6);
  CHECK(dofs.equation(1) == IndexMap::constrained);
  CHECK(dofs.equation(5) == 3);
  Field field(6), unknowns(4);
  field << 1, 2, 3, 4, 5, 6;
  dofs.gather(field, unknowns);
  CHECK(unknowns == (Field(4) << 1, 3, 4, 6).finished());
  dofs.scatter_add(2, unknowns, field);
  CHECK(field == (Field(6) << 3, 2, 9, 12, 5, 18).finished());
}

}  // namespace
