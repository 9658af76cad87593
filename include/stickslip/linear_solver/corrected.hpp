// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/orthodir.hpp>
#include <stickslip/policy/linear_solver.hpp>

namespace stickslip {

/// Solves the exact, non-symmetric tangent of friction with a symmetric direct solver. The matrix is stored and
/// factorised as a symmetric one, K_s, without the couplings C of the slipping nodes; (1 + C K_s^-1) y = b, x = K_s^-1
/// y, is solved by minimal residuals (Orthodir; theory.md, section 6.5). An iteration takes one back-substitution.
template <class Symmetric>
class Corrected {
  static_assert(LinearSolverPolicy<Symmetric> && Symmetric::storage == Symmetry::symmetric,
                "stickslip: Corrected<S> needs a solver S that takes lower triangles, such as EigenLdlt.");

 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::symmetric;
  static constexpr bool corrects = true;
  static constexpr bool direct = is_direct<Symmetric>;
  using Parameters = SolverParameters<Symmetric>;
  static constexpr Real tolerance = 1e-6;  ///< of the relative residual
  static constexpr Index most = 60;        ///< largest number of iterations of a solution

  Corrected() = default;
  explicit Corrected(const Parameters& parameters) : solver_(make_solver<Symmetric>(parameters)) {}

  void analyze(const SparseView& pattern) {
    solver_.analyze(pattern);
    size_ = pattern.size;
    krylov_.resize(size_);
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
    krylov_.begin(b);
    while (krylov_.count() < most && krylov_.residual().norm() > tolerance * size) {
      const Field& y = krylov_.next();
      if (!solver_.solve(y.data(), krylov_.step().data())) return false;
      krylov_.response() = y;
      add_corrections(krylov_.step(), krylov_.response());
      ++inner_iterations_;
      if (!krylov_.add()) break;
    }
    x = krylov_.solution();
    return krylov_.residual().norm() <= 1e-3 * size;
  }

  void serialize(Archive& archive) requires requires(Symmetric& s) { s.serialize(archive); }
  { solver_.serialize(archive); }

  /// Iterations of all solutions so far, one back-substitution each.
  Index inner_iterations() const { return inner_iterations_; }
  /// Solves with the symmetric part alone; the corrected solution has as many accurate digits.
  bool probe(const Real* right_hand_side, Real* solution) { return solver_.solve(right_hand_side, solution); }
  /// Negative pivots of the symmetric part.
  Index negative_pivots() const requires requires(const Symmetric& s) { s.negative_pivots(); }
  { return solver_.negative_pivots(); }
  /// Memory of the symmetric factor [bytes].
  std::size_t factor_bytes() const requires requires(const Symmetric& s) { s.factor_bytes(); }
  { return solver_.factor_bytes(); }

 private:
  void add_corrections(const Field& z, Field& w) const {
    const Dyads& c = corrections_;
    for (Index k = 0; k < c.count; ++k) {
      Real along = 0;
      for (Index i = c.start[k]; i < c.start[k + 1]; ++i)
        if (c.equation[i] >= 0) along += c.right[i] * z[c.equation[i]];
      for (Index i = c.start[k]; i < c.start[k + 1]; ++i)
        if (c.equation[i] >= 0) w[c.equation[i]] += c.left[i] * along;
    }
  }

  Symmetric solver_;
  Dyads corrections_{};
  Index size_ = 0, inner_iterations_ = 0;
  Orthodir<> krylov_;
};

}  // namespace stickslip
