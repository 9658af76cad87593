// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/verify/element.hpp>

#include <doctest/doctest.h>

namespace element_check {

using namespace stickslip;
using U = Vec<Real, 8>;

inline Mat<Real, 4, 2> distorted() {
  Mat<Real, 4, 2> X;
  X << 1.0, 0.1, 2.3, -0.2, 2.0, 1.4, 0.8, 0.9;
  return X;
}
inline U displacement(Real scale) {
  U u;
  u << 0.05, -0.02, 0.55, 0.10, 0.20, -0.35, -0.10, 0.25;
  return scale * u;
}

/// Tangents of one element, elastic (small and large) and plastic after plastic preloads, at the end of a path.
template <class Element, class Kinematics, class Material>
void check_tangent(const verify::SingleElement<Element, Kinematics, Material>& element,
                   const std::vector<Vec<Real, Element::nodes * Element::dim>>& path) {
  constexpr int n = Element::nodes * Element::dim;
  const auto r = verify::element_tangent(element, path, 1, 2e-5);
  CHECK(r.by_duals < 1e-11);
  CHECK(r.by_differences < 1e-8);
  if constexpr (Material::symmetry == Symmetry::symmetric) CHECK(r.asymmetry == 0);
  if constexpr (condensed_unknowns<Element> == 1) {
    const auto old = element.template preloaded<Real>(path);
    const Real settled = element.open(path.back(), old, 0).relation.residual;
    CHECK(element.closed(path.back(), old) == settled);
    CHECK(element.open(path.back(), old, settled).relation.residual == 0);
    CHECK(verify::relative_error(element.open(path.back(), old, settled).tangent,
                                 element.template at<Real>(path.back(), old).tangent) < 1e-13);
    for (const Real open : {-0.02, 0.03}) {
      const auto q = verify::relation_report<n>(path.back(), settled + open, 2e-5, 1e-5,
                                                [&](const Vec<Real, n>& u, Real l) { return element.open(u, old, l); });
      CHECK(q.gradient < 1e-8);
      CHECK(q.force < 1e-8);
      CHECK(q.tangent < 1e-8);
    }
  }
}
template <class Element, class Kinematics, class Material>
void check(const Material& material, const std::vector<std::vector<U>>& paths) {
  const verify::SingleElement<Element, Kinematics, Material> element{.material = material, .X = distorted()};
  for (const auto& path : paths) check_tangent(element, path);
}

template <class Material>
void check_all(const Material& material, const std::vector<std::vector<U>>& paths) {
  check<MeanDilatation<Quad4>, PlaneStrain>(material, paths);
  check<MeanDilatation<Quad4>, Axisymmetric>(material, paths);
  check<FullyIntegrated<Quad4>, PlaneStrain>(material, paths);
  check<FullyIntegrated<Quad4>, Axisymmetric>(material, paths);
}

/// Whether any point of the element flows at the end of the path.
template <class Element, class Material>
bool flows(const Material& material, const std::vector<U>& path) {
  const verify::SingleElement<Element, PlaneStrain, Material> element{.material = material, .X = distorted()};
  const auto old = element.template preloaded<Real>(path);
  const auto now = element.template at<Real>(path.back(), old).states;
  for (std::size_t p = 0; p < now.size(); ++p)
    if (now[p].plastic_strain > old[p].plastic_strain) return true;
  return false;
}

}  // namespace element_check
