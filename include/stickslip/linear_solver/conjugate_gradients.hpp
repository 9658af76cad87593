// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/eigen_map.hpp>
#include <stickslip/linear_solver/iteration_limits.hpp>
#include <stickslip/linear_solver/refinement.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <Eigen/IterativeLinearSolvers>

namespace stickslip {

/// Conjugate gradients with Eigen's incomplete Cholesky factor: memory and time of a large solid grow little faster
/// than its unknowns. For positive definite systems only: `solve` fails at a direction of negative curvature.
class ConjugateGradients {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;
  using Parameters = IterationLimits;

  ConjugateGradients() : ConjugateGradients(Parameters{}) {}
  explicit ConjugateGradients(const Parameters& limits) : limits_(limits) { limits.validate("ConjugateGradients"); }

  void analyze(const SparseView& pattern) {
    refinement_.resize(pattern.size);
    for (Field* field : {&residual_, &preconditioned_, &direction_, &image_}) field->setZero(pattern.size);
    complete_diagonal_ = true;
    for (Index j = 0; j < pattern.size; ++j)
      complete_diagonal_ &=
          pattern.column_start[j] < pattern.column_start[j + 1] && pattern.row[pattern.column_start[j]] == j;
    analyze_pattern(preconditioner_, pattern);
  }

  /// `done` means that a preconditioner exists: only `solve` detects an indefinite matrix.
  Factorization factorize(const SparseView& matrix) {
    if (!complete_diagonal_) return Factorization::failed;  // Eigen would take another entry for the diagonal one
    matrix_ = matrix;
    preconditioner_.factorize(eigen_map(matrix));
    return preconditioner_.info() == Eigen::Success ? Factorization::done : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    iterations_ = 0;
    return refinement_.solve(
        matrix_, right_hand_side, solution, [this](const Real* b, Real* x) { return iterate(b, x); },
        limits_.tolerance);
  }

  /// Iterations of the last `solve`.
  Index iterations() const { return iterations_; }

 private:
  bool iterate(const Real* right_hand_side, Real* solution) {
    const EigenMap matrix = eigen_map(matrix_);
    Eigen::Map<Field> x(solution, matrix_.size);
    x.setZero();
    residual_ = Eigen::Map<const Field>(right_hand_side, matrix_.size);
    direction_.setZero();
    const Real aim = limits_.tolerance * residual_.norm();
    Real energy = 1;  // any nonzero value: the first direction has no predecessor
    while (!(residual_.norm() <= aim)) {
      if (iterations_++ == limits_.iterations) return false;
      preconditioned_ = preconditioner_.solve(residual_);
      const Real last = energy;
      energy = residual_.dot(preconditioned_);
      direction_ = preconditioned_ + energy / last * direction_;
      image_.noalias() = matrix.selfadjointView<Eigen::Lower>() * direction_;
      const Real curvature = direction_.dot(image_);
      if (!(curvature > 0)) return false;
      x += energy / curvature * direction_;
      residual_ -= energy / curvature * image_;
    }
    return true;
  }

  // Without reordering: the factor keeps no more entries than the matrix has, and the numbering of a mesh suits it.
  Eigen::IncompleteCholesky<Real, Eigen::Lower, Eigen::NaturalOrdering<Index>> preconditioner_;
  IterationLimits limits_;
  SparseView matrix_{};
  Field residual_, preconditioned_, direction_, image_;
  Refinement refinement_;
  Index iterations_ = 0;
  bool complete_diagonal_ = true;
};

}  // namespace stickslip
