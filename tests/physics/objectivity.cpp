// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/verify/element.hpp>
#include <stickslip/verify/material.hpp>

#include <doctest/doctest.h>

namespace objectivity {

using namespace scene;

TEST_CASE_TEMPLATE("a superposed rotation rotates the stress of every material", M, Hencky, FiniteJ2<LinearHardening>,
                   FiniteJ2<PowerHardening>, HypoelasticJ2<PowerHardening>) {
  Tensor<Real, Planar> F, G;
  F.v << 1.1, 0.2, -0.1, 0.95, 1.02;
  G.v << 1.5, 0.3, 0.2, 0.8, 0.9;
  for (const Real angle : {1e-3, 0.7, pi / 2, 2.9, -1.3}) {
    CHECK(verify::material_objectivity<Planar>(material<M>(), {F}, angle) < 1e-11);
    CHECK(verify::material_objectivity<Planar>(material<M>(), {F, G}, angle) < 1e-11);
  }
}

template <class E>
void check_element() {
  Mat<Real, 4, 2> X;
  X << 1.0, 0.1, 2.3, -0.2, 2.0, 1.4, 0.8, 0.9;
  Vec<Real, 8> u;
  u << 0.05, -0.02, 0.35, 0.10, 0.20, -0.25, -0.10, 0.15;
  const verify::SingleElement<E, PlaneStrain, FiniteJ2<PowerHardening>> element{
      .material = material<FiniteJ2<PowerHardening>>(), .X = X};
  for (const Real angle : {0.7, pi / 2, 2.9})
    CHECK(verify::element_objectivity(element, {Vec<Real, 8>(0.3 * u), u}, angle) < 1e-11);
}
TEST_CASE("a superposed rotation rotates the nodal forces of every element") {
  check_element<MeanDilatation<Quad4>>();
  check_element<FullyIntegrated<Quad4>>();
}

TEST_CASE("contact forces of a body and tool that rotate together only rotate") {
  using M = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>>;
  const Real turn = 2.3;
  const V centre(3, -1);
  const auto pose = [&](Real t) { return t <= 1 ? rigid::turned(0, centre) : rigid::turned(turn, centre); };
  Bodies<M> body(mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}), {}, material<FiniteJ2<LinearHardening>>());
  ContactPairs<M> pairs;
  pairs.emplace_back(Contact<M>{.side = "bottom",
                                .tool = rigid::disc({1, -3}, 3),
                                .motion = pose,
                                .friction = {.mu = 0.3},
                                .enforcement = {.normal = 1e4, .tangential = 1e3}},
                     body);
  typename System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {}, {});
  Field u = Field::Zero(system.dofs().components());
  pairs.front().start(u, 0);
  // Into the tool, then along it: some nodes slide, some stick.
  for (Index n = 0; n < body.mesh().node_count(); ++n) u[2 * n + 1] = -0.05;
  CHECK_FALSE(bool(system.evaluate(u, 1, 1)));
  system.commit();
  const auto pressed = pairs.front().states();
  for (Index n = 0; n < body.mesh().node_count(); ++n) u[2 * n] += 0.004;
  CHECK_FALSE(bool(system.evaluate(u, 1, 1)));
  system.commit();
  CHECK_FALSE(bool(system.evaluate(u, 1, 1)));  // once more in place, so that the lagging bound has caught up
  system.commit();
  const auto before = pairs.front().states();
  const Field forces = system.forces().residual;
  CHECK(contact_summary(system.pairs()).touching >= 3);
  Field turned = u;
  const auto turning = pose(2);
  for (Index n = 0; n < body.mesh().node_count(); ++n) {
    const V X = body.mesh().nodes[std::size_t(n)];
    turned.segment<2>(2 * n) = turning.rotation * (X + u.segment<2>(2 * n)) + turning.translation - X;
  }
  CHECK_FALSE(bool(system.evaluate(turned, 2, 1)));
  CHECK(contact_summary(system.pairs()).dissipated < 1e-12);
  system.commit();
  const auto& after = pairs.front().states();
  Real friction = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    CHECK(after[k].touching == before[k].touching);
    CHECK((after[k].force - turning.rotation * before[k].force).norm() < 1e-9);
    CHECK(std::abs(after[k].accumulated_slip - before[k].accumulated_slip) < 1e-12);
    friction = std::max(friction, std::abs(before[k].force[0]));
  }
  CHECK(friction > 1);  // there was friction to be kept
  // The bound is that of the pressures of the first commit: the law saw them without a march around the system.
  Real slid = 0;
  for (std::size_t k = 0; k < before.size(); ++k)
    slid = std::max(slid, before[k].accumulated_slip - pressed[k].accumulated_slip);
  CHECK(slid < 0.004);
  Field expected = forces;
  for (Index n = 0; n < body.mesh().node_count(); ++n)
    expected.segment<2>(2 * n) = turning.rotation * forces.segment<2>(2 * n);
  CHECK((system.forces().residual - expected).norm() < 1e-10 * expected.norm());
}

TEST_CASE("contact forces of a body and tool that rotate together about a skew axis only rotate") {
  using M = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>, ThreeDimensional, MeanDilatation<Hex8>>;
  using W = Vec<Real, 3>;
  rigid::Pose<3> turning;
  const auto R = verify::rotation<Spatial>(2.3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) turning.rotation(i, j) = R(i, j);
  turning.translation = W(3, -1, 2);
  Bodies<M> body(mesh::box({.size = {2, 1, 1}, .cells = {4, 2, 2}}), {}, material<FiniteJ2<LinearHardening>>());
  ContactPairs<M> pairs;
  pairs.emplace_back(Contact<M>{.side = "back",  // z = 0
                                .tool = rigid::sphere({1, 0.5, -3}, 3),
                                .motion = [&](Real t) { return t <= 1 ? rigid::Pose<3>{} : turning; },
                                .friction = {.mu = 0.3},
                                .enforcement = {.normal = 1e4, .tangential = 1e3}},
                     body);
  typename System<M>::Inertia inertia{};
  System<M> system(body, pairs, inertia, {}, {});
  Field u = Field::Zero(system.dofs().components());
  pairs.front().start(u, 0);
  for (Index n = 0; n < body.mesh().node_count(); ++n) u[3 * n + 2] = -0.1;
  CHECK_FALSE(bool(system.evaluate(u, 1, 1)));
  system.commit();
  for (Index n = 0; n < body.mesh().node_count(); ++n) u.segment<3>(3 * n) += W(0.004, 0.002, 0);
  CHECK_FALSE(bool(system.evaluate(u, 1, 1)));
  system.commit();
  CHECK_FALSE(bool(system.evaluate(u, 1, 1)));  // once more in place, so that the lagging bound has caught up
  system.commit();
  const auto before = pairs.front().states();
  CHECK(contact_summary(system.pairs()).touching >= 3);
  Field turned = u;
  for (Index n = 0; n < body.mesh().node_count(); ++n) {
    const W X = body.mesh().nodes[std::size_t(n)];
    turned.segment<3>(3 * n) = turning.rotation * (X + u.segment<3>(3 * n)) + turning.translation - X;
  }
  CHECK_FALSE(bool(system.evaluate(turned, 2, 1)));
  system.commit();
  const auto& after = pairs.front().states();
  Real friction = 0;
  for (std::size_t k = 0; k < after.size(); ++k) {
    CHECK(after[k].touching == before[k].touching);
    CHECK((after[k].force - turning.rotation * before[k].force).norm() < 1e-9);
    CHECK(std::abs(after[k].accumulated_slip - before[k].accumulated_slip) < 1e-12);
    friction = std::max(friction, std::hypot(before[k].force[0], before[k].force[1]));
  }
  CHECK(friction > 1);
}

}  // namespace objectivity
