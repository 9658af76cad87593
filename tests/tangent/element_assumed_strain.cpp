// SPDX-License-Identifier: BSL-1.0
#include "assumed_strain_check.hpp"

namespace element_assumed_strain {

using namespace assumed_strain_check;
using element_check::displacement;
using element_check::distorted;
using U = Vec<Real, 8>;
using Path = std::vector<U>;
using Quad = AssumedStrain<Quad4>;

const Path large{displacement(1)}, back_and_forth{displacement(0.2), displacement(-0.3), displacement(0.9)};
template <class Kinematics, class Material>
auto quad(const Material& material, const Path& path) {
  return at<Quad, Kinematics>(material, distorted(), path);
}

template <class A>
void check_numberings(const A& a) {
  for (int turn = 0; turn < 4; ++turn)
    check_numbering(a, std::array{turn, (turn + 1) % 4, (turn + 2) % 4, (turn + 3) % 4});
}

TEST_CASE_TEMPLATE("a quadrilateral that bends has exact tangents, its condensed unknowns closed or open", Kinematics,
                   PlaneStrain, Axisymmetric) {
  SUBCASE("Hencky") {
    for (const Real scale : {1.0, 1.3, -0.4}) check(quad<Kinematics>(hencky, {displacement(scale)}));
    check_energy(quad<Kinematics>(hencky, large));
    check_numberings(quad<Kinematics>(hencky, large));
  }
  SUBCASE("J2") {
    for (const Path& path : {large, back_and_forth}) {
      const auto a = quad<Kinematics>(power, path);
      CHECK(all_flow(a));
      check(a);
      check_numberings(a);
    }
  }
  SUBCASE("hypoelastic J2") {
    const auto a = quad<Kinematics>(hypoelastic, back_and_forth);
    CHECK(all_flow(a));
    check(a);
  }
  SUBCASE("a material whose tangent is not symmetric") {
    const auto a = quad<Kinematics>(skewed, large);
    CHECK(verify::asymmetry(a.answer().tangent) > 1e-3);
    check(a);
    check_numberings(a);
  }
}

TEST_CASE("a quadrilateral that bends is objective") {
  for (const Path& path : {large, back_and_forth})
    for (const Real angle : {0.7, pi / 2, 2.9})
      CHECK(verify::element_objectivity(quad<PlaneStrain>(power, path).element, path, angle) < 1e-12);
}

TEST_CASE("an unstressed quadrilateral that bends has no modes without energy but rigid ones") {
  CHECK(rank_at_rest(quad<PlaneStrain>(hencky, large)) == 5);
  CHECK(rank_at_rest(quad<Axisymmetric>(hencky, large)) == 7);
}

TEST_CASE_TEMPLATE("an inverted quadrilateral that bends fails as element_inverted", Kinematics, PlaneStrain,
                   Axisymmetric) {
  const auto a = quad<Kinematics>(hencky, large);
  U turned = U::Zero(), torn;
  for (int k = 0; k < 4; ++k) turned[2 * k] = -2.2 * a.element.X(k, 0);
  torn << 3, 0, -3, 0, 3, 0, -3, 0;
  check_inverted(a, turned, torn);
}

}  // namespace element_assumed_strain
