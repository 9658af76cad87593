// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/linear_solver/one_blas_thread.hpp>
#include <stickslip/policy/linear_solver.hpp>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <vector>

extern "C" {
void dpbtrf_(const char* uplo, const int* n, const int* kd, double* ab, const int* ldab, int* info, std::size_t);
void dpbtrs_(const char* uplo, const int* n, const int* kd, const int* nrhs, const double* ab, const int* ldab,
             double* b, const int* ldb, int* info, std::size_t);
void dgbtrf_(const int* m, const int* n, const int* kl, const int* ku, double* ab, const int* ldab, int* ipiv,
             int* info);
void dgbtrs_(const char* trans, const int* n, const int* kl, const int* ku, const int* nrhs, const double* ab,
             const int* ldab, const int* ipiv, double* b, const int* ldb, int* info, std::size_t);
}

namespace stickslip {

/// Parameters of the banded solvers.
struct BandedParameters {
  bool reorder = true;  ///< look for a numbering of smaller bandwidth; else the mesh's is taken
};

namespace detail {

/// New number of every equation, and the resulting half bandwidth.
struct BandOrdering {
  std::vector<Index> place;
  Index half_bandwidth = 0;
};

/// The given numbering or, where `reorder`, reverse Cuthill-McKee if it has the smaller bandwidth.
inline BandOrdering band_ordering(const SparseView& m, bool reorder) {
  const auto bandwidth = [&](const std::vector<Index>& place) {
    Index widest = 0;
    for (Index j = 0; j < m.size; ++j)
      for (Index k = m.column_start[j]; k < m.column_start[j + 1]; ++k)
        widest =
            std::max(widest, std::abs(place[static_cast<std::size_t>(m.row[k])] - place[static_cast<std::size_t>(j)]));
    return widest;
  };
  BandOrdering natural;
  for (Index i = 0; i < m.size; ++i) natural.place.push_back(i);
  natural.half_bandwidth = bandwidth(natural.place);
  if (!reorder) return natural;

  using Graph = boost::adjacency_list<
      boost::vecS, boost::vecS, boost::undirectedS,
      boost::property<boost::vertex_color_t, boost::default_color_type, boost::property<boost::vertex_degree_t, int>>>;
  Graph graph(static_cast<std::size_t>(m.size));
  for (Index j = 0; j < m.size; ++j)
    for (Index k = m.column_start[j]; k < m.column_start[j + 1]; ++k)
      if (m.row[k] > j) boost::add_edge(static_cast<std::size_t>(m.row[k]), static_cast<std::size_t>(j), graph);
  std::vector<std::size_t> order;
  boost::cuthill_mckee_ordering(graph, std::back_inserter(order), boost::get(boost::vertex_color, graph),
                                boost::make_degree_map(graph));
  BandOrdering reduced;
  reduced.place.resize(static_cast<std::size_t>(m.size));
  for (std::size_t i = 0; i < order.size(); ++i) reduced.place[order[i]] = m.size - 1 - static_cast<Index>(i);
  reduced.half_bandwidth = bandwidth(reduced.place);
  return reduced.half_bandwidth < natural.half_bandwidth ? reduced : natural;
}

/// LAPACK's banded LU with partial pivoting.
class BandLu {
 public:
  void resize(Index n, Index half_bandwidth) {
    n_ = n;
    k_ = half_bandwidth;
    band_.assign(static_cast<std::size_t>(rows()) * static_cast<std::size_t>(n), 0.0);
    pivots_.assign(static_cast<std::size_t>(n), 0);
  }
  void set_zero() { std::fill(band_.begin(), band_.end(), 0.0); }
  Real& at(Index row, Index column) {
    return band_[static_cast<std::size_t>(2 * k_ + row - column) +
                 static_cast<std::size_t>(rows()) * static_cast<std::size_t>(column)];
  }
  bool factorize() {
    const OneBlasThread single;
    int info = 0;
    const int ld = rows();
    dgbtrf_(&n_, &n_, &k_, &k_, band_.data(), &ld, pivots_.data(), &info);
    return info == 0;
  }
  bool solve(Real* x) const {
    const OneBlasThread single;
    int info = 0;
    const int ld = rows(), one = 1;
    dgbtrs_("N", &n_, &k_, &k_, &one, band_.data(), &ld, pivots_.data(), x, &n_, &info, 1);
    return info == 0;
  }
  std::size_t bytes() const { return band_.size() * sizeof(Real) + pivots_.size() * sizeof(int); }

 private:
  int rows() const { return 3 * k_ + 1; }
  Index n_ = 0, k_ = 0;
  std::vector<Real> band_;
  std::vector<int> pivots_;
};

}  // namespace detail

/// LAPACK's banded Cholesky in a numbering of small bandwidth: the fastest solver on thin meshes. An indefinite matrix
/// falls back to the banded LU with pivoting. Link stickslip::banded.
class BandedCholesky {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;
  static constexpr bool direct = true;
  using Parameters = BandedParameters;

  BandedCholesky() : BandedCholesky(Parameters{}) {}
  explicit BandedCholesky(const Parameters& parameters) : parameters_(parameters) {}

  void analyze(const SparseView& pattern) {
    order_ = detail::band_ordering(pattern, parameters_.reorder);
    n_ = pattern.size;
    k_ = order_.half_bandwidth;
    band_.assign(static_cast<std::size_t>(k_ + 1) * static_cast<std::size_t>(n_), 0.0);
    permuted_.resize(static_cast<std::size_t>(n_));
    slots_.clear();
    for_each(pattern, [&](Index row, Index column, Index) {
      slots_.push_back(static_cast<std::size_t>(std::abs(row - column)) +
                       static_cast<std::size_t>(k_ + 1) * static_cast<std::size_t>(std::min(row, column)));
    });
    lu_ready_ = false;
  }

  Factorization factorize(const SparseView& matrix) {
    const OneBlasThread single;
    fill(matrix);
    const int ld = k_ + 1;
    int info = 0;
    dpbtrf_("L", &n_, &k_, band_.data(), &ld, &info, 1);
    indefinite_ = info != 0;
    negative_pivots_ = 0;
    if (!indefinite_) return Factorization::done;
    negative_pivots_ = count_negative(matrix);
    if (!lu_ready_) lu_.resize(n_, k_);
    lu_ready_ = true;
    lu_.set_zero();
    for_each(matrix,
             [&](Index row, Index column, Index e) { lu_.at(row, column) = lu_.at(column, row) = matrix.values[e]; });
    return lu_.factorize() ? Factorization::indefinite : Factorization::failed;
  }

  bool solve(const Real* right_hand_side, Real* solution) {
    for (std::size_t i = 0; i < permuted_.size(); ++i)
      permuted_[static_cast<std::size_t>(order_.place[i])] = right_hand_side[i];
    const OneBlasThread single;
    int info = 0;
    const int ld = k_ + 1, one = 1;
    if (indefinite_)
      info = lu_.solve(permuted_.data()) ? 0 : 1;
    else
      dpbtrs_("L", &n_, &k_, &one, band_.data(), &ld, permuted_.data(), &n_, &info, 1);
    for (std::size_t i = 0; i < permuted_.size(); ++i)
      solution[i] = permuted_[static_cast<std::size_t>(order_.place[i])];
    return info == 0;
  }

  /// Negative pivots of the last factorisation, as many as the matrix has negative eigenvalues.
  Index negative_pivots() const { return negative_pivots_; }
  Index half_bandwidth() const { return k_; }
  /// Memory of the Cholesky factor, and of the LU once a matrix was indefinite [bytes].
  std::size_t factor_bytes() const { return band_.size() * sizeof(Real) + lu_.bytes(); }

 private:
  // The signs of the LU's pivots do not give the number of negative eigenvalues; those of a banded L D L^T without
  // pivoting do. It overwrites the band of the failed Cholesky.
  Index count_negative(const SparseView& matrix) {
    fill(matrix);
    const auto k = static_cast<std::size_t>(k_), n = static_cast<std::size_t>(n_);
    Index count = 0;
    for (std::size_t j = 0; j < n; ++j) {
      Real* const column = band_.data() + j * (k + 1);
      const Real pivot = column[0];
      if (pivot < 0) ++count;
      if (pivot == 0) continue;
      const std::size_t below = std::min(k, n - 1 - j);
      for (std::size_t a = 1; a <= below; ++a) {
        const Real factor = column[a] / pivot;
        if (factor == 0) continue;
        Real* const other = band_.data() + (j + a) * (k + 1);
        for (std::size_t b = a; b <= below; ++b) other[b - a] -= factor * column[b];
      }
    }
    return count;
  }
  void fill(const SparseView& matrix) {
    std::fill(band_.begin(), band_.end(), 0.0);
    for (std::size_t e = 0; e < slots_.size(); ++e) band_[slots_[e]] = matrix.values[e];
  }
  template <class Visit>
  void for_each(const SparseView& m, Visit&& visit) const {
    for (Index j = 0; j < m.size; ++j)
      for (Index e = m.column_start[j]; e < m.column_start[j + 1]; ++e)
        visit(order_.place[static_cast<std::size_t>(m.row[e])], order_.place[static_cast<std::size_t>(j)], e);
  }

  BandedParameters parameters_;
  detail::BandOrdering order_;
  Index n_ = 0, k_ = 0, negative_pivots_ = 0;
  std::vector<Real> band_, permuted_;
  std::vector<std::size_t> slots_;
  detail::BandLu lu_;
  bool indefinite_ = false, lu_ready_ = false;
};

/// LAPACK's banded LU with pivoting, in a numbering of small bandwidth. Accepts every system. Link stickslip::banded.
class BandedLu {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::general;
  static constexpr bool direct = true;
  using Parameters = BandedParameters;

  BandedLu() : BandedLu(Parameters{}) {}
  explicit BandedLu(const Parameters& parameters) : parameters_(parameters) {}

  void analyze(const SparseView& pattern) {
    order_ = detail::band_ordering(pattern, parameters_.reorder);
    lu_.resize(pattern.size, order_.half_bandwidth);
    permuted_.resize(static_cast<std::size_t>(pattern.size));
  }
  Factorization factorize(const SparseView& m) {
    lu_.set_zero();
    for (Index j = 0; j < m.size; ++j)
      for (Index e = m.column_start[j]; e < m.column_start[j + 1]; ++e)
        lu_.at(order_.place[static_cast<std::size_t>(m.row[e])], order_.place[static_cast<std::size_t>(j)]) =
            m.values[e];
    return lu_.factorize() ? Factorization::done : Factorization::failed;
  }
  bool solve(const Real* right_hand_side, Real* solution) {
    for (std::size_t i = 0; i < permuted_.size(); ++i)
      permuted_[static_cast<std::size_t>(order_.place[i])] = right_hand_side[i];
    if (!lu_.solve(permuted_.data())) return false;
    for (std::size_t i = 0; i < permuted_.size(); ++i)
      solution[i] = permuted_[static_cast<std::size_t>(order_.place[i])];
    return true;
  }

  Index half_bandwidth() const { return order_.half_bandwidth; }
  /// Memory of the factor, including the pivots [bytes].
  std::size_t factor_bytes() const { return lu_.bytes(); }

 private:
  BandedParameters parameters_;
  detail::BandOrdering order_;
  detail::BandLu lu_;
  std::vector<Real> permuted_;
};

/// Banded Cholesky for symmetric systems, banded LU for the others.
struct Banded {
  using Role = role::LinearSolver;
  template <Symmetry system>
  using For = std::conditional_t<system == Symmetry::symmetric, BandedCholesky, BandedLu>;
};

}  // namespace stickslip
