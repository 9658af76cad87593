// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/base/symmetry.hpp>
#include <stickslip/dofs/evaluation.hpp>
#include <stickslip/dofs/sparse_matrix.hpp>

#include <concepts>
#include <tuple>

namespace stickslip {

/// A term of a user's own in the balance, beside bodies and contacts: `using Terms = TermTypes<Mine>;` in the model and
/// `.terms = {Mine{...}}` in the problem. Its forces count as internal. It may have unknowns of its own, which are no
/// node's: the components `first_unknown` and on of the fields. Besides the functions below it has
///
///     template <class Evaluation>
///     Failure evaluate(const Evaluation& ev, const IndexMap& dofs, Field& forces);
///
/// which adds forces and, where ev.want is not Want::residual, their derivative to ev.matrix, and keeps what it needs
/// as a trial until `commit`. `update` is called before every attempt at a step: true when its stencils have changed,
/// so that the pattern is made anew. `symmetry` is that of its derivative. The other functions are those of BodyOf.
template <class T>
concept Term = requires(T& term, const T& constant, SparsityPattern& pattern, const Field& u, Real real,
                        Archive& archive, Index first) {
  requires std::same_as<decltype(T::symmetry), const Symmetry>;
  { constant.unknowns() } -> std::same_as<Index>;
  {term.number(first)};
  { term.update(u, real) } -> std::same_as<bool>;
  {constant.couple(pattern)};
  {term.begin_iteration()};
  {term.predict(u, real)};
  {term.set_step(real)};
  { constant.constraint_merit() } -> std::same_as<Real>;
  {term.commit()};
  {term.serialize(archive)};
};

}  // namespace stickslip
