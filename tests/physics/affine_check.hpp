// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <stickslip/verify/element.hpp>

#include <doctest/doctest.h>

namespace scene {

/// Under affine motions u = H X, one after the other, an element has the nodal forces of the plain one.
template <class Plain, class Element, class Kinematics, class Material>
void check_affine(const Material& material, const Mat<Real, Element::nodes, Element::dim>& X,
                  const Mat<Real, Element::dim>& H) {
  constexpr int dim = Element::dim, n = Element::nodes * dim;
  std::vector<Vec<Real, n>> path;
  for (const Real share : {0.1, -0.2, 1.0}) {
    path.emplace_back();
    for (int a = 0; a < Element::nodes; ++a)
      path.back().template segment<dim>(dim * a) = share * H * X.row(a).transpose();
  }
  const auto answer = [&](auto tag) {
    const verify::SingleElement<typename decltype(tag)::type, Kinematics, Material> element{.material = material,
                                                                                            .X = X};
    return element.template at<Real>(path.back(), element.template preloaded<Real>(path));
  };
  const auto plain = answer(std::type_identity<Plain>{}), other = answer(std::type_identity<Element>{});
  CHECK(plain.residual.norm() > 1);
  CHECK(verify::relative_error(other.residual, plain.residual) < 1e-14);
  if constexpr (requires { plain.states[0].plastic_strain; })
    for (std::size_t p = 0; p < plain.states.size(); ++p) {
      CHECK(plain.states[p].plastic_strain > 0.01);
      CHECK(std::abs(other.states[p].plastic_strain - plain.states[p].plastic_strain) < 1e-14);
    }
}

}  // namespace scene
