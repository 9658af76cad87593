// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/one_blas_thread.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <dmumps_c.h>

#include <algorithm>
#include <memory>
#include <new>
#include <vector>

namespace stickslip {

namespace detail {

/// Terminates an instance of MUMPS and deletes it.
struct EndMumps {
  void operator()(DMUMPS_STRUC_C* mumps) const {
    mumps->job = -2;
    dmumps_c(mumps);
    delete mumps;
  }
};
using MumpsInstance = std::unique_ptr<DMUMPS_STRUC_C, EndMumps>;

/// A new instance that prints nothing; null if MUMPS could not start.
inline MumpsInstance start_mumps(Symmetry system) {
  auto mumps = std::make_unique<DMUMPS_STRUC_C>();
  mumps->comm_fortran = -987654;  // MUMPS's code for MPI_COMM_WORLD, here one process
  mumps->par = 1;
  mumps->sym = system == Symmetry::symmetric ? 2 : 0;
  mumps->job = -1;
  dmumps_c(mumps.get());
  if (mumps->infog[0] < 0) return {};
  std::fill_n(mumps->icntl, 3, -1);  // no stream for errors, diagnostics and statistics
  mumps->icntl[3] = 0;
  mumps->icntl[5] = 0;   // no permutation by values: the analysis sees the pattern alone
  mumps->icntl[11] = 1;  // no ordering that needs values
  mumps->icntl[12] = 1;  // count the negative pivots of the last front as well
  return MumpsInstance(mumps.release());
}

}  // namespace detail

/// MUMPS's multifrontal solver, sequential: L D L^T with 1 x 1 and 2 x 2 pivots for symmetric systems, definite or not;
/// LU with threshold pivoting for general ones. Link stickslip::mumps; MUMPS is CeCILL-C. Two solvers may exist at
/// once, but must not run at once in two threads.
template <Symmetry system>
class MumpsSolver {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = system;
  static constexpr Symmetry storage = system;
  static constexpr bool direct = true;

  void analyze(const SparseView& pattern) {
    mumps_ = detail::start_mumps(system);
    if (!mumps_) return;
    row_.clear();
    column_.clear();
    for (Index j = 0; j < pattern.size; ++j)
      for (Index k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        row_.push_back(pattern.row[k] + 1);
        column_.push_back(j + 1);
      }
    mumps_->n = pattern.size;
    mumps_->nnz = pattern.nonzeros();
    mumps_->irn = row_.data();
    mumps_->jcn = column_.data();
    if (!run(1)) mumps_.reset();
  }

  Factorization factorize(const SparseView& matrix) {
    if (!mumps_) return Factorization::failed;
    mumps_->a = const_cast<Real*>(matrix.values);  // read only, but MUMPS takes no pointer to const
    // Delayed pivots need more memory than the analysis estimated.
    bool done = run(2);
    for (int more = 0; !done && more < 8 && (mumps_->infog[0] == -8 || mumps_->infog[0] == -9); ++more) {
      mumps_->icntl[13] *= 2;
      done = run(2);
    }
    if (!done) return Factorization::failed;
    if constexpr (system == Symmetry::symmetric)
      if (negative_pivots() > 0) return Factorization::indefinite;
    return Factorization::done;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    std::copy_n(right_hand_side, mumps_->n, solution);
    mumps_->rhs = solution;
    return run(3);
  }

  /// Negative pivots of the last factorisation, as many as the matrix has negative eigenvalues.
  Index negative_pivots() const requires(system == Symmetry::symmetric) { return mumps_->infog[11]; }
  /// Memory of the last factor, including its indices [bytes].
  std::size_t factor_bytes() const {
    const auto count = [&](int k) {  // MUMPS's INFOG(k + 1), in millions if negative
      const Real value = mumps_->infog[k];
      return static_cast<std::size_t>(value < 0 ? -1e6 * value : value);
    };
    return count(8) * sizeof(Real) + count(9) * sizeof(MUMPS_INT);
  }

 private:
  bool run(MUMPS_INT job) {
    const OneBlasThread one;
    mumps_->job = job;
    dmumps_c(mumps_.get());
    const MUMPS_INT status = mumps_->infog[0];
    // Failed allocations (users' guide, error codes): reals of the analysis, integers, work space.
    if (status == -5 || status == -7 || status == -13) throw std::bad_alloc();
    return status >= 0;
  }

  std::vector<MUMPS_INT> row_, column_;  // counted from 1
  detail::MumpsInstance mumps_;          // destroyed before the arrays that it points to
};

using MumpsLdlt = MumpsSolver<Symmetry::symmetric>;
using MumpsLu = MumpsSolver<Symmetry::general>;

/// MUMPS for every system: its L D L^T for symmetric ones, its LU for the others.
struct Mumps {
  using Role = role::LinearSolver;
  template <Symmetry system>
  using For = MumpsSolver<system>;
};

}  // namespace stickslip
