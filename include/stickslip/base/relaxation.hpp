// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <algorithm>

namespace stickslip {

/// How far a pass follows what the last one found: Aitken's choice for vectors (Irons & Tuck 1969; theory.md,
/// eq. 5.30).
struct Relaxation {
  Real share = 1;

  void next(const Field& change) {
    if (before_.size() == change.size()) {
      const Field difference = change - before_;
      const Real square = difference.squaredNorm();
      if (square > 0) share = std::clamp(-share * before_.dot(difference) / square, Real(0.05), Real(2));
    }
    before_ = change;
  }
  /// Goes a quarter of the last way; false when that is next to nothing.
  bool hold_back() { return (share *= 0.25) > 1e-3; }

 private:
  Field before_;
};

}  // namespace stickslip
