// SPDX-License-Identifier: BSL-1.0
#include "affine_check.hpp"
#include "patch_check.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>

#include <doctest/doctest.h>

namespace patch {

using namespace scene;

template <class M>
void check_body(const Mat<Real, 2>& H, Index steps) {
  auto mesh = distorted(mesh::rectangle({.cells = {4, 3}}));
  for (auto& x : mesh.nodes) x += V(0.5, 0);
  check_patch<M>(mesh, {"left", "right", "bottom", "top"}, H, steps, 6);
}

Mat<Real, 2> plane() {
  Mat<Real, 2> H;
  H << 0.15, 0.1, -0.05, -0.1;
  return H;
}
Mat<Real, 2> turned() {  // u_r = a r, u_z = b z is homogeneous about an axis
  Mat<Real, 2> H;
  H << 0.12, 0, 0, -0.15;
  return H;
}
using Plain = FullyIntegrated<Quad4>;
using Mean = MeanDilatation<Quad4>;
using Bends = AssumedStrain<Quad4>;

TEST_CASE("plane and axisymmetric Hencky elements pass the patch test") {
  check_body<Lone<EigenLdlt, Hencky, PlaneStrain, Mean>>(plane(), 4);
  check_body<Lone<EigenLdlt, Hencky, PlaneStrain, Plain>>(plane(), 4);
  check_body<Lone<EigenLdlt, Hencky, Axisymmetric, Mean>>(turned(), 4);
  check_body<Lone<EigenLdlt, Hencky, Axisymmetric, Plain>>(turned(), 4);
  check_body<Lone<EigenLdlt, Hencky, PlaneStrain, Bends>>(plane(), 4);
  check_body<Lone<EigenLdlt, Hencky, Axisymmetric, Bends>>(turned(), 4);
}
TEST_CASE("plane and axisymmetric plastic elements pass the patch test") {
  check_body<Lone<EigenLdlt, FiniteJ2<PowerHardening>, PlaneStrain, Mean>>(plane(), 8);
  check_body<Lone<EigenLdlt, FiniteJ2<PowerHardening>, Axisymmetric, Mean>>(turned(), 8);
  check_body<Lone<EigenLdlt, FiniteJ2<PowerHardening>, PlaneStrain, Bends>>(plane(), 8);
  check_body<Lone<EigenLdlt, FiniteJ2<PowerHardening>, Axisymmetric, Bends>>(turned(), 8);
}

TEST_CASE_TEMPLATE("under affine motion all quadrilaterals have the same nodal forces", Material, Hencky,
                   FiniteJ2<PowerHardening>) {
  Mat<Real, 4, 2> X;
  X << 1.0, 0.1, 2.3, -0.2, 2.0, 1.4, 0.8, 0.9;
  check_affine<Plain, Mean, PlaneStrain>(material<Material>(), X, plane());
  check_affine<Plain, Bends, PlaneStrain>(material<Material>(), X, plane());
  check_affine<Plain, Mean, Axisymmetric>(material<Material>(), X, turned());
  check_affine<Plain, Bends, Axisymmetric>(material<Material>(), X, turned());
}

// A block with nodes at uneven distances, pressed by a flat tool: spread of the nodal pressures.
template <class M>
Real pressure_spread(PenaltyPer per) {
  auto mesh = distorted(mesh::rectangle({.cells = {5, 4}}));
  for (auto& x : mesh.nodes) x += V(0.5, 0);
  Problem<M> p({.body = mesh,
                .material = material<Hencky>(),
                .contacts = {{.side = "top",
                              .tool = rigid::line({0, 1}, {-1, 0}),
                              .motion = [](Real t) { return V(0, -0.02 * t); },
                              .enforcement = {.normal = 1e6, .tangential = 0, .per = per}}}});
  p.hold("bottom", 1);
  if constexpr (!M::Kinematics::hoop) p.hold("left", 0);
  auto march = p.march({.end = 1, .steps = 2, .tolerance = 1e-11});
  CHECK(bool(march.finish()));
  const auto& pair = p.contact("top");
  Real low = 1e300, high = -1e300;
  for (std::size_t k = 0; k < pair.nodes().size(); ++k) {
    CHECK(pair.states()[k].touching);
    Real share = 0;
    for (const auto& facet : mesh.side("top").facets)
      share += tributary_area(mesh, p.body().kinematics(), facet, pair.nodes()[k]);
    const Real pressure = pair.states()[k].force[1] / share;
    low = std::min(low, pressure);
    high = std::max(high, pressure);
  }
  CHECK(low > 100);
  // Force on the tool, supports and pressure balance.
  CHECK(p.reaction("bottom", 1) == doctest::Approx(p.contact_force("top")[1]).epsilon(1e-10));
  return (high - low) / high;
}
TEST_CASE("in the contact patch test a stiffness per area gives a uniform pressure, one per node does not") {
  CHECK(pressure_spread<Model<EigenLdlt>>(PenaltyPer::area) < 1e-9);
  CHECK(pressure_spread<Model<EigenLdlt, Frictionless, Hencky, Axisymmetric>>(PenaltyPer::area) < 1e-9);
  CHECK(pressure_spread<Model<EigenLdlt>>(PenaltyPer::node) > 1e-2);
}

TEST_CASE("the penalty force is stiffness times tributary measure times penetration in every unit") {
  // A node in the middle of a side, alone against the edge of a narrow tool: force = stiffness x measure x penetration.
  const auto force = [](auto tag, PenaltyPer per, Real thickness) {
    using M = decltype(tag);
    typename Problem<M>::Parameters parameters{
        .body = mesh::rectangle({.origin = {1, 0}, .size = {2, 1}, .cells = {2, 1}}),
        .material = material<Hencky>(),
        .contacts = {{.side = "top",
                      .tool = rigid::path({2.1, 1}, {-1, 0}).straight(0.2),
                      .motion = [](Real t) { return V(0, -1e-3 * t); },
                      .enforcement = {.normal = 10, .per = per}}}};
    if constexpr (!M::Kinematics::hoop) parameters.kinematics.thickness = thickness;
    Problem<M> p(parameters);
    p.hold("bottom", 0).hold("bottom", 1).hold("top", 0).hold("top", 1);
    auto march = p.march({.end = 1, .steps = 1});
    CHECK(bool(march.finish()));
    return p.contact_force("top")[1] / (10 * 1e-3);
  };
  using Plane = Model<EigenLdlt>;
  using Turned = Model<EigenLdlt, Frictionless, Hencky, Axisymmetric>;
  CHECK(force(Plane{}, PenaltyPer::node, 3) == doctest::Approx(1).epsilon(1e-10));
  CHECK(force(Plane{}, PenaltyPer::unit_depth, 3) == doctest::Approx(3).epsilon(1e-10));
  CHECK(force(Plane{}, PenaltyPer::area, 3) == doctest::Approx(3 * 1).epsilon(1e-10));
  CHECK(force(Turned{}, PenaltyPer::node, 1) == doctest::Approx(1).epsilon(1e-10));
  CHECK(force(Turned{}, PenaltyPer::unit_depth, 1) == doctest::Approx(2 * pi).epsilon(1e-10));
  CHECK(force(Turned{}, PenaltyPer::area, 1) == doctest::Approx(2 * pi * 2).epsilon(1e-10));
}

}  // namespace patch
