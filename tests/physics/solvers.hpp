// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/solve/factor_digits.hpp>

#include <cmath>
#include <limits>
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
  Index negative_pivots = -1;  ///< where it tells
  Real condition = -1;         ///< as Newton's method would estimate it; infinite without a solution
};
struct Matrix {
  std::vector<Index> start, row;
  std::vector<Real> values;
  Symmetry symmetry;
  SparseView view() const {
    return {static_cast<Index>(start.size()) - 1, start.data(), row.data(), values.data(), symmetry};
  }
};

/// A run at stiff penalties.
struct Stiff {
  stickslip::Outcome end;
  std::vector<Real> u, force;  ///< of its end
};

/// What every solver is put through: end displacements of a press-and-drag run, answers to single matrices.
struct Outcome {
  std::vector<Real> coulomb, quasi;  ///< empty where the solver does not take the system
  Answer positive, indefinite, singular;
  Answer again;  ///< to `positive`, after the other two with the same analysis, while another solver lives
  std::vector<Answer> judged;  ///< to `doubtful`
  std::vector<Real> stiff;     ///< end displacements of the run at penalties of 1e9 times the body's stiffness
  /// The same run at 1e12 to 1e20 times, with friction and without, and at tangential ones of 1e9 to 1e20 times, on
  /// meshes each of which has another round-off.
  std::vector<Stiff> normal{}, sliding{}, sticking{};
};
extern const Matrix positive, indefinite, singular;  // the lower triangles
extern const std::vector<Matrix> doubtful;           // singular to round-off, and nearly so
Matrix both_triangles(const Matrix& lower);
std::vector<Real> right_hand_side(const Matrix& m);

Outcome eigen_ldlt();
Outcome eigen_lu();
Outcome cholmod();
Outcome umfpack();
Outcome banded_cholesky();
Outcome banded_lu();
Outcome mumps_ldlt();
Outcome mumps_lu();
Outcome conjugate_gradients();
Outcome bicgstab();

template <class Solver>
Matrix stored(const Matrix& lower) {
  return Solver::storage == Symmetry::symmetric ? lower : both_triangles(lower);
}
/// By a solver that has analysed the pattern.
template <class Solver>
Answer answer(Solver& solver, const Matrix& m) {
  Answer a{solver.factorize(m.view()), false, std::vector<Real>(std::size_t(m.view().size))};
  if constexpr (requires { solver.negative_pivots(); })
    if (a.factorization != Factorization::failed) a.negative_pivots = solver.negative_pivots();
  if constexpr (is_direct<Solver>) {
    FactorDigits digits;
    digits.resize(m.view().size);
    a.condition = a.factorization == Factorization::failed
                      ? std::numeric_limits<Real>::infinity()
                      : digits.condition(m.view(), SerialSpace{},
                                         [&](const Field& b, Field& x) { return solver.solve(b.data(), x.data()); });
  }
  if (a.factorization != Factorization::failed) a.solved = solver.solve(right_hand_side(m).data(), a.x.data());
  return a;
}
template <class Solver>
Answer answer(const Matrix& lower) {
  Solver solver;
  const Matrix m = stored<Solver>(lower);
  solver.analyze(m.view());
  return answer(solver, m);
}
/// One analysis, three factorisations of the pattern; another solver works on another matrix in between.
template <class Solver>
Answer answer_again() {
  Solver solver, other;
  const Matrix m = stored<Solver>(positive), shifted = stored<Solver>(indefinite), small = stored<Solver>(singular);
  solver.analyze(m.view());
  other.analyze(small.view());
  answer(solver, m);
  answer(other, small);
  answer(solver, shifted);
  Answer a{solver.factorize(m.view()), false, std::vector<Real>(std::size_t(m.view().size))};
  answer(other, small);
  if (a.factorization != Factorization::failed) a.solved = solver.solve(right_hand_side(m).data(), a.x.data());
  return a;
}

}  // namespace solvers
