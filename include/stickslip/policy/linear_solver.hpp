// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// Dyads that a symmetric matrix lacks to the whole: the couplings of sliding nodes. Dyad k is the column `left` times
/// the row `right`, whose entries start[k] to start[k + 1] belong to `equation`, negative where that is constrained.
struct Dyads {
  Index count = 0;
  const Index* start = nullptr;  ///< count + 1 entries
  const Index* equation = nullptr;
  const Real* left = nullptr;
  const Real* right = nullptr;
};

/// Compressed columns of a square matrix, rows ascending. A symmetric one holds its lower triangle only. `values` may
/// be null where the pattern alone matters.
struct SparseView {
  Index size = 0;
  const Index* column_start = nullptr;  ///< size + 1 entries
  const Index* row = nullptr;
  const Real* values = nullptr;
  Symmetry symmetry = Symmetry::general;
  Dyads corrections{};  ///< still to be added; only for solvers that say `corrects`

  Index nonzeros() const { return column_start[size]; }
};

/// How a factorisation went.
enum class Factorization {
  done,
  indefinite,  ///< done, of a symmetric matrix that is not positive definite; the fallback, if any, has been taken
  failed,      ///< no factor exists: singular to working precision
};

/// Parameters of a solver that has none.
struct NoSolverParameters {};

namespace detail {
template <class L>
struct ParametersOfSolver {
  using type = NoSolverParameters;
};
template <class L>
  requires requires {
    typename L::Parameters;
  }
struct ParametersOfSolver<L> {
  using type = typename L::Parameters;
};
}  // namespace detail

/// What a solver is made from: its nested aggregate `Parameters`, or nothing.
template <class L>
using SolverParameters = typename detail::ParametersOfSolver<L>::type;

/// The solver of these parameters.
template <class L>
L make_solver([[maybe_unused]] const SolverParameters<L>& parameters) {
  if constexpr (std::same_as<SolverParameters<L>, NoSolverParameters>)
    return L();
  else
    return L(parameters);
}

/// A direct or iterative solver of the linear systems of Newton's method. `analyze` sees the pattern once and stands
/// while the pattern does; it and `factorize` throw std::bad_alloc where memory does not suffice. `accepts` is the
/// widest symmetry of a system that it can solve, `storage` that of the matrices it wants to be handed. It is made from
/// its SolverParameters, and throws std::invalid_argument there if they are none that it can take.
/// docs/policies.md, section Linear solver.
template <class L>
concept LinearSolverPolicy = requires(L& solver, const SparseView& matrix, const Real* right_hand_side,
                                      Real* solution) {
  requires std::same_as<typename L::Role, role::LinearSolver>;
  requires std::same_as<decltype(L::accepts), const Symmetry>;
  requires std::same_as<decltype(L::storage), const Symmetry>;
  requires std::same_as<SolverParameters<L>, NoSolverParameters> || std::constructible_from < L,
      const SolverParameters<L>
  & > ;
  {solver.analyze(matrix)};
  { solver.factorize(matrix) } -> std::same_as<Factorization>;
  { solver.solve(right_hand_side, solution) } -> std::same_as<bool>;
};

/// Whether a solver keeps a factor, so that another solution costs a fraction of the factorisation: it says `direct`.
/// It is asked what digits the matrix leaves then.
template <class L>
inline constexpr bool is_direct = requires {
  requires L::direct;
};

/// Whether a solver takes a general system as a symmetric matrix and the dyads that it lacks.
template <class L>
inline constexpr bool accepts_couplings = requires {
  requires L::corrects;
};

/// A choice that depends on the system: `For<Symmetry>` names the solver.
template <class L>
concept LinearSolverFamily = requires {
  requires std::same_as<typename L::Role, role::LinearSolver>;
  requires LinearSolverPolicy<typename L::template For<Symmetry::symmetric>>;
  requires LinearSolverPolicy<typename L::template For<Symmetry::general>>;
};

}  // namespace stickslip
