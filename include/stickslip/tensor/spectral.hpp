// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/tensor/tensor.hpp>

#include <cmath>
#include <type_traits>

namespace stickslip {

/// Principal values and directions of a symmetric tensor: t = sum_A values[A] n_A n_A^T, n_A = column A of
/// `directions`.
template <class S, class TensorPattern>
struct Spectral {
  Vec<S, 3> values;
  Tensor<S, TensorPattern> directions;
};

/// Closed form in the plane; the third direction is the normal. The smaller value comes from the determinant, so that
/// it keeps its digits in a nearly singular positive tensor. Equal values give the coordinate axes.
template <class S>
Spectral<S, Planar> spectral(const Tensor<S, Planar>& t) {
  using std::sqrt;
  const S mean = S(0.5) * (t(0, 0) + t(1, 1));
  const S half = S(0.5) * (t(0, 0) - t(1, 1));
  const S shear = t(0, 1);
  const S square = half * half + shear * shear;
  Spectral<S, Planar> r;
  r.values[2] = t(2, 2);
  r.directions(2, 2) = S(1);
  if (value_of(square) <= 0) {
    r.values[0] = t(0, 0);
    r.values[1] = t(1, 1);
    r.directions(0, 0) = r.directions(1, 1) = S(1);
    return r;
  }
  const S radius = sqrt(square);
  const S large = value_of(mean) >= 0 ? S(mean + radius) : S(mean - radius);
  const S small = (t(0, 0) * t(1, 1) - shear * shear) / large;
  r.values[0] = value_of(mean) >= 0 ? large : small;
  r.values[1] = value_of(mean) >= 0 ? small : large;
  // Half-angle formulas, in the form without cancellation.
  S c, s;
  if (value_of(half) >= 0) {
    c = sqrt(S(0.5) * (radius + half) / radius);
    s = shear / (S(2) * radius * c);
  } else {
    s = sqrt(S(0.5) * (radius - half) / radius);
    c = shear / (S(2) * radius * s);
  }
  r.directions(0, 0) = c;
  r.directions(1, 0) = s;
  r.directions(0, 1) = -s;
  r.directions(1, 1) = c;
  return r;
}

/// Cyclic Jacobi rotations (theory.md, eq. 3.27), without branches on the differences of the values. Equal values give
/// arbitrary axes of their plane, a diagonal tensor the coordinate axes. Derivatives by dual numbers are exact for
/// distinct values; for equal values those of the directions are zero, and those of the values remain correct in
/// functions that are symmetric in them.
template <class S>
Spectral<S, Spatial> spectral(const Tensor<S, Spatial>& t) {
  using std::sqrt;
  Spectral<S, Spatial> r;
  Vec<S, 3>& d = r.values;
  Tensor<S, Spatial>& n = r.directions;
  for (int k = 0; k < 3; ++k) d[k] = t(k, k);
  Vec<S, 3> shear;  // component k: between the other two axes
  shear[0] = t(1, 2);
  shear[1] = t(0, 2);
  shear[2] = t(0, 1);
  n = Tensor<S, Spatial>::identity();

  const auto sweep = [&] {
    for (int k = 2; k >= 0; --k) {
      const int p = (k + 1) % 3, q = (k + 2) % 3;
      const S difference = d[q] - d[p], twice = S(2) * shear[k];
      const S square = difference * difference + twice * twice;
      if (!(value_of(square) > 0)) continue;
      const S radius = sqrt(square);
      const S tangent = twice / (value_of(difference) >= 0 ? S(difference + radius) : S(difference - radius));
      const S c = S(1) / sqrt(S(1) + tangent * tangent), s = tangent * c;
      const S moved = tangent * shear[k];
      d[p] -= moved;
      d[q] += moved;
      shear[k] = S(0);
      const S at_p = shear[q], at_q = shear[p];  // between k and p, k and q
      shear[q] = c * at_p - s * at_q;
      shear[p] = s * at_p + c * at_q;
      for (int i = 0; i < 3; ++i) {
        const S x = n(i, p), y = n(i, q);
        n(i, p) = c * x - s * y;
        n(i, q) = s * x + c * y;
      }
    }
  };
  const auto diagonal = [&] {
    bool small = true;
    for (int k = 0; k < 3; ++k) {
      const Real off = value_of(shear[k]);
      small = small && off * off <= 1e-33 * std::abs(value_of(d[(k + 1) % 3]) * value_of(d[(k + 2) % 3]));
    }
    return small;
  };
  // Four sweeps suffice; the limit is for a tensor that is not finite.
  for (int sweeps = 0; sweeps < 16 && !diagonal(); ++sweeps) sweep();
  if constexpr (!std::is_same_v<S, Real>) sweep();  // propagates the derivatives
  return r;
}

/// Divided difference of the logarithm, (ln a - ln b) / (a - b) for a, b > 0, with its limit 1/b at a = b.
template <class S>
S log_difference(const S& a, const S& b) {
  using std::log1p;
  const S x = (a - b) / b;
  const Real size = std::abs(value_of(x));
  const S ratio =
      size < 1e-3 ? S(S(1) + x * (S(-1. / 2) + x * (S(1. / 3) + x * (S(-1. / 4) + x * (S(1. / 5) - x * S(1. / 6))))))
                  : S(log1p(x) / x);
  return ratio / b;
}

}  // namespace stickslip
