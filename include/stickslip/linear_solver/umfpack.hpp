// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <suitesparse/umfpack.h>

#include <array>
#include <vector>

namespace stickslip {

/// UMFPACK's unsymmetric multifrontal LU. Takes every system. Link stickslip::umfpack; UMFPACK is GPL.
class Umfpack {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;

  Umfpack() { umfpack_di_defaults(control_.data()); }
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;
  ~Umfpack() {
    umfpack_di_free_symbolic(&symbolic_);
    umfpack_di_free_numeric(&numeric_);
  }

  void analyze(const SparseView& pattern) {
    umfpack_di_free_symbolic(&symbolic_);
    umfpack_di_symbolic(pattern.size, pattern.size, pattern.column_start, pattern.row, nullptr, &symbolic_,
                        control_.data(), nullptr);
    integers_.resize(static_cast<std::size_t>(pattern.size));
    reals_.resize(5 * static_cast<std::size_t>(pattern.size));
  }

  Factorization factorize(const SparseView& matrix) {
    if (!symbolic_) return Factorization::failed;
    matrix_ = matrix;
    umfpack_di_free_numeric(&numeric_);
    const int status = umfpack_di_numeric(matrix.column_start, matrix.row, matrix.values, symbolic_, &numeric_,
                                          control_.data(), nullptr);
    return status == UMFPACK_OK ? Factorization::done : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    return umfpack_di_wsolve(UMFPACK_A, matrix_.column_start, matrix_.row, matrix_.values, solution, right_hand_side,
                             numeric_, control_.data(), nullptr, integers_.data(), reals_.data()) == UMFPACK_OK;
  }

 private:
  std::array<double, UMFPACK_CONTROL> control_{};
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  SparseView matrix_{};
  std::vector<int> integers_;
  std::vector<double> reals_;
};

}  // namespace stickslip
