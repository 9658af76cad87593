// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>
#include <stickslip/base/vector_space.hpp>

#include <cstddef>
#include <deque>

namespace stickslip {

/// Solves A x = b with a solver of a near matrix and products with A: the residual is the least over all
/// combinations of the steps tried, as in GMRES, in the order of ORTHODIR (Young & Jea 1980), which a residual that
/// does not fall cannot break down (theory.md, section 6.5). The caller makes a step of `next()` by the near solver,
/// and tells `add` what A makes of it.
template <VectorSpace Space = SerialSpace>
class Orthodir {
 public:
  /// Forgets the vectors of another size; they are made again when they are needed for the first time.
  void resize(Index size, const Space& space = {}) {
    space_ = space;
    size_ = size;
    count_ = 0;
    steps_.clear();
    responses_.clear();
  }
  /// Begins a solution with the right-hand side b.
  void begin(const Eigen::Ref<const Field>& b) {
    count_ = 0;
    residual_ = b;
    solution_.setZero(size_);
  }
  /// Steps taken in.
  Index count() const { return count_; }
  /// What the near solver is asked for next: b, then the part of the last response that was new.
  const Field& next() const { return count_ == 0 ? residual_ : responses_[static_cast<std::size_t>(count_ - 1)]; }
  /// Where to put the next step and what A makes of it, for `add`.
  Field& step() { return vector(steps_); }
  Field& response() { return vector(responses_); }
  /// Takes in `step()` and `response()`; false if the response is no new direction.
  bool add() {
    Field &z = step(), &w = response();
    const Real size = space_.norm(w);
    for (int sweep = 0; sweep < 2; ++sweep)  // once more, against what round-off leaves
      for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
        const Real share = space_.dot(responses_[i], w);
        w -= share * responses_[i];
        z -= share * steps_[i];
      }
    const Real left = space_.norm(w);
    if (!(left > 1e-14 * size)) return false;
    w /= left;
    z /= left;
    const Real share = space_.dot(w, residual_);
    residual_ -= share * w;
    solution_ += share * z;
    ++count_;
    return true;
  }
  const Field& residual() const { return residual_; }
  const Field& solution() const { return solution_; }

 private:
  Field& vector(std::deque<Field>& list) {
    while (static_cast<Index>(list.size()) <= count_) list.emplace_back(Field::Zero(size_));
    return list[static_cast<std::size_t>(count_)];
  }

  [[no_unique_address]] Space space_{};
  Index size_ = 0, count_ = 0;
  std::deque<Field> steps_, responses_;  // the responses orthonormal; references stay good as more come
  Field residual_, solution_;
};

}  // namespace stickslip
