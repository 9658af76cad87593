// SPDX-License-Identifier: BSL-1.0
// Bodies in space, without contact.
#include "affine_check.hpp"
#include "patch_check.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/io/vtu.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/verify/report.hpp>

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

namespace three_dimensional {

using namespace scene;
using V3 = Vec<Real, 3>;
using M3 = Mat<Real, 3>;
using Mean = MeanDilatation<Hex8>;
using Plain = FullyIntegrated<Hex8>;
using Bends = AssumedStrain<Hex8>;
template <class M, class E = Mean>
using Brick = Lone<EigenLdlt, M, ThreeDimensional, E>;

// Moves every node of a mesh of the unit cube, those of the boundary as well.
Mesh<3, 8> distorted_cube(const std::array<Index, 3>& cells) {
  auto mesh = mesh::box({.cells = cells});
  for (V3& x : mesh.nodes)
    x += 0.07 * V3(std::cos(3.1 * x[1] + 2 * x[2]), std::cos(2.3 * x[2] + 4 * x[0]), std::sin(2.9 * x[0] + 3 * x[1]));
  return mesh;
}
const M3 affine{{0.15, 0.1, -0.08}, {-0.05, -0.1, 0.12}, {0.07, -0.11, 0.05}};
template <class M>
void check_cube(Index steps) {
  check_patch<M>(distorted_cube({3, 3, 3}), {"left", "right", "bottom", "top", "back", "front"}, affine, steps, 8);
}
TEST_CASE("hexahedra of Hencky's law pass the patch test") {
  check_cube<Brick<Hencky, Mean>>(4);
  check_cube<Brick<Hencky, Plain>>(4);
  check_cube<Brick<Hencky, Bends>>(4);
}
TEST_CASE("plastic hexahedra pass the patch test") {
  check_cube<Brick<FiniteJ2<PowerHardening>>>(8);
  check_cube<Brick<FiniteJ2<PowerHardening>, Bends>>(8);
}

TEST_CASE_TEMPLATE("under affine motion all hexahedra have the same nodal forces", Material, Hencky,
                   FiniteJ2<PowerHardening>) {
  const auto mesh = distorted_cube({1, 1, 1});
  Mat<Real, 8, 3> X;
  for (int a = 0; a < 8; ++a) X.row(a) = mesh.nodes[std::size_t(mesh.cells[0][std::size_t(a)])].transpose();
  check_affine<Plain, Mean, ThreeDimensional>(material<Material>(), X, affine);
  check_affine<Plain, Bends, ThreeDimensional>(material<Material>(), X, affine);
}

TEST_CASE_TEMPLATE("a rigid rotation gives no stress", M, Brick<Hencky, Mean>, Brick<Hencky, Plain>,
                   Brick<FiniteJ2<LinearHardening>>) {
  const auto mesh = distorted_cube({2, 2, 2});
  Bodies<M> body(mesh, {}, material<typename M::Material>());
  typename System<M>::Pairs pairs{};
  typename System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {}, {});
  for (const Real angle : {0.4, pi / 2, 2.9}) {
    const auto Q = verify::rotation<Spatial>(angle);
    Field u(3 * mesh.node_count());
    for (Index n = 0; n < mesh.node_count(); ++n)
      for (int i = 0; i < 3; ++i) {
        const V3& X = mesh.nodes[std::size_t(n)];
        u[3 * n + i] = Q(i, 0) * X[0] + Q(i, 1) * X[1] + Q(i, 2) * X[2] - X[i] + 0.3 * i;
      }
    CHECK_FALSE(bool(system.evaluate(u, 1, 1)));
    CHECK(system.forces().residual.cwiseAbs().maxCoeff() < 1e-10 * 69004);
  }
}

// A strip that is stretched, bent and sheared: hexahedra one layer thick and held along z against quadrilaterals.
template <class Material, template <class> class Element>
void check_plane_strain() {
  const Real thickness = 0.7;
  const auto run = [&](auto& p) {
    p.hold("left", 0).hold("left", 1).drive("right", 0, [](Real t) { return 0.3 * t; });
    p.drive("right", 1, [](Real t) { return -0.4 * t; }).load("top", 1, [](Real t) { return 200 * t; });
    auto march = p.march({.end = 1, .steps = 5, .tolerance = 1e-13});
    CHECK(bool(march.finish()));
  };
  auto flat = mesh::rectangle({.size = {3, 1}, .cells = {6, 2}});
  auto thick = mesh::box({.size = {3, 1, thickness}, .cells = {6, 2, 1}});
  const auto bend = [](auto& x) { x[1] += 0.1 * std::sin(x[0]) + 0.05 * x[1] * std::cos(2 * x[0]); };
  for (auto& x : flat.nodes) bend(x);
  for (auto& x : thick.nodes) bend(x);
  Problem<Lone<EigenLdlt, Material, PlaneStrain, Element<Quad4>>> plane(
      {.body = flat, .kinematics = {.thickness = thickness}, .material = material<Material>()});
  run(plane);
  Problem<Brick<Material, Element<Hex8>>> space({.body = thick, .material = material<Material>()});
  space.hold("front", 2).hold("back", 2);
  run(space);
  Real worst = 0;
  for (Index n = 0; n < thick.node_count(); ++n)
    for (Index m = 0; m < flat.node_count(); ++m)
      if ((thick.nodes[std::size_t(n)].head<2>() - flat.nodes[std::size_t(m)]).norm() < 1e-12)
        worst = std::max(worst, (space.displacement(n).template head<2>() - plane.displacement(m)).norm());
  CHECK(worst < 1e-9);
  for (const Index i : {0, 1}) {
    const Real force = plane.reaction("right", i);
    CHECK(std::abs(force) > 1);
    CHECK(std::abs(space.reaction("right", i) - force) < 1e-9 * std::abs(force));
  }
  CHECK(std::abs(space.reaction("front", 2) + space.reaction("back", 2)) < 1e-6);
  CHECK(space.max_plastic_strain() == doctest::Approx(plane.max_plastic_strain()).epsilon(1e-9));
  if constexpr (!std::is_same_v<Material, Hencky>) CHECK(space.max_plastic_strain() > 0.05);
}
TEST_CASE("a layer of hexahedra held along z is plane strain") {
  check_plane_strain<Hencky, MeanDilatation>();
  check_plane_strain<Hencky, FullyIntegrated>();
  check_plane_strain<FiniteJ2<PowerHardening>, MeanDilatation>();
}

TEST_CASE("a bar under a dead load has the stretch of uniaxial tension") {
  const Real a = 0.8, b = 1.3, young = 70e3, poisson = 0.3, stretch = 1.2;
  Problem<Brick<Hencky>> p(
      {.body = mesh::box({.size = {2, a, b}, .cells = {3, 2, 2}}), .material = {.young = young, .poisson = poisson}});
  // Hencky's law: axial tau = E ln(stretch), and P = tau / stretch.
  const Real force = young * std::log(stretch) / stretch * a * b;
  p.hold("left", 0).hold("bottom", 1).hold("back", 2).load("right", 0, [&](Real t) { return force * t; });
  auto march = p.march({.end = 1, .steps = 5, .tolerance = 1e-12});
  CHECK(bool(march.finish()));
  for (const Index n : p.body().mesh().side("right").nodes) {
    CHECK(p.displacement(n)[0] == doctest::Approx(2 * (stretch - 1)).epsilon(1e-9));
    const V3 X = p.body().mesh().nodes[std::size_t(n)];
    CHECK(p.displacement(n)[1] == doctest::Approx(X[1] * (std::pow(stretch, -poisson) - 1)).epsilon(1e-9));
    CHECK(p.displacement(n)[2] == doctest::Approx(X[2] * (std::pow(stretch, -poisson) - 1)).epsilon(1e-9));
  }
  CHECK(p.reaction("left", 0) == doctest::Approx(-force).epsilon(1e-9));
}

// A nearly incompressible cantilever under a small load at its end.
template <class Element>
Real deflection(const std::array<Index, 3>& cells, Real poisson) {
  Problem<Brick<Hencky, Element>> p(
      {.body = mesh::box({.size = {4, 1, 1}, .cells = cells}), .material = {.young = 1000, .poisson = poisson}});
  for (const Index i : {0, 1, 2}) p.hold("left", i);
  p.load("right", 1, [](Real t) { return 1e-3 * t; });
  auto march = p.march({.end = 1, .steps = 1, .tolerance = 1e-6});
  CHECK(bool(march.finish()));
  return p.displacement(p.body().mesh().side("right").nodes.back())[1];
}
TEST_CASE("in space the mean dilatation does not lock where full integration does") {
  const Real reference = deflection<Mean>({12, 6, 6}, 0.4999);
  const Real mean = deflection<Mean>({8, 4, 4}, 0.4999), plain = deflection<Plain>({8, 4, 4}, 0.4999);
  const Real beam = 1e-3 * 64 / (3 * 1000 / 12.0) + 1e-3 * 4 * 3 * 1.2 / 1000;  // bending and shear
  MESSAGE("cantilever, over beam theory: mean dilatation ", mean / beam, ", finer ", reference / beam, ", plain ",
          plain / beam);
  CHECK(std::abs(reference / beam - 1) < 0.1);
  CHECK(std::abs(mean / reference - 1) < 0.06);
  CHECK(plain < 0.2 * reference);
  // Compressible, both are right.
  CHECK(std::abs(deflection<Plain>({8, 4, 4}, 0.3) / deflection<Mean>({8, 4, 4}, 0.3) - 1) < 0.05);
}

struct Moving : Brick<Hencky> {
  using TimeIntegration = GeneralizedAlpha;
};
TEST_CASE("of two bodies in space the one that can rotate about a line, or translate, is named") {
  auto mesh = mesh::box({.cells = {2, 2, 2}});
  const auto other = mesh::box({.origin = {5, 1, 0}, .cells = {2, 2, 2}});
  const Index first = mesh.node_count();
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (auto cell : other.cells) {
    for (Index& n : cell) n += first;
    mesh.cells.push_back(cell);
  }
  for (const auto& [name, side] : other.sides) {
    auto& there = mesh.sides["other " + name] = side;
    for (Index& n : there.nodes) n += first;
    for (auto& facet : there.facets)
      for (Index& n : facet) n += first;
  }
  // Pins at two ends of an edge along x; a third one beside it.
  for (Index n = first; n < mesh.node_count(); ++n) {
    const V3& X = mesh.nodes[std::size_t(n)];
    if (X[1] == 1 && X[2] == 0 && X[0] != 5.5) mesh.sides["edge"].nodes.push_back(n);
    if (X == V3(5, 2, 0)) mesh.sides["beside"].nodes = {n};
  }
  REQUIRE(mesh.side("edge").nodes.size() == 2);
  const auto outcome = [&](auto prepare) {
    Problem<Brick<Hencky>> p({.body = mesh, .material = material<Hencky>()});
    for (const Index i : {0, 1, 2}) p.hold("bottom", i);
    p.load("other left", 2, [](Real t) { return 10 * t; }).load("other right", 2, [](Real t) { return -10 * t; });
    prepare(p);
    auto march = p.march({.end = 1, .steps = 2});
    (void)march.finish();
    if (!march.outcome()) CHECK(p.displacement().isZero(0));
    return march.outcome();
  };
  // It is called by the first of its sides.
  const auto names = [](const Outcome& o) {
    return o.failure.cause == FailureCause::unsupported &&
           o.message().find("the part of the mesh with side \"beside\"") != std::string::npos;
  };
  const auto pin = [](auto& p) { p.hold("edge", 0).hold("edge", 1).hold("edge", 2); };
  CHECK(names(outcome([](auto&) {})));
  CHECK(names(outcome([](auto& p) { p.hold("other top", 0).hold("other top", 1); })));
  CHECK(names(outcome(pin)));  // it may turn about the edge
  CHECK(bool(outcome([&](auto& p) {
    pin(p);
    p.hold("beside", 2);
  })));
}

TEST_CASE("a free body in space keeps its momentum") {
  Problem<Moving> p({.body = distorted_cube({2, 2, 2}), .material = material<Hencky>(), .density = 3});
  p.start_velocity(V3(1, -2, 0.5));
  auto march = p.march({.end = 0.3, .steps = 3, .tolerance = 1e-10});
  CHECK(bool(march.finish()));
  for (Index n = 0; n < p.body().mesh().node_count(); ++n)
    CHECK((p.displacement(n) - 0.3 * V3(1, -2, 0.5)).norm() < 1e-9);
}

TEST_CASE("a VTU file of hexahedra has VTK's cell type 12 and vectors of three components") {
  Problem<Brick<FiniteJ2<LinearHardening>>> p(
      {.body = mesh::box({.cells = {1, 1, 2}}), .material = material<FiniteJ2<LinearHardening>>()});
  p.hold("left", 0).hold("bottom", 1).hold("back", 2).drive("front", 2, [](Real t) { return 0.1 * t; });
  auto march = p.march({.end = 1, .steps = 2});
  CHECK(bool(march.finish()));
  const auto path = std::filesystem::temp_directory_path() / "stickslip_three_dimensional.vtu";
  io::write_vtu(path, p);
  std::ifstream in(path);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  const auto array = [&](const std::string& name) {
    const auto begin = text.find(">", text.find("Name=\"" + name + "\"")) + 1;
    return text.substr(begin, text.find("</DataArray>", begin) - begin);
  };
  const std::vector<unsigned char> types{2, 0, 0, 0, 0, 0, 0, 0, 12, 12};
  CHECK(array("types") == io::detail::base64(types));
  CHECK(text.find("NumberOfPoints=\"12\" NumberOfCells=\"2\"") != std::string::npos);
  std::vector<Real> field(36);
  for (std::size_t k = 0; k < 36; ++k) field[k] = p.displacement()[Index(k)];
  std::vector<unsigned char> bytes(8 + 36 * sizeof(Real));
  const std::uint64_t count = 36 * sizeof(Real);
  std::memcpy(bytes.data(), &count, 8);
  std::memcpy(bytes.data() + 8, field.data(), count);
  CHECK(array("displacement") == io::detail::base64(bytes));
  CHECK(array("cauchy_stress").size() == (8 + 2 * 6 * sizeof(Real) + 2) / 3 * 4);
}

}  // namespace three_dimensional
