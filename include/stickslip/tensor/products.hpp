// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>

/// Sums and products of small vectors and matrices as loops. Each Eigen expression is a separate class, which costs
/// twenty milliseconds of compile time: too much for code that every model instantiates again.
namespace stickslip {

/// to += factor a.
template <class S, int rows, int columns>
void add(Mat<S, rows, columns>& to, const Mat<S, rows, columns>& a, const S& factor = S(1)) {
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) to(i, j) += factor * a(i, j);
}

/// a - b.
template <class S, int rows, int columns>
Mat<S, rows, columns> minus(const Mat<S, rows, columns>& a, const Mat<S, rows, columns>& b) {
  Mat<S, rows, columns> r;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) r(i, j) = a(i, j) - b(i, j);
  return r;
}

/// a factor.
template <class S, int rows, int columns>
Mat<S, rows, columns> scaled(const Mat<S, rows, columns>& a, const S& factor) {
  Mat<S, rows, columns> r;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) r(i, j) = a(i, j) * factor;
  return r;
}

/// Whether no component is infinite or not a number.
template <int rows, int columns>
bool is_finite(const Mat<Real, rows, columns>& a) {
  bool finite = true;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) finite = finite && std::isfinite(a(i, j));
  return finite;
}

/// value I.
template <int n, class S>
Mat<S, n> isotropic(const S& value) {
  Mat<S, n> r;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) r(i, j) = i == j ? value : S(0);
  return r;
}

/// a b.
template <class S, int rows, int inner, int columns>
Mat<S, rows, columns> product(const Mat<S, rows, inner>& a, const Mat<S, inner, columns>& b) {
  Mat<S, rows, columns> r;
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < rows; ++i) r(i, j) = a(i, 0) * b(0, j);
    for (int k = 1; k < inner; ++k)
      for (int i = 0; i < rows; ++i) r(i, j) += a(i, k) * b(k, j);
  }
  return r;
}

/// a^T b.
template <class S, int rows, int inner, int columns>
Mat<S, rows, columns> transposed_product(const Mat<S, inner, rows>& a, const Mat<S, inner, columns>& b) {
  Mat<S, rows, columns> r;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) {
      r(i, j) = a(0, i) * b(0, j);
      for (int k = 1; k < inner; ++k) r(i, j) += a(k, i) * b(k, j);
    }
  return r;
}

/// a b^T; for two vectors the dyad.
template <class S, int rows, int inner, int columns>
Mat<S, rows, columns> product_transposed(const Mat<S, rows, inner>& a, const Mat<S, columns, inner>& b) {
  Mat<S, rows, columns> r;
  for (int j = 0; j < columns; ++j) {
    for (int i = 0; i < rows; ++i) r(i, j) = a(i, 0) * b(j, 0);
    for (int k = 1; k < inner; ++k)
      for (int i = 0; i < rows; ++i) r(i, j) += a(i, k) * b(j, k);
  }
  return r;
}

/// Inverse of a matrix of two or three rows, and its determinant.
template <class S, int n>
Mat<S, n> inverse(const Mat<S, n>& m, S& det) {
  static_assert(n == 2 || n == 3);
  Mat<S, n> r;
  if constexpr (n == 2) {
    r(0, 0) = m(1, 1);
    r(1, 1) = m(0, 0);
    r(0, 1) = -m(0, 1);
    r(1, 0) = -m(1, 0);
    det = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
        r(i, j) = m(a, c) * m(b, d) - m(a, d) * m(b, c);
      }
    det = m(0, 0) * r(0, 0) + m(0, 1) * r(1, 0) + m(0, 2) * r(2, 0);
  }
  return scaled(r, S(S(1) / det));
}

/// a x b.
template <class S>
Vec<S, 3> cross(const Vec<S, 3>& a, const Vec<S, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Sum of the products of the components: a . b of vectors, a : b of tensors.
template <class S, int rows, int columns>
S contraction(const Mat<S, rows, columns>& a, const Mat<S, rows, columns>& b) {
  S sum = a(0, 0) * b(0, 0);
  for (int j = 0; j < columns; ++j)
    for (int i = j == 0 ? 1 : 0; i < rows; ++i) sum += a(i, j) * b(i, j);
  return sum;
}

}  // namespace stickslip
