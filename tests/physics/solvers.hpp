// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/linear_solver.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace solvers {

using namespace stickslip;

/// How a solver did on a matrix.
struct Answer {
  Factorization factorization;
  bool solved;
  std::vector<Real> x;
};
struct Matrix {
  std::vector<Index> start, row;
  std::vector<Real> values;
  Symmetry symmetry;
  SparseView view() const {
    return {static_cast<Index>(start.size()) - 1, start.data(), row.data(), values.data(), symmetry};
  }
};

/// What every solver is put through: end displacements of a press-and-drag run, answers to single matrices.
struct Outcome {
  std::vector<Real> coulomb, quasi;  ///< empty where the solver does not take the system
  Answer positive, indefinite, singular;
};
extern const Matrix positive, indefinite, singular;  // the lower triangles
Matrix both_triangles(const Matrix& lower);

Outcome eigen_ldlt();
Outcome eigen_lu();
Outcome cholmod();
Outcome umfpack();
Outcome banded_cholesky();
Outcome banded_lu();

template <class Solver>
Answer answer(const Matrix& lower) {
  Solver solver;
  const Matrix m = Solver::storage == Symmetry::symmetric ? lower : both_triangles(lower);
  solver.analyze(m.view());
  Answer a{solver.factorize(m.view()), false, std::vector<Real>(std::size_t(m.view().size))};
  std::vector<Real> b;
  for (std::size_t i = 0; i < a.x.size(); ++i) b.push_back(std::sin(1.0 + double(i)));
  if (a.factorization != Factorization::failed) a.solved = solver.solve(b.data(), a.x.data());
  return a;
}

}  // namespace solvers
