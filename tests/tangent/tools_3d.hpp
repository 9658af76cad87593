// SPDX-License-Identifier: BSL-1.0
// A tool of space against dual numbers, and differences of its Hessian against the duals' third derivatives.
#pragma once

#include <stickslip/geometry/surface_point.hpp>
#include <stickslip/verify/report.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tools_3d {

using namespace stickslip;
using V3 = Vec<Real, 3>;

/// Largest component of each error; zero all of them for an exact tool.
struct Report {
  Real normal = 0, length = 0, hess = 0, along = 0, asymmetry = 0;
  Real worst() const { return std::max({normal, length, hess, along, asymmetry}); }
};

template <class Tool>
Report derivatives(const Tool& tool, const V3& x) {
  const Distance<Real, 3> at = tool.distance(x);
  const Distance<Dual<3>, 3> dual = tool.distance(verify::seeded<3>(x));
  const auto largest = [](const auto& m) { return m.cwiseAbs().maxCoeff(); };
  const Mat<Real, 3> mirrored = at.hess_gap.transpose();
  const V3 grad = dual.gap.slope.matrix();
  return {.normal = largest(V3(grad - at.normal)),
          .length = std::abs(at.normal.norm() - 1),
          .hess = largest(Mat<Real, 3>(verify::slopes<3, 3>(dual.normal) - at.hess_gap)),
          .along = largest(V3(at.hess_gap * at.normal)),
          .asymmetry = largest(Mat<Real, 3>(at.hess_gap - mirrored))};
}

/// The duals' slopes of the Hessian against central differences of it: largest component over the largest slope.
template <class Tool>
Real third_derivative(const Tool& tool, const V3& x, Real step) {
  const Distance<Dual<3>, 3> dual = tool.distance(verify::seeded<3>(x));
  Real error = 0, scale = 0;
  for (int j = 0; j < 3; ++j) {
    const Vec<Dual<3>, 3> column = dual.hess_gap.col(j);
    const Mat<Real, 3> by_duals = verify::slopes<3, 3>(column);
    const Mat<Real, 3> by_differences =
        verify::differentiate<3, 3>(x, step, [&](const V3& y) { return V3(tool.distance(y).hess_gap.col(j)); });
    error = std::max(error, (by_duals - by_differences).cwiseAbs().maxCoeff());
    scale = std::max(scale, by_duals.cwiseAbs().maxCoeff());
  }
  return error / std::max(scale, Real(1e-3));
}

}  // namespace tools_3d
