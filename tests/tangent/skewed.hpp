// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/material/hencky.hpp>

namespace element_check {

using namespace stickslip;

/// A material whose tangent has no symmetry: elements must not mirror it.
struct Skewed : Hencky {
  static constexpr Symmetry symmetry = Symmetry::general;
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old,
                                                                      Real dt) const {
    auto out = Hencky::respond(F, old, dt);
    // A follower-like stress that derives from no energy: P_11 += c F_22^2.
    out.P(0, 0) += S(young * 0.1) * F(1, 1) * F(1, 1);
    out.dP_dF(TensorPattern::at(0, 0), TensorPattern::at(1, 1)) += S(young * 0.2) * F(1, 1);
    return out;
  }
};

}  // namespace element_check
