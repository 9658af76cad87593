// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/verify/report.hpp>

#include <algorithm>
#include <cmath>

namespace stickslip::verify {

/// Errors of the derivatives of a tool's closest point against dual numbers, at one point; largest components.
struct ToolReport {
  Real normal = 0;        ///< of grad gap - normal [-]
  Real length = 0;        ///< | |normal| - 1 |
  Real hess_gap = 0;      ///< [1/length]
  Real grad_surface = 0;  ///< [-]
  Real hess_surface = 0;  ///< [1/length]
  Real worst() const { return std::max({normal, length, hess_gap, grad_surface, hess_surface}); }
};

template <class Tool, int dim>
ToolReport tool_derivatives(const Tool& tool, const Vec<Real, dim>& x) {
  constexpr int places = surface_coordinates<dim>;
  const SurfacePoint<Real, dim> at = surface_point<Real, dim>(tool, x);
  const SurfacePoint<Dual<dim>, dim> dual = surface_point<Dual<dim>, dim>(tool, seeded<dim>(x));
  const auto largest = [](const auto& m) { return m.cwiseAbs().maxCoeff(); };
  const Vec<Real, dim> grad_gap = dual.gap.slope.matrix();
  ToolReport report{.normal = largest(Vec<Real, dim>(grad_gap - at.normal)),
                    .length = std::abs(at.normal.norm() - 1),
                    .hess_gap = largest(Mat<Real, dim>(slopes<dim, dim>(dual.normal) - at.hess_gap))};
  for (int k = 0; k < places; ++k) {
    const Vec<Real, dim> grad_surface = dual.surface_coordinate[k].slope.matrix();
    const Vec<Dual<dim>, dim> dual_grad_place = dual.grad_surface.col(k);
    report.grad_surface = std::max(report.grad_surface, largest(Vec<Real, dim>(grad_surface - at.grad_surface.col(k))));
    report.hess_surface = std::max(
        report.hess_surface,
        largest(Mat<Real, dim>(slopes<dim, dim>(dual_grad_place) - at.hess_surface[static_cast<std::size_t>(k)])));
  }
  return report;
}

}  // namespace stickslip::verify
