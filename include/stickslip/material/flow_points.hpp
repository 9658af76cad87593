// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace stickslip {

/// A measured point of a flow curve.
struct FlowPoint {
  Real strain = 0;  ///< accumulated plastic strain [-]
  Real stress = 0;  ///< flow stress at that strain [stress]
};

/// Why a table of points is not a flow curve.
struct FlowPointFault {
  std::optional<std::size_t> point;  ///< index of the faulty point, from 0; none: the whole table
  std::string what;
};

/// The first fault of a table; none for a flow curve: at least four points, ascending plastic strains from zero,
/// positive stresses. Strains above 1e30, strain increments below 1e-30 and stresses outside 1e-100 to 1e100 are
/// faults, because slopes and work would overflow.
inline std::optional<FlowPointFault> fault_of(const std::vector<FlowPoint>& points) {
  if (points.size() < 4) return FlowPointFault{{}, "the table needs at least four points"};
  if (points[0].strain != 0) return FlowPointFault{0, "the first point must lie at zero plastic strain"};
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k].strain) || (k > 0 && !(points[k].strain > points[k - 1].strain)))
      return FlowPointFault{k, "the plastic strains must ascend"};
    if (!(points[k].stress > 0 && std::isfinite(points[k].stress)))
      return FlowPointFault{k, "the flow stresses must be positive"};
    if (points[k].strain > 1e30 || (k > 0 && points[k].strain - points[k - 1].strain < 1e-30))
      return FlowPointFault{k, "plastic strains beyond 1e30 or steps of them below 1e-30 cannot be computed with"};
    if (points[k].stress > 1e100 || points[k].stress < 1e-100)
      return FlowPointFault{k, "flow stresses beyond 1e100 or below 1e-100 cannot be computed with"};
  }
  return std::nullopt;
}

}  // namespace stickslip
