// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/one_blas_thread.hpp>
#include <stickslip/linear_solver/refinement.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <stdexcept>

namespace stickslip {

/// Parameters of Cholmod.
struct CholmodParameters {
  /// Order of the elimination: CHOLMOD's choice of AMD and, where that fills in much, METIS; one of them; that of the
  /// mesh.
  enum class Ordering { best, amd, metis, natural };
  /// Kind of the factor: CHOLMOD's choice; by single columns, for matrices of little fill; in dense blocks.
  enum class Factor { best, simplicial, supernodal };

  Ordering ordering = Ordering::best;
  Factor factor = Factor::best;
};

/// CHOLMOD's sparse Cholesky. An indefinite matrix falls back to its
/// simplicial L D L^T, which does not pivot: `solve` then refines the solution and fails if its residual stays large.
/// Link stickslip::cholmod; note CHOLMOD's licence (LGPL, the supernodal part GPL).
class Cholmod {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;
  static constexpr bool direct = true;

  using Parameters = CholmodParameters;

  Cholmod() : Cholmod(Parameters{}) {}
  explicit Cholmod(const Parameters& parameters)
      : parameters_(parameters), common_(std::make_unique<cholmod_common>()) {
    cholmod_start(common_.get());
    if (parameters.ordering != Parameters::Ordering::best) {
      common_->nmethods = 1;
      common_->method[0].ordering = parameters.ordering == Parameters::Ordering::amd     ? CHOLMOD_AMD
                                    : parameters.ordering == Parameters::Ordering::metis ? CHOLMOD_METIS
                                                                                         : CHOLMOD_NATURAL;
    }
    common_->print = 0;
    common_->error_handler = nullptr;
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  ~Cholmod() {
    cholmod_free_factor(&factor_, common_.get());
    cholmod_free_factor(&indefinite_factor_, common_.get());
    cholmod_free_dense(&solution_, common_.get());
    cholmod_free_dense(&work_y_, common_.get());
    cholmod_free_dense(&work_e_, common_.get());
    cholmod_finish(common_.get());
  }

  void analyze(const SparseView& pattern) {
    cholmod_free_factor(&factor_, common_.get());
    cholmod_free_factor(&indefinite_factor_, common_.get());
    cholmod_sparse a = wrap(pattern);
    a.xtype = CHOLMOD_PATTERN;
    common_->supernodal = parameters_.factor == Parameters::Factor::best         ? CHOLMOD_AUTO
                          : parameters_.factor == Parameters::Factor::simplicial ? CHOLMOD_SIMPLICIAL
                                                                                 : CHOLMOD_SUPERNODAL;
    factor_ = cholmod_analyze(&a, common_.get());
    enough_memory();
    if (!factor_ && parameters_.ordering == Parameters::Ordering::metis)
      throw std::invalid_argument("Cholmod: the ordering metis is not in this build of CHOLMOD");
    refinement_.resize(pattern.size);
  }

  Factorization factorize(const SparseView& matrix) {
    if (!factor_) return Factorization::failed;
    const OneBlasThread one;
    matrix_ = matrix;
    cholmod_sparse a = wrap(matrix);
    common_->final_ll = 0;
    cholmod_factorize(&a, factor_, common_.get());
    enough_memory();
    indefinite_ = false;
    if (common_->status == CHOLMOD_OK && positive(*factor_)) return Factorization::done;
    indefinite_ = true;
    if (!indefinite_factor_) {
      common_->supernodal = CHOLMOD_SIMPLICIAL;
      indefinite_factor_ = cholmod_analyze(&a, common_.get());
      enough_memory();
    }
    if (!indefinite_factor_) return Factorization::failed;
    cholmod_factorize(&a, indefinite_factor_, common_.get());
    enough_memory();
    const bool good = common_->status == CHOLMOD_OK && indefinite_factor_->minor == indefinite_factor_->n;
    return good ? Factorization::indefinite : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    if (!indefinite_) return backsolve(right_hand_side, solution);
    return refinement_.solve(matrix_, right_hand_side, solution,
                             [this](const Real* b, Real* x) { return backsolve(b, x); });
  }
  /// Negative pivots of the last factorisation, as many as the matrix has negative eigenvalues.
  Index negative_pivots() const { return indefinite_ ? negative(*indefinite_factor_) : 0; }
  /// Memory of the last factor, including its indices [bytes].
  std::size_t factor_bytes() const {
    const cholmod_factor& f = indefinite_ ? *indefinite_factor_ : *factor_;
    return f.is_super ? f.xsize * sizeof(Real) + f.ssize * sizeof(Index) : f.nzmax * (sizeof(Real) + sizeof(Index));
  }

 private:
  static cholmod_sparse wrap(const SparseView& m) {
    cholmod_sparse a{};
    a.nrow = a.ncol = static_cast<std::size_t>(m.size);
    a.nzmax = static_cast<std::size_t>(m.nonzeros());
    // CHOLMOD only reads them, but takes no pointers to const.
    a.p = const_cast<Index*>(m.column_start);
    a.i = const_cast<Index*>(m.row);
    a.x = const_cast<Real*>(m.values);
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 1;
    a.packed = 1;
    return a;
  }

  // Throws also if a factor has more entries than its integers can count.
  void enough_memory() const {
    if (common_->status == CHOLMOD_OUT_OF_MEMORY || common_->status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
  }

  // A supernodal factor exists only for positive definite matrices; a simplicial L D L^T has the signs on its diagonal.
  static bool positive(const cholmod_factor& f) {
    if (f.minor < f.n) return false;
    if (f.is_super || f.is_ll) return true;
    const auto* start = static_cast<const Index*>(f.p);
    const auto* x = static_cast<const Real*>(f.x);
    for (std::size_t j = 0; j < f.n; ++j)
      if (!(x[start[j]] > 0)) return false;
    return true;
  }

  static Index negative(const cholmod_factor& f) {
    const auto* start = static_cast<const Index*>(f.p);
    const auto* x = static_cast<const Real*>(f.x);
    Index count = 0;
    for (std::size_t j = 0; j < f.n; ++j) count += x[start[j]] < 0 ? 1 : 0;
    return count;
  }

  bool backsolve(const Real* b, Real* x) {
    const OneBlasThread one;
    const auto n = static_cast<std::size_t>(matrix_.size);
    cholmod_dense rhs{};
    rhs.nrow = rhs.nzmax = rhs.d = n;
    rhs.ncol = 1;
    rhs.x = const_cast<Real*>(b);
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    if (!cholmod_solve2(CHOLMOD_A, indefinite_ ? indefinite_factor_ : factor_, &rhs, nullptr, &solution_, nullptr,
                        &work_y_, &work_e_, common_.get()))
      return false;
    std::copy_n(static_cast<const Real*>(solution_->x), n, x);
    return true;
  }

  CholmodParameters parameters_;
  std::unique_ptr<cholmod_common> common_;
  cholmod_factor* factor_ = nullptr;
  cholmod_factor* indefinite_factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
  SparseView matrix_{};
  bool indefinite_ = false;
  Refinement refinement_;
};

}  // namespace stickslip
