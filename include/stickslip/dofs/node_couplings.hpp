// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <cstddef>
#include <vector>

namespace stickslip {

/// The couplings of sliding nodes, where they are kept apart from the matrix (stores_couplings).
class NodeCouplings {
 public:
  /// Makes room for as many dyads of as many entries in all.
  void reserve(std::size_t dyads, std::size_t entries) {
    start_.reserve(dyads + 1);
    equations_.reserve(entries);
    left_.reserve(entries);
    right_.reserve(entries);
  }
  void clear() {
    start_.assign(1, 0);
    equations_.clear();
    left_.clear();
    right_.clear();
  }
  /// Adds the column `left(i)` times the row `right(i)`, both over `equations`.
  template <class Equations, class Left, class Right>
  void add(const Equations& equations, const Left& left, const Right& right) {
    for (std::size_t i = 0; i < equations.size(); ++i) {
      equations_.push_back(equations[i]);
      left_.push_back(left(static_cast<Index>(i)));
      right_.push_back(right(static_cast<Index>(i)));
    }
    start_.push_back(static_cast<Index>(equations_.size()));
  }
  void scale(Real factor) {
    for (Real& entry : left_) entry *= factor;
  }
  Dyads view() const {
    return {static_cast<Index>(start_.size()) - 1, start_.data(), equations_.data(), left_.data(), right_.data()};
  }

 private:
  std::vector<Index> start_{0}, equations_;
  std::vector<Real> left_, right_;
};

/// Where the matrix holds them.
struct NoNodeCouplings {
  void reserve(std::size_t, std::size_t) {}
  void clear() {}
  void scale(Real) {}
  Dyads view() const { return {}; }
};

}  // namespace stickslip
