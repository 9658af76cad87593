// SPDX-License-Identifier: BSL-1.0
#include "assumed_strain_check.hpp"
#include "brick.hpp"

#include <stickslip/kinematics/three_dimensional.hpp>

#include <algorithm>
#include <bit>

namespace element_assumed_strain_space {

using namespace assumed_strain_check;
using element_check::brick::displacement;
using element_check::brick::distorted;
using U = Vec<Real, 24>;
using Path = std::vector<U>;
using Brick = AssumedStrain<Hex8>;

const Path large{displacement(1)}, back_and_forth{displacement(0.2), displacement(-0.3), displacement(0.9)};
template <class Material>
auto brick(const Material& material, const Path& path) {
  return at<Brick, ThreeDimensional>(material, distorted(), path);
}

// The numberings of a hexahedron that keep its orientation, from the rotations of a cube.
std::vector<std::array<int, 8>> numberings() {
  std::vector<std::array<int, 8>> all;
  std::array<int, 3> axis{0, 1, 2};
  do {
    const bool even = (axis[0] + 1) % 3 == axis[1];
    for (int signs = 0; signs < 8; ++signs) {
      const bool turned_over = std::popcount(unsigned(signs)) % 2 == 1;
      if (even == turned_over) continue;
      std::array<int, 8> now{};
      for (std::size_t a = 0; a < 8; ++a) {
        std::array<Real, 3> image{};
        for (std::size_t i = 0; i < 3; ++i)
          image[i] = (signs >> i & 1 ? -1 : 1) * Hex8::corner[a][std::size_t(axis[i])];
        now[a] = int(std::find(Hex8::corner.begin(), Hex8::corner.end(), image) - Hex8::corner.begin());
      }
      all.push_back(now);
    }
  } while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}

TEST_CASE("a hexahedron of Hencky's law that bends has exact tangents and a potential") {
  for (const Real scale : {1.0, -0.4}) check(brick(hencky, {displacement(scale)}));
  check_energy(brick(hencky, large));
}

TEST_CASE("a hexahedron in plastic flow that bends has exact tangents") {
  const auto a = brick(power, back_and_forth);
  CHECK(all_flow(a));
  check(a);
}

TEST_CASE("a hexahedron of hypoelastic J2 that bends has exact tangents, which are not symmetric") {
  const auto plastic = brick(hypoelastic, back_and_forth);
  CHECK(all_flow(plastic));
  check(plastic);
  auto hard = hypoelastic;
  hard.hardening.yield = 1e6;
  const auto elastic = brick(hard, back_and_forth);
  CHECK(verify::asymmetry(elastic.answer().tangent) > 1e-4);
  check(elastic);
  check_numbering(elastic, std::array{3, 0, 1, 2, 7, 4, 5, 6});
}

TEST_CASE("a hexahedron that bends does not depend on the numbering of its nodes") {
  const auto all = numberings();
  CHECK(all.size() == 24);
  for (const auto& now : all) {
    check_numbering(brick(hencky, large), now);
    check_numbering(brick(power, back_and_forth), now);
    check_numbering(brick(hypoelastic, back_and_forth), now);
  }
}

TEST_CASE("a hexahedron that bends is objective") {
  for (const Path& path : {large, back_and_forth})
    for (const Real angle : {0.7, pi / 2, 2.9})
      CHECK(verify::element_objectivity(brick(power, path).element, path, angle) < 1e-12);
}

TEST_CASE("an unstressed hexahedron that bends has no modes without energy but rigid ones") {
  CHECK(rank_at_rest(brick(hencky, large)) == 18);
}

TEST_CASE("an inverted hexahedron that bends fails as element_inverted") {
  const auto a = brick(hencky, large);
  U turned = U::Zero(), torn = U::Zero();
  for (int k = 0; k < 8; ++k) {
    const auto& c = Hex8::corner[std::size_t(k)];
    turned[3 * k] = -2.2 * a.element.X(k, 0);
    torn[3 * k] = 1.5 * c[0] * c[1];
  }
  check_inverted(a, turned, torn);
}

}  // namespace element_assumed_strain_space
