// SPDX-License-Identifier: BSL-1.0
// The tensors of three dimensions: all nine components.
#include <stickslip/tensor/dual.hpp>
#include <stickslip/tensor/spectral.hpp>
#include <stickslip/tensor/tensor.hpp>
#include <stickslip/verify/report.hpp>

#include <doctest/doctest.h>

#include <random>

namespace {

using namespace stickslip;
using T = Tensor<Real, Spatial>;
using M3 = Mat<Real, 3>;

template <class Derived>
T tensor(const Eigen::MatrixBase<Derived>& m) {
  T t;
  for (const auto& [i, j] : Spatial::pairs) t(i, j) = m(i, j);
  return t;
}
template <class TensorPattern>
M3 full(const Tensor<Real, TensorPattern>& t) {
  M3 m = M3::Zero();
  for (const auto& [i, j] : TensorPattern::pairs) m(i, j) = t(i, j);
  return m;
}
M3 random_matrix(std::mt19937& source) {
  std::uniform_real_distribution<Real> uniform(-1, 1);
  M3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = uniform(source);
  return m;
}
// Q diag(values) Q^T, symmetric to the last bit.
T turned(const Vec<Real, 3>& values, Real angle) {
  const M3 Q = full(verify::rotation<Spatial>(angle));
  const M3 m = Q * values.asDiagonal() * Q.transpose();
  return tensor(M3(0.5 * (m + m.transpose())));
}

TEST_CASE("spatial tensor products, inverses and determinants are those of 3 x 3 matrices") {
  std::mt19937 source(7);
  for (int n = 0; n < 20; ++n) {
    const M3 A = random_matrix(source), B = random_matrix(source);
    const T a = tensor(A), b = tensor(B);
    CHECK((full(product(a, b)) - A * B).norm() < 2e-15);
    CHECK((full(transpose(a)) - A.transpose()).norm() == 0);
    CHECK((full(kirchhoff(a, b)) - A * B.transpose()).norm() < 2e-15);
    CHECK(trace(a) == doctest::Approx(A.trace()).epsilon(1e-14));
    CHECK(determinant(product(a, b)) == doctest::Approx(determinant(a) * determinant(b)).epsilon(1e-12));
    CHECK((A * full(adjugate(a)) - determinant(a) * M3::Identity()).norm() < 2e-15);
    CHECK((A * full(inverse(a)) - M3::Identity()).norm() < 1e-14 / std::abs(determinant(a)));
  }
  CHECK(determinant(tensor(M3{{0, 2, 0}, {0, 0, 3}, {5, 0, 0}})) == 30);
  CHECK((full(T::identity()) - M3::Identity()).norm() == 0);
}

TEST_CASE("a spatial tensor of the planar pattern has the algebra of the planar one") {
  Tensor<Real, Planar> t;
  t.v << 1.2, 0.3, -0.7, 0.9, 1.7;
  const T s = tensor(full(t));
  CHECK(determinant(s) == doctest::Approx(determinant(t)).epsilon(1e-15));
  CHECK((full(inverse(s)) - full(inverse(t))).norm() < 1e-15);
  CHECK((full(adjugate(s)) - full(adjugate(t))).norm() < 1e-15);
}

TEST_CASE("von Mises stress in space weighs the three shears alike and ignores pressure") {
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
    T t;
    t(i, j) = t(j, i) = 2;
    CHECK(von_mises(t) == doctest::Approx(2 * std::sqrt(3.0)).epsilon(1e-15));
  }
  CHECK(von_mises(tensor(M3(-5 * M3::Identity()))) == 0);
}

TEST_CASE("a symmetric spatial tensor fills both off-diagonal components") {
  SymmetricTensor<Real, Spatial> s;
  s.v << 1, 2, 3, 4, 5, 6;
  CHECK(full(s.full()) == M3{{1, 4, 6}, {4, 2, 5}, {6, 5, 3}});
  CHECK(full(SymmetricTensor<Real, Spatial>::identity().full()) == M3::Identity());
}

void check_spectral(const T& t) {
  const auto s = spectral(t);
  const M3 n = full(s.directions);
  CHECK((n.transpose() * n - M3::Identity()).norm() < 3e-15);
  CHECK((n * s.values.asDiagonal() * n.transpose() - full(t)).norm() <= 4e-15 * full(t).norm());
}

TEST_CASE("the spatial spectral form is exact for distinct, nearly equal and equal values") {
  std::mt19937 source(11);
  for (int n = 0; n < 200; ++n) {
    const M3 A = random_matrix(source);
    check_spectral(tensor(M3(A + A.transpose())));
    check_spectral(tensor(M3(A * A.transpose())));
  }
  check_spectral(T{});
  check_spectral(tensor(M3{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}));
  check_spectral(tensor(M3{{0, 1, 1}, {1, 0, 1}, {1, 1, 0}}));
  check_spectral(tensor(M3::Constant(1)));
  for (const Real gap : {0.0, 1e-16, 1e-15, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3})
    for (const Real angle : {0.0, 1e-9, 1e-4, 0.3, 1.1, 2.0}) {
      check_spectral(turned({1, 1 + gap, 3}, angle));
      check_spectral(turned({1 + gap, 3, 1}, angle));
      check_spectral(turned({2, 2 + gap, 2 - 2 * gap}, angle));
      check_spectral(turned({-1, -1 - gap, 1}, angle));
    }
  const auto equal = spectral(tensor(M3(Vec<Real, 3>(2, 5, 2).asDiagonal())));
  CHECK(full(equal.directions) == M3::Identity());
  CHECK(equal.values == Vec<Real, 3>(2, 5, 2));
}

TEST_CASE("the smallest principal value of a positive tensor keeps its digits") {
  // Graded: the scaled tensor D^-1 t D^-1 is well conditioned, and that is what counts for Jacobi's rotations.
  const Vec<Real, 3> scale(1, 1e-4, 1e-8);
  const M3 inner{{1, 0.3, -0.2}, {0.3, 1, 0.4}, {-0.2, 0.4, 1}};
  const auto s = spectral(tensor(M3(scale.asDiagonal() * inner * scale.asDiagonal())));
  CHECK(s.values.prod() * 1e24 == doctest::Approx(determinant(tensor(inner))).epsilon(1e-14));
}

TEST_CASE("the spectral form of dual numbers has the derivatives of values and directions") {
  const T t = turned({0.7, 1.1, 1.6}, 0.9);
  Tensor<Dual<6>, Spatial> dual;
  for (int a = 0; a < 6; ++a) {
    const auto [i, j] = Spatial::symmetric_pairs[std::size_t(a)];
    dual(i, j) = dual(j, i) = Dual<6>::variable(t(i, j), a);
  }
  const auto s = spectral(dual);
  for (int a = 0; a < 6; ++a) {
    const auto [k, l] = Spatial::symmetric_pairs[std::size_t(a)];
    M3 n, dn, change = M3::Zero();
    for (const auto& [i, j] : Spatial::pairs) {
      n(i, j) = s.directions(i, j).value;
      dn(i, j) = s.directions(i, j).slope[a];
    }
    change(k, l) = change(l, k) = 1;
    const M3 in_axes = n.transpose() * change * n, spin = n.transpose() * dn;
    for (int A = 0; A < 3; ++A)
      for (int B = 0; B < 3; ++B) {
        if (A == B) {
          CHECK(s.values[A].slope[a] == doctest::Approx(in_axes(A, A)).epsilon(1e-13));
          CHECK(std::abs(spin(A, A)) < 1e-14);
        } else {
          const Real expected = in_axes(A, B) / (s.values[B].value - s.values[A].value);
          CHECK(std::abs(spin(A, B) - expected) < 1e-13);
        }
      }
  }
}

TEST_CASE("dual numbers differentiate symmetric functions of equal principal values") {
  // sum of v^3 is tr t^3, whose slope is 3 t^2.
  for (const Vec<Real, 3>& values : {Vec<Real, 3>(2, 2, 2), Vec<Real, 3>(2, 3, 2), Vec<Real, 3>(3, 2, 2)}) {
    const T t = tensor(M3(values.asDiagonal()));
    Tensor<Dual<9>, Spatial> dual;
    dual.v = verify::seeded<9>(t.v);
    const auto s = spectral(dual);
    Dual<9> sum(0);
    for (int A = 0; A < 3; ++A) sum += s.values[A] * s.values[A] * s.values[A];
    for (int a = 0; a < 9; ++a) CHECK(sum.slope[a] == doctest::Approx(3 * product(t, t).v[a]).epsilon(1e-14));
  }
}

TEST_CASE("dual numbers differentiate inverse and determinant") {
  const T t = tensor(M3{{1.2, 0.3, -0.1}, {0.2, 0.9, 0.4}, {-0.3, 0.1, 1.1}});
  Tensor<Dual<9>, Spatial> dual;
  dual.v = verify::seeded<9>(t.v);
  const T inverse_t = inverse(t);
  const auto det = determinant(dual);
  const auto inv = inverse(dual);
  for (int a = 0; a < 9; ++a) {
    const auto [k, l] = Spatial::pairs[std::size_t(a)];
    CHECK(det.slope[a] == doctest::Approx(determinant(t) * inverse_t(l, k)).epsilon(1e-14));
    for (const auto& [i, j] : Spatial::pairs)
      CHECK(std::abs(inv(i, j).slope[a] + inverse_t(i, k) * inverse_t(l, j)) < 1e-14);
  }
}

}  // namespace
