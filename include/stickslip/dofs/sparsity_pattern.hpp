// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/symmetry.hpp>
#include <stickslip/dofs/index_map.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace stickslip {

/// Which equations are coupled, while the pattern of a system matrix is in the making: of symmetric storage the lower
/// triangle.
class SparsityPattern {
 public:
  SparsityPattern(const IndexMap& dofs, Symmetry storage)
      : dofs_(dofs), storage_(storage), columns_(static_cast<std::size_t>(dofs.unknowns())) {}

  /// Couples every component of a group with every other; constrained ones are left out.
  void couple(std::span<const Index> components) {
    for (const Index a : components)
      for (const Index b : components) {
        const Index row = dofs_.equation(a), column = dofs_.equation(b);
        if (row == IndexMap::constrained || column == IndexMap::constrained) continue;
        if (storage_ == Symmetry::general || row >= column) columns_[static_cast<std::size_t>(column)].push_back(row);
      }
  }

  /// Couples two equations; of symmetric storage the row must not be above the column.
  void couple_equations(Index row, Index column) { columns_[static_cast<std::size_t>(column)].push_back(row); }

  /// The pattern by columns, rows ascending: those of column j are row[column_start[j]] to row[column_start[j + 1]].
  [[gnu::cold]] void compress(std::vector<Index>& column_start, std::vector<Index>& row) {
    column_start.assign(1, 0);
    row.clear();
    for (auto& column : columns_) {
      std::sort(column.begin(), column.end());
      column.erase(std::unique(column.begin(), column.end()), column.end());
      row.insert(row.end(), column.begin(), column.end());
      column_start.push_back(static_cast<Index>(row.size()));
    }
  }

 private:
  const IndexMap& dofs_;
  Symmetry storage_;
  std::vector<std::vector<Index>> columns_;
};

}  // namespace stickslip
