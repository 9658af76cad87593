// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/one_blas_thread.hpp>
#include <stickslip/linear_solver/refinement.hpp>

#include <suitesparse/umfpack.h>

#include <array>
#include <cstddef>
#include <new>
#include <vector>

namespace stickslip {

/// UMFPACK's unsymmetric multifrontal LU. Accepts every system. Link stickslip::umfpack; UMFPACK is GPL.
class Umfpack {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;
  static constexpr bool direct = true;

  Umfpack() {
    umfpack_di_defaults(control_.data());
    control_[UMFPACK_IRSTEP] = 0;
  }
  Umfpack(const Umfpack&) = delete;
  Umfpack& operator=(const Umfpack&) = delete;
  ~Umfpack() {
    umfpack_di_free_symbolic(&symbolic_);
    umfpack_di_free_numeric(&numeric_);
  }

  void analyze(const SparseView& pattern) {
    umfpack_di_free_symbolic(&symbolic_);
    enough_memory(umfpack_di_symbolic(pattern.size, pattern.size, pattern.column_start, pattern.row, nullptr,
                                      &symbolic_, control_.data(), nullptr));
    integers_.resize(static_cast<std::size_t>(pattern.size));
    reals_.resize(static_cast<std::size_t>(pattern.size));
    refinement_.resize(pattern.size);
  }

  Factorization factorize(const SparseView& matrix) {
    const OneBlasThread one;
    matrix_ = matrix;
    return factorize(0.1) ? Factorization::done : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    const OneBlasThread one;
    const auto solved = [&] {
      return refinement_.solve(matrix_, right_hand_side, solution, [&](const Real* b, Real* x) {
        return umfpack_di_wsolve(UMFPACK_A, matrix_.column_start, matrix_.row, matrix_.values, x, b, numeric_,
                                 control_.data(), nullptr, integers_.data(), reals_.data()) == UMFPACK_OK;
      });
    };
    // In plastic flow UMFPACK's default threshold may allow a pivot growth that refinement cannot correct.
    return solved() || (factorize(1) && solved());
  }
  /// Memory of the last factor, including its indices [bytes].
  std::size_t factor_bytes() const {
    return static_cast<std::size_t>(info_[UMFPACK_NUMERIC_SIZE] * info_[UMFPACK_SIZE_OF_UNIT]);
  }

 private:
  // Accepts pivots of at least `pivot_tolerance` times the largest entry of the column.
  bool factorize(Real pivot_tolerance) {
    if (!symbolic_) return false;
    control_[UMFPACK_PIVOT_TOLERANCE] = pivot_tolerance;
    umfpack_di_free_numeric(&numeric_);
    const int status = umfpack_di_numeric(matrix_.column_start, matrix_.row, matrix_.values, symbolic_, &numeric_,
                                          control_.data(), info_.data());
    enough_memory(status);
    return status == UMFPACK_OK;
  }
  // Throws also if a factor has more entries than its integers can count.
  static void enough_memory(int status) {
    if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
  }

  std::array<double, UMFPACK_CONTROL> control_{};
  std::array<double, UMFPACK_INFO> info_{};
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  SparseView matrix_{};
  Refinement refinement_;
  std::vector<int> integers_;
  std::vector<double> reals_;
};

}  // namespace stickslip
