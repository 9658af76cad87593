// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/verify/report.hpp>

#include <cmath>

namespace stickslip::verify {

/// Derivatives of a tool's closest point against dual numbers, at one point of the plane; largest components.
struct ToolReport {
  Real normal = 0;      ///< of grad gap - normal [-]
  Real length = 0;      ///< | |normal| - 1 |
  Real hess_gap = 0;    ///< [1/length]
  Real grad_place = 0;  ///< [-]
  Real hess_place = 0;  ///< [1/length]
  Real worst() const { return std::max({normal, length, hess_gap, grad_place, hess_place}); }
};

template <class Tool>
ToolReport tool_derivatives(const Tool& tool, const Vec<Real, 2>& x) {
  const SurfacePoint<Real, 2> at = tool.closest(x);
  const SurfacePoint<Dual<2>, 2> dual = tool.closest(seeded<2>(x));
  const auto largest = [](const auto& m) { return m.cwiseAbs().maxCoeff(); };
  const Vec<Real, 2> grad_gap = dual.gap.slope.matrix(), grad_place = dual.place[0].slope.matrix();
  const Vec<Dual<2>, 2> dual_grad_place = dual.grad_place.col(0);
  return {.normal = largest(Vec<Real, 2>(grad_gap - at.normal)),
          .length = std::abs(at.normal.norm() - 1),
          .hess_gap = largest(Mat<Real, 2>(slopes<2, 2>(dual.normal) - at.hess_gap)),
          .grad_place = largest(Vec<Real, 2>(grad_place - at.grad_place.col(0))),
          .hess_place = largest(Mat<Real, 2>(slopes<2, 2>(dual_grad_place) - at.hess_place[0]))};
}

}  // namespace stickslip::verify
