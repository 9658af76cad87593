// SPDX-License-Identifier: BSL-1.0
// A linear solver that is chosen as the program runs: one model for all that want the same storage, where a model
// each would take minutes to compile. It is a policy like any other, so the library need not know of it.
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <memory>
#include <string>

namespace examples {

/// A solver behind virtual functions. A call a factorisation costs nothing that can be measured.
class AnySolver {
 public:
  virtual ~AnySolver() = default;
  virtual void analyze(const stickslip::SparseView& pattern) = 0;
  virtual stickslip::Factorization factorize(const stickslip::SparseView& matrix) = 0;
  virtual bool solve(const double* right_hand_side, double* solution) = 0;
  virtual stickslip::Index inner_iterations() const = 0;
  virtual std::size_t factor_bytes() const = 0;
  virtual void serialize(stickslip::Archive& archive) = 0;
};

/// A new solver for matrices of that storage; throws std::invalid_argument if the name has none.
std::unique_ptr<AnySolver> make_solver(const std::string& name, stickslip::Symmetry storage);

/// The solver that the command line named. Newton's method makes its solver itself, so the name must be told before.
inline std::string chosen_solver;

template <stickslip::Symmetry storage_>
class ChosenSolver {
 public:
  using Role = stickslip::role::LinearSolver;
  static constexpr stickslip::Symmetry accepts = storage_, storage = storage_;

  void analyze(const stickslip::SparseView& pattern) { solver_->analyze(pattern); }
  stickslip::Factorization factorize(const stickslip::SparseView& matrix) { return solver_->factorize(matrix); }
  bool solve(const double* right_hand_side, double* solution) { return solver_->solve(right_hand_side, solution); }
  stickslip::Index inner_iterations() const { return solver_->inner_iterations(); }
  std::size_t factor_bytes() const { return solver_->factor_bytes(); }

  void serialize(stickslip::Archive& archive) { solver_->serialize(archive); }

 private:
  std::unique_ptr<AnySolver> solver_ = make_solver(chosen_solver, storage_);
};

/// For solvers that keep the lower triangle of a symmetric matrix, and for those that keep the whole matrix.
using ChosenLower = ChosenSolver<stickslip::Symmetry::symmetric>;
using ChosenFull = ChosenSolver<stickslip::Symmetry::general>;
/// For those that correct the factor of a symmetric matrix, and so take general systems.
struct ChosenCorrected : ChosenLower {
  static constexpr stickslip::Symmetry accepts = stickslip::Symmetry::general;
  static constexpr bool corrects = true;
};
/// For those that have one for each.
struct ChosenEither {
  using Role = stickslip::role::LinearSolver;
  template <stickslip::Symmetry system>
  using For = ChosenSolver<system>;
};

}  // namespace examples
