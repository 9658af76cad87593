// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace stickslip {

/// The couplings of sliding nodes, where they are kept apart from the matrix (stores_couplings).
template <int dim>
class NodeCouplings {
 public:
  void reserve(std::size_t nodes) {
    equations_.reserve(nodes);
    blocks_.reserve(nodes);
  }
  void clear() {
    equations_.clear();
    blocks_.clear();
  }
  void add(const std::array<Index, static_cast<std::size_t>(dim)>& equations, const Mat<Real, dim>& block) {
    equations_.push_back(equations);
    blocks_.push_back(block);
  }
  void scale(Real factor) {
    for (auto& block : blocks_) block *= factor;
  }
  NodeBlocks view() const {
    if (blocks_.empty()) return {};
    return {static_cast<Index>(blocks_.size()), dim, equations_[0].data(), blocks_[0].data()};
  }

 private:
  std::vector<std::array<Index, static_cast<std::size_t>(dim)>> equations_;
  std::vector<Mat<Real, dim>> blocks_;
};

/// Where the matrix holds them.
struct NoNodeCouplings {
  void reserve(std::size_t) {}
  void clear() {}
  void scale(Real) {}
  NodeBlocks view() const { return {}; }
};

}  // namespace stickslip
