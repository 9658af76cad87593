// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace stickslip {

/// A basis of the null space of a small matrix, in which pivots of `least` and below count as zero: Gauss-Jordan
/// elimination with full pivoting. Eigen's FullPivLU finds the same, but takes the compiler of every program a second.
template <int n>
std::vector<std::array<Real, static_cast<std::size_t>(n)>> null_space(Mat<Real, n> matrix, Real least) {
  constexpr auto size = static_cast<std::size_t>(n);
  std::array<int, size> unknown;  // of each column, as the pivots have ordered them
  for (int j = 0; j < n; ++j) unknown[static_cast<std::size_t>(j)] = j;
  const auto number = [&](int j) { return static_cast<std::size_t>(unknown[static_cast<std::size_t>(j)]); };

  int rank = 0;
  for (; rank < n; ++rank) {
    int row = rank, column = rank;
    for (int i = rank; i < n; ++i)
      for (int j = rank; j < n; ++j)
        if (std::abs(matrix(i, j)) > std::abs(matrix(row, column))) row = i, column = j;
    if (!(std::abs(matrix(row, column)) > least)) break;
    for (int j = 0; j < n; ++j) std::swap(matrix(rank, j), matrix(row, j));
    for (int i = 0; i < n; ++i) std::swap(matrix(i, rank), matrix(i, column));
    std::swap(unknown[static_cast<std::size_t>(rank)], unknown[static_cast<std::size_t>(column)]);
    for (int i = 0; i < n; ++i) {
      if (i == rank) continue;
      const Real factor = matrix(i, rank) / matrix(rank, rank);
      for (int j = rank; j < n; ++j) matrix(i, j) -= factor * matrix(rank, j);
    }
  }

  std::vector<std::array<Real, size>> basis;
  for (int free = rank; free < n; ++free) {
    std::array<Real, size> vector{};
    vector[number(free)] = 1;
    for (int k = 0; k < rank; ++k) vector[number(k)] = -matrix(k, free) / matrix(k, k);
    basis.push_back(vector);
  }
  return basis;
}

}  // namespace stickslip
