// SPDX-License-Identifier: BSL-1.0
#include "element_check.hpp"

#include <stickslip/material/hencky.hpp>

namespace element_hencky {

using namespace element_check;
const Hencky material{.young = 200e3, .poisson = 0.3};

TEST_CASE("quadrilaterals of Hencky's law have exact tangents") {
  check_all(material, {{displacement(1)}, {displacement(1.3)}, {displacement(-0.4)}});
}

template <class Element, class Kinematics>
void check_energy() {
  // The forces are the gradient of the sum of W(F_bar) over the points: the element has a potential.
  const verify::SingleElement<Element, Kinematics, Hencky> element{.material = material, .X = distorted()};
  const U u = displacement(1);
  const Vec<Dual<8>, 8> dual_u = verify::seeded<8>(u);
  const auto F =
      element.template deformation<Dual<8>>(dual_u);
  Dual<8> energy(0);
  const auto geometry = element.geometry();
  for (std::size_t p = 0; p < 4; ++p) energy += material.energy(F[p], {}) * geometry[p].weight;
  const U slope = energy.slope.matrix();
  CHECK(verify::relative_error(element.template at<Real>(u, {}).residual, slope) < 1e-12);
}
TEST_CASE("quadrilateral forces derive from the stored energy") {
  check_energy<MeanDilatation<Quad4>, PlaneStrain>();
  check_energy<MeanDilatation<Quad4>, Axisymmetric>();
  check_energy<FullyIntegrated<Quad4>, PlaneStrain>();
  check_energy<FullyIntegrated<Quad4>, Axisymmetric>();
}

TEST_CASE("a quadrilateral of mean dilatation has one dilatation, a fully integrated one several") {
  const auto spread = [](auto tag) {
    using Element = decltype(tag);
    const verify::SingleElement<Element, PlaneStrain, Hencky> element{.material = material, .X = distorted()};
    const auto F =
        element.template deformation<Real>(displacement(1));
    Real low = 1e300, high = -1e300;
    for (const auto& f : F) {
      low = std::min(low, determinant(f));
      high = std::max(high, determinant(f));
    }
    return high - low;
  };
  CHECK(spread(MeanDilatation<Quad4>{}) < 1e-14);
  CHECK(spread(FullyIntegrated<Quad4>{}) > 0.1);
}

TEST_CASE("an inverted quadrilateral fails as element_inverted") {
  const verify::SingleElement<MeanDilatation<Quad4>, PlaneStrain, Hencky> mean{.material = material, .X = distorted()};
  const verify::SingleElement<FullyIntegrated<Quad4>, PlaneStrain, Hencky> plain{.material = material,
                                                                                 .X = distorted()};
  U u = U::Zero();
  u[4] = -3;
  CHECK(std::isnan(mean.at<Real>(u, {}).residual[0]));
  CHECK(std::isnan(plain.at<Real>(u, {}).residual[0]));
}

// A material whose tangent has no symmetry: the elements must not mirror it.
struct Skewed : Hencky {
  static constexpr Symmetry symmetry = Symmetry::general;
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old,
                                                                      Real dt) const {
    auto out = Hencky::respond(F, old, dt);
    // A follower-like stress that derives from no energy: P_11 += c F_22^2.
    out.P(0, 0) += S(young * 0.1) * F(1, 1) * F(1, 1);
    out.dP_dF(0, 3) += S(young * 0.2) * F(1, 1);
    return out;
  }
};
TEST_CASE("quadrilaterals carry the tangent of a non-symmetric material") {
  const auto check_general = [](auto element) {
    const auto r = verify::element_tangent(element, {displacement(1)}, 1, 2e-5);
    CHECK(r.by_duals < 1e-11);
    CHECK(r.by_differences < 1e-8);
    CHECK(r.asymmetry > 1e-3);
  };
  check_general(
      verify::SingleElement<MeanDilatation<Quad4>, PlaneStrain, Skewed>{.material = {{material}}, .X = distorted()});
  check_general(
      verify::SingleElement<MeanDilatation<Quad4>, Axisymmetric, Skewed>{.material = {{material}}, .X = distorted()});
  check_general(
      verify::SingleElement<FullyIntegrated<Quad4>, Axisymmetric, Skewed>{.material = {{material}}, .X = distorted()});
}

}  // namespace element_hencky
