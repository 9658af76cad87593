// SPDX-License-Identifier: BSL-1.0
#include "element_check.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>

#include <doctest/doctest.h>

namespace element_hex8 {

using namespace stickslip;
using U = Vec<Real, 24>;
using Path = std::vector<U>;
using Mean = MeanDilatation<Hex8>;
using Plain = FullyIntegrated<Hex8>;
template <class Element, class Material>
using Lone = verify::SingleElement<Element, ThreeDimensional, Material>;

const Hencky hencky{.young = 200e3, .poisson = 0.3};
const FiniteJ2<PowerHardening> power{
    .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};

// A brick with uneven corners; no two faces are parallel.
Mat<Real, 8, 3> distorted() {
  Mat<Real, 8, 3> X;
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i)
      X(a, i) = 0.6 * Hex8::corner[std::size_t(a)][std::size_t(i)] + 0.1 * std::sin(5.0 * a + 2 * i);
  return X;
}
U displacement(Real scale) {
  U u;
  for (int k = 0; k < 24; ++k) u[k] = 0.15 * std::cos(2.7 * k + 0.3);
  return scale * u;
}

template <class Element, class Material>
void check(const Material& material, const Path& path) {
  const Lone<Element, Material> element{.material = material, .X = distorted()};
  element_check::check_tangent(element, path);
  for (const Real angle : {0.7, pi / 2, 2.9}) CHECK(verify::element_objectivity(element, path, angle) < 1e-11);
}

TEST_CASE_TEMPLATE("a hexahedron of Hencky's law has an exact tangent and is objective", Element, Mean, Plain) {
  for (const Real scale : {1.0, -0.4}) check<Element>(hencky, {displacement(scale)});
}

TEST_CASE_TEMPLATE("a hexahedron in plastic flow has an exact tangent and is objective", Element, Mean, Plain) {
  const Path path{displacement(0.2), displacement(-0.3), displacement(0.9)};
  const Lone<Element, FiniteJ2<PowerHardening>> element{.material = power, .X = distorted()};
  const auto old = element.template preloaded<Real>(path);
  const auto now = element.template at<Real>(path.back(), old).states;
  for (std::size_t p = 0; p < now.size(); ++p) CHECK(now[p].plastic_strain > old[p].plastic_strain);
  check<Element>(power, path);
}

TEST_CASE_TEMPLATE("hexahedron forces derive from the stored energy", Element, Mean, Plain) {
  const Lone<Element, Hencky> element{.material = hencky, .X = distorted()};
  const U u = displacement(1);
  const Vec<Dual<24>, 24> dual_u = verify::seeded<24>(u);
  const auto F = element.template deformation<Dual<24>>(dual_u);
  const auto geometry = element.geometry();
  Dual<24> energy(0);
  for (std::size_t p = 0; p < 8; ++p) energy += hencky.energy(F[p], {}) * geometry[p].weight;
  const U slope = energy.slope.matrix();
  CHECK(verify::relative_error(element.template at<Real>(u, {}).residual, slope) < 1e-12);
}

TEST_CASE("a hexahedron of mean dilatation has one dilatation, a fully integrated one several") {
  const auto spread = [](auto tag) {
    using Element = decltype(tag);
    const Lone<Element, Hencky> element{.material = hencky, .X = distorted()};
    const auto F = element.template deformation<Real>(displacement(1));
    Real low = 1e300, high = -1e300;
    for (const auto& f : F) {
      low = std::min(low, determinant(f));
      high = std::max(high, determinant(f));
    }
    return high - low;
  };
  CHECK(spread(Mean{}) < 1e-14);
  CHECK(spread(Plain{}) > 0.1);
}

TEST_CASE_TEMPLATE("an inverted hexahedron fails as element_inverted", Element, Mean, Plain) {
  const Lone<Element, Hencky> element{.material = hencky, .X = distorted()};
  U u = U::Zero();
  u[18] = -3;
  CHECK(std::isnan(element.template at<Real>(u, {}).residual[0]));
}

}  // namespace element_hex8
