// SPDX-License-Identifier: BSL-1.0
#include "solvers.hpp"

#include <doctest/doctest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
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

// Springs across pairs of a chain's nodes, askew, that bury its stiffness along them; and a free chain, whose rows sum
// to zero but for round-off.
const std::vector<Matrix> doubtful = [] {
  const auto askew = [](Real stiff) {
    return lower(n, [stiff](Index i, Index j) {
      const bool own = i == j && i < 20, across = i - j == 1 && j % 2 == 0 && j < 20;
      return stiffness(i, j) + (own ? stiff * (i % 2 == 0 ? 0.64 : 0.36) : across ? stiff * 0.48 : 0);
    });
  };
  const auto spring = [](Index k) { return k < 0 || k >= n - 1 ? 0 : 0.1 * (1 + k % 7); };
  const Matrix free = lower(n, [spring](Index i, Index j) {
    return i == j ? spring(i - 1) + spring(i) : i - j == 1 ? -spring(j) : 0;
  });
  return std::vector<Matrix>{askew(1e4), askew(1e8), askew(1e12), askew(1e18), askew(1e20), free};
}();

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
TEST_CASE("every solver solves positive matrices, and solves or refuses indefinite and singular ones by name") {
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
TEST_CASE("all direct solvers give the same verdict on ill-conditioned matrices") {
  for (const auto& entry : outcomes()) {
    if (iterative(entry.first)) continue;
    CAPTURE(entry.first);
    REQUIRE(entry.second.judged.size() == 6);
    for (std::size_t k = 0; k < 6; ++k) {
      CAPTURE(k);
      const Real condition = entry.second.judged[k].condition;
      CHECK((condition <= FactorDigits::limit) == (k < 3));
      if (k < 3) {  // of the same order by all of them, and that of the matrix
        CHECK(condition > 0.01 * std::pow(1e4, k + 1));
        CHECK(condition == doctest::Approx(outcomes().at("EigenLu").judged[k].condition).epsilon(k < 2 ? 1e-4 : 0.1));
      }
    }
  }
}
TEST_CASE("normal penalties of 1e12 to 1e20 times the body's stiffness are solved right by all solvers") {
  const auto& reference = outcomes().at("EigenLu");
  for (const auto& entry : outcomes()) {
    CAPTURE(entry.first);
    CHECK(difference(entry.second.stiff, reference.stiff) < 1e-8);
    for (const auto* runs : {&entry.second.normal, &entry.second.sliding})
      for (std::size_t k = 0; k < runs->size(); ++k) {
        CAPTURE(k);
        const Stiff& run = (*runs)[k];
        CHECK(run.end.message() == "completed");
        CHECK(difference(run.u, runs->front().u) < 1e-7);
        CHECK(difference(run.force, runs->front().force) < 1e-7);
      }
  }
}
TEST_CASE("a run at a tangential penalty of 1e9 to 1e20 times is right, or refused as digits_lost, by all solvers") {
  Index refused = 0;
  for (const auto& entry : outcomes()) {
    CAPTURE(entry.first);
    const auto& runs = entry.second.sticking;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      CAPTURE(k);
      if (runs[k].end) {
        CHECK(difference(runs[k].u, runs.front().u) < 1e-6);
        CHECK(difference(runs[k].force, runs.front().force) < 1e-6);
        continue;
      }
      ++refused;
      CHECK(k > 3);  // beyond 1e11 times
      CHECK(runs[k].end.failure.cause == FailureCause::digits_lost);
      CHECK(runs[k].end.detail.find("the tangential penalty of contact \"tool\"") != std::string::npos);
    }
  }
  CHECK(refused > 0);
}
TEST_CASE("all solvers that report negative pivots report the number of negative eigenvalues") {
  const auto count = [](const Matrix& m) {
    const Eigen::VectorXd all =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(m), Eigen::EigenvaluesOnly).eigenvalues();
    return Index((all.array() < 0).count());
  };
  CHECK(count(indefinite) > 3);
  for (const auto& entry : outcomes()) {
    CAPTURE(entry.first);
    const bool tells = symmetric(entry.first) && !iterative(entry.first);
    CHECK(entry.second.positive.negative_pivots == (tells ? 0 : -1));
    CHECK(entry.second.indefinite.negative_pivots == (tells ? count(indefinite) : -1));
  }
}

}  // namespace
}  // namespace solvers
