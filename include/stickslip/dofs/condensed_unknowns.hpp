// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/policy/condensed_unknown.hpp>
#include <stickslip/tensor/products.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace stickslip {

/// The condensed unknowns of one kind in an iteration: `m` at a place, on which `n` components of displacement act.
template <int n, int m = 1>
class CondensedUnknowns {
 public:
  using Unknown = CondensedUnknown<Real, n, m>;
  using Value = typename Unknown::Value;
  /// Weight of the constraint forces in the merit of an iterate. They must count, for Newton's direction to be one of
  /// descent, but not at the constraints' stiffness.
  static constexpr Real merit_weight = 0.05;

  explicit CondensedUnknowns(std::size_t count = 0)
      : now_(count),
        converged_(count, Unknown::zero()),
        start_(converged_),
        step_(converged_),
        increment_(converged_) {}

  Unknown& operator[](std::size_t k) { return now_[k]; }
  const Unknown& operator[](std::size_t k) const { return now_[k]; }
  /// The value of the converged state.
  const Value& converged(std::size_t k) const { return converged_[k]; }

  /// Begins an iteration at the values of the converged state.
  void begin() {
    for (std::size_t k = 0; k < now_.size(); ++k) begin(k);
  }
  void begin(std::size_t k) { now_[k].value = converged_[k]; }
  /// Adds `share` of the last increment of the converged values, as displacements that are extrapolated do.
  void extrapolate(Real share) {
    for (std::size_t k = 0; k < now_.size(); ++k) now_[k].value += share * increment_[k];
  }
  /// Makes the present values the converged ones.
  void commit() {
    for (std::size_t k = 0; k < now_.size(); ++k) {
      increment_[k] = now_[k].value - converged_[k];
      converged_[k] = now_[k].value;
    }
  }
  /// Predicts the value after the change du of its displacements, with a fraction of its constraint residual closed.
  void predict(std::size_t k, const Vec<Real, n>& du, Real fraction) {
    start_[k] = now_[k].value;
    if constexpr (m == 1)
      step_[k] = fraction * now_[k].residual + now_[k].gradient.dot(du);
    else
      step_[k] = fraction * now_[k].residual + Vec<Real, m>(transposed_product(now_[k].gradient, du));
  }
  /// The value at the full length of the last `predict`.
  Value predicted(std::size_t k) const { return start_[k] + step_[k]; }
  /// Takes a part of the change of the last `predict`.
  void set_step(Real length) {
    for (std::size_t k = 0; k < now_.size(); ++k) now_[k].value = start_[k] + length * step_[k];
  }
  /// Part of the constraint forces in the square of the merit [force^2].
  Real constraint_merit() const {
    Real sum = 0;
    for (const auto& r : now_) sum += r.force.squaredNorm();
    return merit_weight * merit_weight * sum;
  }

  /// The converged values.
  void serialize(Archive& archive, const std::string& name) {
    archive(name, converged_);
    archive(name + ", last increment", increment_);
  }

 private:
  std::vector<Unknown> now_;
  std::vector<Value> converged_, start_, step_, increment_;
};

/// Of a term that has none.
template <int n>
class CondensedUnknowns<n, 0> {
 public:
  explicit CondensedUnknowns(std::size_t = 0) {}
  void begin() {}
  void extrapolate(Real) {}
  void commit() {}
  void set_step(Real) {}
  Real constraint_merit() const { return 0; }
  void serialize(Archive&, const std::string&) {}
};

}  // namespace stickslip
