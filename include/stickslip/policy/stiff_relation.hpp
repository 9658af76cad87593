// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/types.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace stickslip {

/// A relation so stiff that a small error of the displacements makes a large force: the pressure of a penalty and the
/// dilatation of an element. An iteration carries the quantity as a variable of its own, which follows its linear
/// solutions, and closes the relation only as it converges (theory.md, section 6.4). `n` components of displacement
/// enter.
template <class S, int n>
struct StiffRelation {
  S value = S(0);                        ///< of the variable
  S defect = S(0);                       ///< what the displacements ask for, less the value
  Vec<S, n> slope = Vec<S, n>::Zero();   ///< derivative of what the displacements ask for
  Vec<S, n> excess = Vec<S, n>::Zero();  ///< forces that closing the defect adds, to first order [force]

  /// Takes a defect for none that is no larger than the round-off of what the displacements ask for: the value has more
  /// digits then (theory.md, section 6.4).
  void forget(Real roundoff) {
    if (!(std::abs(value_of(defect)) <= roundoff)) return;
    defect = S(0);
    excess.setZero();
  }
};

/// The stiff relations of one kind in an iteration.
template <int n>
class StiffRelations {
 public:
  /// Weight of the forces of open defects in the merit of an iterate. They must count, for Newton's direction to be one
  /// of descent, but not at their stiffness, which is what is to be kept out.
  static constexpr Real softness = 0.05;

  explicit StiffRelations(std::size_t count = 0)
      : now_(count), converged_(count, 0.0), start_(count, 0.0), step_(count, 0.0) {}

  StiffRelation<Real, n>& operator[](std::size_t k) { return now_[k]; }
  const StiffRelation<Real, n>& operator[](std::size_t k) const { return now_[k]; }

  /// Begins an iteration at the values of the converged state.
  void begin() {
    for (std::size_t k = 0; k < now_.size(); ++k) now_[k].value = converged_[k];
  }
  /// Makes the present values the converged ones.
  void commit() {
    for (std::size_t k = 0; k < now_.size(); ++k) converged_[k] = now_[k].value;
  }
  /// Makes the value follow the change du of its displacements, and close a share of its defect.
  void follow(std::size_t k, const Vec<Real, n>& du, Real closing) {
    start_[k] = now_[k].value;
    step_[k] = closing * now_[k].defect + now_[k].slope.dot(du);
  }
  /// The value where the last `follow` leads.
  Real ahead(std::size_t k) const { return start_[k] + step_[k]; }
  /// Goes to a part of the changes of the last `follow`.
  void move(Real length) {
    for (std::size_t k = 0; k < now_.size(); ++k) now_[k].value = start_[k] + length * step_[k];
  }
  /// Share of the open defects in the square of the merit [force^2].
  Real openness() const {
    Real sum = 0;
    for (const auto& r : now_) sum += r.excess.squaredNorm();
    return softness * softness * sum;
  }

  /// The converged values.
  void serialize(Archive& archive, const std::string& name) { archive(name, converged_); }

 private:
  std::vector<StiffRelation<Real, n>> now_;
  std::vector<Real> converged_, start_, step_;
};

}  // namespace stickslip
