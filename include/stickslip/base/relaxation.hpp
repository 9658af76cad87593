// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>
#include <stickslip/base/vector_space.hpp>

#include <algorithm>

namespace stickslip {

/// Aitken's relaxation factor omega of a vector iteration (Irons & Tuck 1969; theory.md, eq. 5.32): the part of the
/// last change that the next iterate takes.
struct Relaxation {
  Real omega = 1;

  /// Takes the change that the last iterate asks for. Allocates at the first one only.
  template <VectorSpace Space = SerialSpace>
  void next(const Field& change, const Space& space = {}) {
    if (known_) {
      difference_ = change - before_;
      const Real square = space.dot(difference_, difference_);
      if (square > 0) omega = std::clamp(-omega * space.dot(before_, difference_) / square, Real(0.05), Real(2));
    } else {
      difference_.resize(change.size());
    }
    before_ = change;
    known_ = true;
  }
  /// Forgets the changes so far; omega is 1 again.
  void restart() {
    omega = 1;
    known_ = false;
  }
  /// Takes a quarter of the last step; false when less than a thousandth is left.
  bool backtrack() { return (omega *= 0.25) > 1e-3; }

 private:
  Field before_, difference_;
  bool known_ = false;
};

}  // namespace stickslip
