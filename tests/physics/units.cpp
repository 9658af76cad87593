// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>

#include <doctest/doctest.h>

namespace units {

using namespace scene;

struct Result {
  Field u;
  V force;
  Index steps, iterations, rejected;
  Real plastic, accumulated_slip;
};

// One problem in a unit of length that is `length` mm and of force that is `force` N.
template <class K>
Result run(Real length, Real force) {
  using M = Model<EigenLdlt, QuasiCoulomb, FiniteJ2<PowerHardening>, K>;
  const Real stress = force / (length * length), l = 1 / length;
  typename Problem<M>::Parameters parameters{
      .body = mesh::rectangle({.origin = V(0, 0), .size = V(10 * l, 5 * l), .cells = {8, 4}}),
      .material = {.young = 69004 / stress,
                   .poisson = 0.3,
                   .hardening = {.strength = 589 / stress, .offset = 1e-4, .exponent = 0.216}},
      .contacts = {{.side = "top",
                    .tool = rigid::rounded({V(9 * l, 9 * l), V(4 * l, 5 * l), V(-8 * l, 5 * l)}, 2 * l),
                    .motion = [l](Real t) { return V(0.5 * l * t, -1.5 * l * t); },
                    .friction = {.mu = 0.2},
                    // Newton per mm of penetration and per mm of depth, or per radian.
                    .enforcement = {.normal = 1e5 / force * length * (K::hoop ? 1 : length),
                                    .tangential = 1e4 / force * length * (K::hoop ? 1 : length)},
                    .name = "punch"}}};
  if constexpr (!K::hoop) parameters.kinematics.thickness = l;
  Problem<M> p(parameters);
  p.hold("left", 0).hold("bottom", 1);
  auto march = p.march({.end = 1, .initial = 0.05});
  CHECK(bool(march.finish()));
  const auto& r = march.report();
  return {p.displacement() * length,
          p.contact_force("punch") * force,
          r.steps,
          r.iterations,
          r.rejected_steps,
          p.max_plastic_strain(),
          r.max_slip * length};
}
template <class K>
void check(Real length, Real force) {
  const Result mm = run<K>(1, 1), other = run<K>(length, force);
  CHECK(mm.steps == other.steps);
  CHECK(mm.iterations == other.iterations);
  CHECK(mm.rejected == other.rejected);
  CHECK(mm.plastic > 0.05);
  CHECK((mm.u - other.u).norm() < 1e-9 * mm.u.norm());
  CHECK((mm.force - other.force).norm() < 1e-9 * mm.force.norm());
  CHECK(std::abs(mm.plastic - other.plastic) < 1e-9 * mm.plastic);
  CHECK(std::abs(mm.accumulated_slip - other.accumulated_slip) < 1e-9 * mm.accumulated_slip);
}
TEST_CASE("N and mm, N and m, MN and um give the same answer") {
  check<PlaneStrain>(1000, 1);
  check<PlaneStrain>(1e-3, 1e6);
  check<Axisymmetric>(1000, 1);
}

}  // namespace units
