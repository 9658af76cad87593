// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <doctest/doctest.h>
#include <Eigen/LU>

#include <utility>
#include <vector>

namespace solvers {

namespace {
// Lower triangle of a matrix given by its entries.
template <class Entry>
Matrix lower(Index n, Entry&& entry) {
  Matrix m{{0}, {}, {}, Symmetry::symmetric};
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i)
      if (const Real v = entry(i, j); v != 0) {
        m.row.push_back(i);
        m.values.push_back(v);
      }
    m.start.push_back(Index(m.row.size()));
  }
  return m;
}
constexpr Index n = 40;
Real stiffness(Index i, Index j) {
  return i == j ? 4.1 + 0.1 * (i % 3) : i - j == 1 || i - j == 7 ? -1.0 : 0.0;
}
Eigen::MatrixXd dense(const Matrix& m) {
  const SparseView v = m.view();
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(v.size, v.size);
  for (Index j = 0; j < v.size; ++j)
    for (Index k = v.column_start[j]; k < v.column_start[j + 1]; ++k) d(v.row[k], j) = d(j, v.row[k]) = v.values[k];
  return d;
}
}  // namespace

const Matrix positive = lower(n, stiffness);
// Shifted so that a good part of the eigenvalues is negative.
const Matrix indefinite = lower(n, [](Index i, Index j) { return stiffness(i, j) - (i == j ? 3.3 : 0.0); });
// Pairs of equal rows, exact in any order of elimination.
const Matrix singular =
    lower(n, [](Index i, Index j) { return i == j || (i - j == 1 && j % 2 == 0 && j < 20) ? 1.0 : 0.0; });

Matrix both_triangles(const Matrix& m) {
  const SparseView v = m.view();
  // By columns; what is mirrored to one comes before its own, so that rows ascend.
  std::vector<std::vector<std::pair<Index, Real>>> columns(std::size_t(v.size));
  for (Index j = 0; j < v.size; ++j)
    for (Index k = v.column_start[j]; k < v.column_start[j + 1]; ++k) {
      const Index i = v.row[k];
      columns[std::size_t(j)].push_back({i, v.values[k]});
      if (i != j) columns[std::size_t(i)].push_back({j, v.values[k]});
    }
  Matrix full{{0}, {}, {}, Symmetry::general};
  for (const auto& column : columns) {
    for (const auto& [row, value] : column) {
      full.row.push_back(row);
      full.values.push_back(value);
    }
    full.start.push_back(Index(full.row.size()));
  }
  return full;
}

std::vector<Real> right_hand_side(const Matrix& m) {
  std::vector<Real> b;
  for (Index i = 0; i < m.view().size; ++i) b.push_back(std::sin(1.0 + i));
  return b;
}

namespace {

const std::map<std::string, Outcome>& outcomes() {
  static const std::map<std::string, Outcome> all{{"EigenLdlt", eigen_ldlt()},
                                                  {"EigenLu", eigen_lu()},
                                                  {"Cholmod", cholmod()},
                                                  {"Umfpack", umfpack()},
                                                  {"BandedCholesky", banded_cholesky()},
                                                  {"BandedLu", banded_lu()},
                                                  {"MumpsLdlt", mumps_ldlt()},
                                                  {"MumpsLu", mumps_lu()},
                                                  {"ConjugateGradients", conjugate_gradients()},
                                                  {"Bicgstab", bicgstab()}};
  return all;
}
bool symmetric(const std::string& name) {
  return name == "EigenLdlt" || name == "Cholmod" || name == "BandedCholesky" || name == "MumpsLdlt" ||
         name == "ConjugateGradients";
}
// These have no factor to tell a singular or an indefinite matrix by: they refuse in the solution.
bool iterative(const std::string& name) {
  return name == "ConjugateGradients" || name == "Bicgstab";
}

Real difference(const std::vector<Real>& a, const std::vector<Real>& b) {
  if (a.size() != b.size() || a.empty()) return 1e300;
  const Eigen::Map<const Eigen::VectorXd> x(a.data(), Index(a.size())), y(b.data(), Index(b.size()));
  return (x - y).norm() / y.norm();
}
void check_solution(const Answer& a, const Matrix& m) {
  CHECK(a.solved);
  const std::vector<Real> b = right_hand_side(m);
  const Eigen::VectorXd exact = dense(m).fullPivLu().solve(Eigen::Map<const Eigen::VectorXd>(b.data(), n));
  CHECK(difference(a.x, {exact.begin(), exact.end()}) < 1e-9);
}

TEST_CASE("all solvers agree on a run of press and drag") {
  const auto& reference = outcomes().at("EigenLu");
  for (const auto& entry : outcomes()) {
    const std::string& name = entry.first;
    const Outcome& o = entry.second;
    CAPTURE(name);
    CHECK(difference(o.quasi, reference.quasi) < 1e-9);
    if (!symmetric(name)) CHECK(difference(o.coulomb, reference.coulomb) < 1e-9);
  }
  CHECK(difference(reference.quasi, reference.coulomb) > 1e-4);  // two laws
}
TEST_CASE("positive, indefinite and singular matrices") {
  for (const auto& entry : outcomes()) {
    const std::string& name = entry.first;
    const Outcome& o = entry.second;
    CAPTURE(name);
    CHECK(o.positive.factorization == Factorization::done);
    check_solution(o.positive, positive);
    if (name == "ConjugateGradients") {
      CHECK_FALSE(o.indefinite.solved);
    } else {
      CHECK(o.indefinite.factorization == (symmetric(name) ? Factorization::indefinite : Factorization::done));
      check_solution(o.indefinite, indefinite);
    }
    CHECK_FALSE(o.singular.solved);
    if (!iterative(name)) CHECK(o.singular.factorization == Factorization::failed);
    CHECK(o.again.factorization == Factorization::done);
    check_solution(o.again, positive);
  }
}

}  // namespace
}  // namespace solvers
