// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>
#include <cmath>
#include <utility>

namespace stickslip {

/// Non-zero components of a second-order tensor in plane strain and axisymmetry: an in-plane 2 x 2 block and the
/// component normal to the plane. Order: 11, 12, 21, 22, 33.
struct Planar {
  static constexpr int dim = 2;             ///< space dimension of the mesh
  static constexpr int size = 5;            ///< components of a general tensor
  static constexpr int symmetric_size = 4;  ///< components of a symmetric tensor, in the order 11, 22, 33, 12
  static constexpr int at(int i, int j) { return i == 2 ? 4 : 2 * i + j; }
  static constexpr std::array<std::pair<int, int>, size> pairs{{{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 2}}};
  static constexpr std::array<std::pair<int, int>, symmetric_size> symmetric_pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}}};
  static constexpr bool couples(int i, int j) { return (i == 2) == (j == 2); }
};

/// All nine components, row by row: 11, 12, 13, 21, 22, 23, 31, 32, 33.
struct Spatial {
  static constexpr int dim = 3;
  static constexpr int size = 9;
  static constexpr int symmetric_size = 6;  ///< in the order 11, 22, 33, 12, 23, 13
  static constexpr int at(int i, int j) { return 3 * i + j; }
  static constexpr std::array<std::pair<int, int>, size> pairs{
      {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {2, 2}}};
  static constexpr std::array<std::pair<int, int>, symmetric_size> symmetric_pairs{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  static constexpr bool couples(int, int) { return true; }
};

/// Second-order tensor with the non-zero pattern `TensorPattern`; `(i, j)` count from 0 to 2 and must be a pair of the
/// pattern.
template <class S, class TensorPattern>
struct Tensor {
  using Components = Vec<S, TensorPattern::size>;
  Components v = Components::Zero();

  static Tensor identity() {
    Tensor one;
    for (int i = 0; i < 3; ++i) one(i, i) = S(1);
    return one;
  }
  S& operator()(int i, int j) { return v[TensorPattern::at(i, j)]; }
  const S& operator()(int i, int j) const { return v[TensorPattern::at(i, j)]; }

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("v", self.v);
  }
};

/// Symmetric second-order tensor, each component stored once and unaligned: without padding in material states.
template <class S, class TensorPattern>
struct SymmetricTensor {
  using Components = Eigen::Matrix<S, TensorPattern::symmetric_size, 1, Eigen::DontAlign>;
  Components v = Components::Zero();

  static SymmetricTensor identity() {
    SymmetricTensor one;
    for (int i = 0; i < 3; ++i) one.v[i] = S(1);
    return one;
  }
  Tensor<S, TensorPattern> full() const {
    Tensor<S, TensorPattern> t;
    for (int a = 0; a < TensorPattern::symmetric_size; ++a) {
      const auto [i, j] = TensorPattern::symmetric_pairs[static_cast<std::size_t>(a)];
      t(i, j) = t(j, i) = v[a];
    }
    return t;
  }

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("v", self.v);
  }
};

/// Derivative of one tensor by another: `(a, b)` is d(component a) / d(component b) in the order of the `pairs`.
template <class S, class TensorPattern>
using Moduli = Mat<S, TensorPattern::size>;

template <class S>
S determinant(const Tensor<S, Planar>& t) {
  return (t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0)) * t(2, 2);
}

template <class S>
Tensor<S, Planar> inverse(const Tensor<S, Planar>& t) {
  const S in_plane = S(1) / (t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0));
  Tensor<S, Planar> r;
  r(0, 0) = t(1, 1) * in_plane;
  r(1, 1) = t(0, 0) * in_plane;
  r(0, 1) = -t(0, 1) * in_plane;
  r(1, 0) = -t(1, 0) * in_plane;
  r(2, 2) = S(1) / t(2, 2);
  return r;
}

/// 1 + t.
template <class S, class TensorPattern>
Tensor<S, TensorPattern> plus_one(Tensor<S, TensorPattern> t) {
  for (int i = 0; i < 3; ++i) t(i, i) += S(1);
  return t;
}

/// determinant(1 + t) - 1, without cancellation for small t.
template <class S>
S determinant_less_one(const Tensor<S, Planar>& t) {
  const S in_plane = t(0, 0) + t(1, 1) + (t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0));
  return in_plane + t(2, 2) + in_plane * t(2, 2);
}
template <class S>
S determinant_less_one(const Tensor<S, Spatial>& t) {
  const S minors = (t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0)) + (t(1, 1) * t(2, 2) - t(1, 2) * t(2, 1)) +
                   (t(0, 0) * t(2, 2) - t(0, 2) * t(2, 0));
  return t(0, 0) + t(1, 1) + t(2, 2) + minors + determinant(t);
}

/// Transpose of the cofactors: t adjugate(t) = determinant(t) 1.
template <class S>
Tensor<S, Planar> adjugate(const Tensor<S, Planar>& t) {
  Tensor<S, Planar> r;
  r(0, 0) = t(1, 1) * t(2, 2);
  r(1, 1) = t(0, 0) * t(2, 2);
  r(0, 1) = -t(0, 1) * t(2, 2);
  r(1, 0) = -t(1, 0) * t(2, 2);
  r(2, 2) = t(0, 0) * t(1, 1) - t(0, 1) * t(1, 0);
  return r;
}

template <class S>
Tensor<S, Spatial> adjugate(const Tensor<S, Spatial>& t) {
  Tensor<S, Spatial> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      r(i, j) = t(a, c) * t(b, d) - t(a, d) * t(b, c);
    }
  return r;
}

template <class S>
S determinant(const Tensor<S, Spatial>& t) {
  return t(0, 0) * (t(1, 1) * t(2, 2) - t(1, 2) * t(2, 1)) + t(0, 1) * (t(1, 2) * t(2, 0) - t(1, 0) * t(2, 2)) +
         t(0, 2) * (t(1, 0) * t(2, 1) - t(1, 1) * t(2, 0));
}

template <class S>
Tensor<S, Spatial> inverse(const Tensor<S, Spatial>& t) {
  Tensor<S, Spatial> r = adjugate(t);
  r.v *= S(S(1) / determinant(t));
  return r;
}

template <class S, class TensorPattern>
Tensor<S, TensorPattern> transpose(const Tensor<S, TensorPattern>& t) {
  Tensor<S, TensorPattern> r;
  for (const auto& [i, j] : TensorPattern::pairs) r(j, i) = t(i, j);
  return r;
}

/// a b, that is a_ik b_kj.
template <class S, class TensorPattern>
Tensor<S, TensorPattern> product(const Tensor<S, TensorPattern>& a, const Tensor<S, TensorPattern>& b) {
  Tensor<S, TensorPattern> r;
  for (const auto& [i, j] : TensorPattern::pairs)
    for (int k = 0; k < 3; ++k)
      if (TensorPattern::couples(i, k)) r(i, j) += a(i, k) * b(k, j);
  return r;
}

template <class S, class TensorPattern>
S trace(const Tensor<S, TensorPattern>& t) {
  return t(0, 0) + t(1, 1) + t(2, 2);
}

/// Kirchhoff stress tau = P F^T of the first Piola-Kirchhoff stress P (force per reference area; first index spatial).
template <class S, class TensorPattern>
Tensor<S, TensorPattern> kirchhoff(const Tensor<S, TensorPattern>& P, const Tensor<S, TensorPattern>& F) {
  return product(P, transpose(F));
}

/// von Mises equivalent of a symmetric stress.
template <class S, class TensorPattern>
S von_mises(const Tensor<S, TensorPattern>& stress) {
  using std::sqrt;
  const S mean = trace(stress) / S(3);
  S sum = S(0);
  for (const auto& [i, j] : TensorPattern::pairs) {
    const S d = stress(i, j) - (i == j ? mean : S(0));
    sum += d * d;
  }
  return sqrt(S(1.5) * sum);
}

}  // namespace stickslip
