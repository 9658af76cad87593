// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/dofs/sparsity_pattern.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace stickslip {

/// The system matrix: a pattern that is made once and values that are refilled through maps. Entries of constrained
/// components, and of the upper triangle of a symmetric matrix, go to one spare slot behind the values, so that the
/// scatter loop has no branch.
template <Symmetry storage>
class SparseMatrix {
 public:
  /// Entries of a square block over `n` local components that are scattered: column by column, of a symmetric one the
  /// lower triangle.
  static constexpr int block_entries(int n) { return storage == Symmetry::symmetric ? n * (n + 1) / 2 : n * n; }

  static constexpr int entry_on_diagonal(int n, int i) {
    return storage == Symmetry::symmetric ? i * n - i * (i - 1) / 2 : i * (n + 1);
  }

  SparseMatrix() = default;
  /// Of a pattern that was made for this storage, in full.
  explicit SparseMatrix(SparsityPattern& pattern) {
    pattern.compress(column_start_, row_);
    values_.assign(row_.size() + 1, 0.0);
  }

  /// Where the entries of a block over `components` are stored.
  template <std::size_t n>
  std::array<Index, static_cast<std::size_t>(block_entries(n))> map(const IndexMap& dofs,
                                                                    const std::array<Index, n>& components) const {
    std::array<Index, static_cast<std::size_t>(block_entries(n))> slots;
    std::size_t k = 0;
    for (std::size_t b = 0; b < n; ++b)
      for (std::size_t a = storage == Symmetry::symmetric ? b : 0; a < n; ++a)
        slots[k++] = slot(dofs.equation(components[a]), dofs.equation(components[b]));
    return slots;
  }

  /// This becomes factor * this + other_factor * other; both have one pattern.
  void combine(Real factor, const SparseMatrix& other, Real other_factor) {
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k] = factor * values_[k] + other_factor * other.values_[k];
  }
  void scale(Real factor) {
    for (Real& v : values_) v *= factor;
  }
  /// Largest magnitude of an entry.
  Real largest() const {
    Real m = 0;
    for (std::size_t k = 0; k + 1 < values_.size(); ++k) m = std::max(m, std::abs(values_[k]));
    return m;
  }

  /// Largest of the entries that a scattered block has on the diagonal; 0 where it has none.
  template <int n>
  Real largest_diagonal(const std::array<Index, static_cast<std::size_t>(block_entries(n))>& slots) const {
    Real m = 0;
    for (int i = 0; i < n; ++i) {
      const auto slot = static_cast<std::size_t>(slots[static_cast<std::size_t>(entry_on_diagonal(n, i))]);
      if (slot < row_.size()) m = std::max(m, values_[slot]);
    }
    return m;
  }

  /// The entry of an equation with itself.
  Real diagonal(Index equation) const { return values_[static_cast<std::size_t>(slot(equation, equation))]; }

  /// Where the entry of two equations is stored, and an addition to it.
  Index entry(Index row, Index column) const { return slot(row, column); }
  void add(Index entry, Real value) { values_[static_cast<std::size_t>(entry)] += value; }
  Real value(Index entry) const { return values_[static_cast<std::size_t>(entry)]; }

  void set_zero() { std::fill(values_.begin(), values_.end(), 0.0); }

  /// Adds a block; of a symmetric matrix its lower triangle is read.
  template <int n>
  void add(const std::array<Index, static_cast<std::size_t>(block_entries(n))>& slots, const Mat<Real, n>& block) {
    std::size_t k = 0;
    for (int b = 0; b < n; ++b)
      for (int a = storage == Symmetry::symmetric ? b : 0; a < n; ++a)
        values_[static_cast<std::size_t>(slots[k++])] += block(a, b);
  }

  /// Adds a block over any number of components, entry by entry: for stencils whose length is known as the program
  /// runs. Of a symmetric matrix its lower triangle is taken.
  template <class Block>
  void add(const IndexMap& dofs, std::span<const Index> components, const Block& block) {
    for (std::size_t b = 0; b < components.size(); ++b)
      for (std::size_t a = 0; a < components.size(); ++a) {
        const Index row = dofs.equation(components[a]), column = dofs.equation(components[b]);
        if (storage == Symmetry::symmetric && row < column) continue;
        values_[static_cast<std::size_t>(slot(row, column))] += block(static_cast<Index>(a), static_cast<Index>(b));
      }
  }

  SparseView view() const {
    return {static_cast<Index>(column_start_.size()) - 1, column_start_.data(), row_.data(), values_.data(), storage};
  }

 private:
  Index slot(Index row, Index column) const {
    const Index spare = static_cast<Index>(row_.size());
    if (row == IndexMap::constrained || column == IndexMap::constrained) return spare;
    if (storage == Symmetry::symmetric && row < column) std::swap(row, column);
    const auto begin = row_.begin() + column_start_[static_cast<std::size_t>(column)];
    const auto end = row_.begin() + column_start_[static_cast<std::size_t>(column) + 1];
    return static_cast<Index>(std::lower_bound(begin, end, row) - row_.begin());
  }

  std::vector<Index> column_start_{0};
  std::vector<Index> row_;
  std::vector<Real> values_;
};

}  // namespace stickslip
