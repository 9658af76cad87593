// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/dofs/sparse_matrix.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace stickslip {

/// The tangent of the unknowns, C^T K C, from that of all components that are not prescribed: u = C q + b, where linear
/// constraints make some components those of others (theory.md, section 6.1). The map between both is made once.
template <Symmetry storage>
class CondensedMatrix {
 public:
  /// K has the numbering `assembled`, in which constrained components have equations of their own.
  void build(const SparseView& K, const IndexMap& assembled, const IndexMap& unknowns) {
    SparsityPattern pattern(unknowns, storage);
    products_.clear();
    std::vector<std::array<Index, 2>> equations;
    for_each_product(K, assembled, unknowns, [&](Index k, Index row, Index column, Real weight) {
      pattern.couple_equations(row, column);
      equations.push_back({row, column});
      products_.push_back({k, 0, weight});
    });
    matrix_ = SparseMatrix<storage>(pattern);
    for (std::size_t k = 0; k < products_.size(); ++k)
      products_[k].to = matrix_.entry(equations[k][0], equations[k][1]);
  }
  SparseView condense(const SparseView& K) {
    matrix_.set_zero();
    for (const Product& p : products_) matrix_.add(p.to, p.weight * K.values[p.from]);
    return matrix_.view();
  }
  SparseView view() const { return matrix_.view(); }

 private:
  struct Product {
    Index from, to;
    Real weight;
  };
  // Calls visit(k, row, column, weight) for every entry of C^T K C that the entry k of K adds to.
  template <class Visit>
  [[gnu::cold]] static void for_each_product(const SparseView& K, const IndexMap& assembled, const IndexMap& unknowns,
                                             Visit&& visit) {
    std::vector<std::vector<IndexMap::Weighted>> of(static_cast<std::size_t>(K.size));
    for (Index e = 0; e < K.size; ++e) of[static_cast<std::size_t>(e)] = unknowns.equations(assembled.component(e));
    for (Index j = 0; j < K.size; ++j)
      for (Index k = K.column_start[j]; k < K.column_start[j + 1]; ++k) {
        const Index i = K.row[k];
        for (const auto& a : of[static_cast<std::size_t>(i)])
          for (const auto& b : of[static_cast<std::size_t>(j)]) {
            if (storage == Symmetry::general) {
              visit(k, a.index, b.index, a.weight * b.weight);
            } else if (i == j) {
              if (a.index >= b.index) visit(k, a.index, b.index, a.weight * b.weight);
            } else {  // the entry and its mirror image
              visit(k, std::max(a.index, b.index), std::min(a.index, b.index),
                    (a.index == b.index ? 2 : 1) * a.weight * b.weight);
            }
          }
      }
  }

  SparseMatrix<storage> matrix_;
  std::vector<Product> products_;
};

}  // namespace stickslip
