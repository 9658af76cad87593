// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <cmath>
#include <vector>

namespace stickslip {

/// A symmetric direct solver made a solver of the exact, non-symmetric tangent of friction. The matrix is stored and
/// factorised as a symmetric one, K_s, without the couplings C of the sliding nodes; GMRES solves (1 + C K_s^-1) y = b,
/// x = K_s^-1 y, on its factor (theory.md, section 6.5). An iteration takes one back-substitution.
template <class Symmetric>
class Corrected {
  static_assert(LinearSolverPolicy<Symmetric> && Symmetric::storage == Symmetry::symmetric,
                "stickslip: Corrected<S> needs a solver S that takes lower triangles, such as EigenLdlt.");

 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::symmetric;
  static constexpr bool corrects = true;
  static constexpr Real tolerance = 1e-6;  ///< of the relative residual
  static constexpr Index most = 60;        ///< iterations of one solution

  void analyze(const SparseView& pattern) {
    solver_.analyze(pattern);
    size_ = pattern.size;
    basis_.clear();
    solved_.clear();
    rotations_.assign(static_cast<std::size_t>(most), {});
    upper_.assign(static_cast<std::size_t>(most * (most + 1) / 2), 0.0);
    right_.assign(static_cast<std::size_t>(most) + 1, 0.0);
  }
  Factorization factorize(const SparseView& matrix) {
    corrections_ = matrix.corrections;
    return solver_.factorize(matrix);
  }
  bool solve(const Real* right_hand_side, Real* solution) {
    if (corrections_.count == 0) return solver_.solve(right_hand_side, solution);
    const Eigen::Map<const Field> b(right_hand_side, size_);
    Eigen::Map<Field> x(solution, size_);
    const Real size = b.norm();
    x.setZero();
    if (!(size > 0)) return size == 0;
    vector(basis_, 0) = b / size;
    right_[0] = size;
    Index n = 0;
    while (n < most) {
      Field& z = vector(solved_, n);
      Field& w = vector(basis_, n + 1);
      if (!solver_.solve(basis_[static_cast<std::size_t>(n)].data(), z.data())) return false;
      w = basis_[static_cast<std::size_t>(n)];
      add_corrections(z, w);
      ++inner_iterations_;
      // Modified Gram-Schmidt, then the rotations that keep the triangle.
      Real* column = upper_.data() + n * (n + 1) / 2;
      for (Index i = 0; i <= n; ++i) {
        column[i] = w.dot(basis_[static_cast<std::size_t>(i)]);
        w -= column[i] * basis_[static_cast<std::size_t>(i)];
      }
      Real below = w.norm();
      if (below > 0) w /= below;
      for (Index i = 0; i < n; ++i) {
        const auto [c, s] = rotations_[static_cast<std::size_t>(i)];
        const Real upper = column[i], lower = column[i + 1];
        column[i] = c * upper + s * lower;
        column[i + 1] = c * lower - s * upper;
      }
      const Real r = std::hypot(column[n], below);
      if (!(r > 0)) return false;
      rotations_[static_cast<std::size_t>(n)] = {column[n] / r, below / r};
      column[n] = r;
      right_[static_cast<std::size_t>(n) + 1] = -below / r * right_[static_cast<std::size_t>(n)];
      right_[static_cast<std::size_t>(n)] *= rotations_[static_cast<std::size_t>(n)].cosine;
      ++n;
      if (std::abs(right_[static_cast<std::size_t>(n)]) <= tolerance * size) break;
    }
    if (std::abs(right_[static_cast<std::size_t>(n)]) > 1e-3 * size) return false;
    for (Index i = n - 1; i >= 0; --i) {
      Real y = right_[static_cast<std::size_t>(i)];
      for (Index j = i + 1; j < n; ++j)
        y -= upper_[static_cast<std::size_t>(j * (j + 1) / 2 + i)] * right_[static_cast<std::size_t>(j)];
      y /= upper_[static_cast<std::size_t>(i * (i + 1) / 2 + i)];
      right_[static_cast<std::size_t>(i)] = y;
      x += y * solved_[static_cast<std::size_t>(i)];
    }
    return true;
  }

  void serialize(Archive& archive) requires requires(Symmetric& s) { s.serialize(archive); }
  { solver_.serialize(archive); }

  /// Iterations of all solutions so far: back-substitutions.
  Index inner_iterations() const { return inner_iterations_; }

 private:
  struct Rotation {
    Real cosine = 1, sine = 0;
  };

  // Vectors are made when they are needed for the first time.
  Field& vector(std::vector<Field>& list, Index k) {
    while (static_cast<Index>(list.size()) <= k) list.emplace_back(Field::Zero(size_));
    return list[static_cast<std::size_t>(k)];
  }

  void add_corrections(const Field& z, Field& w) const {
    const NodeBlocks& c = corrections_;
    for (Index k = 0; k < c.count; ++k) {
      const Index* equation = c.equation + k * c.size;
      const Real* block = c.values + k * c.size * c.size;
      for (Index j = 0; j < c.size; ++j)
        if (equation[j] >= 0)
          for (Index i = 0; i < c.size; ++i)
            if (equation[i] >= 0) w[equation[i]] += block[j * c.size + i] * z[equation[j]];
    }
  }

  Symmetric solver_;
  NodeBlocks corrections_{};
  Index size_ = 0, inner_iterations_ = 0;
  std::vector<Field> basis_, solved_;  // orthonormal vectors, and K_s^-1 of them
  std::vector<Rotation> rotations_;
  std::vector<Real> upper_, right_;  // the triangle by columns, and the right-hand side of the small system
};

}  // namespace stickslip
