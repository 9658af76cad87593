// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/stored_if.hpp>
#include <stickslip/dofs/sparse_matrix.hpp>
#include <stickslip/mesh/facet.hpp>
#include <stickslip/policy/enforcement.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace stickslip {

/// Measures of the nodes of a contact side: their spacing, the tributary measure behind a unit of penalty, and, for a
/// friction law that depends on it, the reference area.
template <int dim, bool with_area>
class NodeMeasures {
 public:
  template <class MeshType, class Kinematics>
  NodeMeasures(const MeshType& mesh, const Kinematics& kinematics, const std::string& side, PenaltyPer per)
      : spacing_(nodal_spacing(mesh, side)), tributary_(spacing_.size(), 0.0) {
    const auto& nodes = mesh.side(side).nodes;
    if (per == PenaltyPer::node) std::fill(tributary_.begin(), tributary_.end(), 1.0);
    if (per == PenaltyPer::unit_depth && !nodes.empty())
      std::fill(tributary_.begin(), tributary_.end(),
                Kinematics::hoop ? 2 * pi : kinematics.volume_factor(mesh.nodes[static_cast<std::size_t>(nodes[0])]));
    if (per == PenaltyPer::area) tributary_ = nodal_areas(mesh, kinematics, side);
    if constexpr (with_area) area_ = nodal_areas(mesh, kinematics, side);
  }

  /// Distance of a node from its nearest neighbour [length].
  Real spacing(std::size_t k) const { return spacing_[k]; }
  Real smallest_spacing() const { return *std::min_element(spacing_.begin(), spacing_.end()); }
  /// Measure behind one unit of penalty: 1, 2 pi, thickness, area or stiffness, as PenaltyPer says.
  const std::vector<Real>& tributary() const { return tributary_; }
  /// Reference area that a node carries [length^2]; 0 where the friction law does not depend on it.
  Real area([[maybe_unused]] std::size_t k) const {
    if constexpr (with_area)
      return area_[k];
    else
      return 0;
  }

  /// Takes the body's stiffness at the nodes from its tangent as their measure (PenaltyPer::stiffness): the mean over
  /// the free components, at a node without any the mean over the side. False where no node has a stiffness.
  template <class Matrix>
  bool take_stiffness(const IndexMap& dofs, const std::vector<Index>& nodes, const Matrix& tangent) {
    Real sum = 0;
    Index known = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      Real trace = 0;
      Index free = 0;
      for (Index c = nodes[k] * dim; c < (nodes[k] + 1) * dim; ++c)
        if (const Index e = dofs.equation(c); e != IndexMap::constrained) {
          trace += tangent.diagonal(e);
          ++free;
        }
      tributary_[k] = free > 0 && trace > 0 ? trace / free : 0;
      sum += tributary_[k];
      known += tributary_[k] > 0 ? 1 : 0;
    }
    if (known == 0) return false;
    for (Real& w : tributary_)
      if (w == 0) w = sum / known;
    return true;
  }

  /// Scales the penalties by a factor, until they are restored or kept.
  void scale_penalty(Real factor) {
    for (Real& w : tributary_) w *= factor;
    penalty_scale_ *= factor;
  }
  void restore_penalty() {
    if (penalty_scale_ == 1) return;
    for (Real& w : tributary_) w /= penalty_scale_;
    penalty_scale_ = 1;
  }
  void keep_penalty() { penalty_scale_ = 1; }

  void serialize(Archive& archive, const std::string& name) { archive(name, tributary_); }

 private:
  std::vector<Real> spacing_, tributary_;
  [[no_unique_address]] StoredIf<with_area, std::vector<Real>, NodeMeasures> area_;
  Real penalty_scale_ = 1;  // of this step
};

}  // namespace stickslip
