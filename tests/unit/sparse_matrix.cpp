// SPDX-License-Identifier: BSL-1.0
#include <stickslip/dofs/sparse_matrix.hpp>
#include <stickslip/element/gradient_operator.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>

#include <random>

namespace {

using namespace stickslip;

struct Filled {
  Eigen::MatrixXd matrix, expected;
  Index nonzeros;
};

// Random symmetric blocks over groups of components, some constrained.
template <Symmetry storage>
Filled fill() {
  const std::vector<std::array<Index, 4>> groups{{0, 1, 2, 3}, {7, 6, 2, 3}, {4, 5, 6, 7}, {8, 9, 0, 5}};
  std::vector<bool> constrained(10, false);
  constrained[1] = constrained[6] = true;
  const IndexMap dofs(10, constrained);
  SparsityPattern pattern(dofs, storage);
  for (const auto& g : groups) pattern.couple(g);
  SparseMatrix<storage> matrix(pattern);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(dofs.unknowns(), dofs.unknowns());
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> u(-1, 1);
  matrix.set_zero();
  for (const auto& g : groups) {
    Mat<Real, 4> block;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) block(i, j) = u(random);
    block = (block + block.transpose()).eval();
    matrix.add(matrix.map(dofs, g), block);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Index r = dofs.equation(g[std::size_t(i)]), c = dofs.equation(g[std::size_t(j)]);
        if (r != IndexMap::constrained && c != IndexMap::constrained) expected(r, c) += block(i, j);
      }
  }
  return {verify::dense(matrix.view()), expected, matrix.view().nonzeros()};
}

TEST_CASE("lower triangle and full storage hold the same matrix") {
  const auto lower = fill<Symmetry::symmetric>(), full = fill<Symmetry::general>();
  CHECK((full.matrix - full.expected).norm() < 1e-15);
  CHECK((lower.matrix - lower.expected).norm() < 1e-15);
  // The triangle alone: half of the off-diagonal entries.
  CHECK(2 * lower.nonzeros - full.matrix.rows() == full.nonzeros);
}
TEST_CASE("a matrix view has the storage of its symmetry and ascending rows") {
  const IndexMap dofs(4, std::vector<bool>(4, false));
  SparseMatrix<Symmetry::symmetric> matrix;
  const std::array<Index, 4> group{3, 1, 0, 2};
  SparsityPattern pattern(dofs, Symmetry::symmetric);
  pattern.couple(group);
  matrix = decltype(matrix)(pattern);
  const SparseView view = matrix.view();
  CHECK(view.symmetry == Symmetry::symmetric);
  CHECK(view.nonzeros() == 10);
  for (Index j = 0; j < 4; ++j)
    for (Index k = view.column_start[j]; k < view.column_start[j + 1]; ++k) {
      CHECK(view.row[k] >= j);
      if (k > view.column_start[j]) CHECK(view.row[k] > view.row[k - 1]);
    }
}
TEST_CASE("copy_lower_to_upper makes a matrix of every element size symmetric") {
  // Written for every size that an element of the plane or of space has; see the compiler note at mirror().
  const auto check = [](auto size) {
    constexpr int n = decltype(size)::value;
    Mat<Real, n> k = Mat<Real, n>::Zero();
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i) k(i, j) = 100 * i + j + 1;
    Mat<Real, n> m = k;
    copy_lower_to_upper(m);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) CHECK(m(i, j) == k(std::max(i, j), std::min(i, j)));
  };
  check(std::integral_constant<int, 2>{});
  check(std::integral_constant<int, 8>{});
  check(std::integral_constant<int, 18>{});
}

}  // namespace
