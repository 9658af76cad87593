// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <concepts>

namespace stickslip {

/// Sums and largest values over the whole of a vector, of which a process may hold a part. The solution procedure takes
/// them from here alone: a distributed run needs another space and no other Newton's method. Results are the same in
/// every process; a `part` is what a process has found in its own.
template <class S>
concept VectorSpace = std::default_initializable<S> && requires(const S& space, const Field& x, Real part) {
  { space.dot(x, x) } -> std::same_as<Real>;
  { space.norm(x) } -> std::same_as<Real>;
  { space.max(x) } -> std::same_as<Real>;  // largest magnitude; 0 of no entries
  { space.max(part) } -> std::same_as<Real>;
  { space.sum(part) } -> std::same_as<Real>;
};

/// The space of one process: loops over the entries.
struct SerialSpace {
  Real dot(const Field& x, const Field& y) const { return x.dot(y); }
  Real norm(const Field& x) const { return x.norm(); }
  Real max(const Field& x) const { return x.lpNorm<Eigen::Infinity>(); }
  Real max(Real part) const { return part; }
  Real sum(Real part) const { return part; }
};
static_assert(VectorSpace<SerialSpace>);

}  // namespace stickslip
