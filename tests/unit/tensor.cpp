// SPDX-License-Identifier: BSL-1.0
#include <stickslip/tensor/dual.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>
#include <stickslip/tensor/spectral.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <doctest/doctest.h>

#include <random>

namespace {

using namespace stickslip;
using T = Tensor<Real, Planar>;

T tensor(Real t11, Real t12, Real t21, Real t22, Real t33) {
  T t;
  t.v << t11, t12, t21, t22, t33;
  return t;
}
Mat<Real, 3> full(const T& t) {
  Mat<Real, 3> m = Mat<Real, 3>::Zero();
  for (const auto& [i, j] : Planar::pairs) m(i, j) = t(i, j);
  return m;
}

TEST_CASE("planar tensor products, inverses and determinants are those of 3 x 3 matrices") {
  const T a = tensor(1.2, 0.3, -0.7, 0.9, 1.7), b = tensor(-0.4, 0.2, 0.8, 1.1, 0.6);
  CHECK((full(product(a, b)) - full(a) * full(b)).norm() < 1e-15);
  CHECK((full(transpose(a)) - full(a).transpose()).norm() == 0);
  CHECK(determinant(a) == doctest::Approx((1.2 * 0.9 + 0.3 * 0.7) * 1.7).epsilon(1e-15));
  CHECK((full(a) * full(inverse(a)) - Mat<Real, 3>::Identity()).norm() < 1e-15);
  CHECK(trace(a) == doctest::Approx(3.8).epsilon(1e-15));
  CHECK((full(kirchhoff(a, b)) - full(a) * full(b).transpose()).norm() < 1e-15);
  CHECK((full(T::identity()) - Mat<Real, 3>::Identity()).norm() == 0);
}

TEST_CASE("von Mises stress is right in tension, shear and pressure") {
  CHECK(von_mises(tensor(7, 0, 0, 0, 0)) == doctest::Approx(7).epsilon(1e-15));
  CHECK(von_mises(tensor(0, 2, 2, 0, 0)) == doctest::Approx(2 * std::sqrt(3.0)).epsilon(1e-15));
  CHECK(von_mises(tensor(-5, 0, 0, -5, -5)) == 0);
}

TEST_CASE("a symmetric planar tensor fills both off-diagonal components") {
  SymmetricTensor<Real, Planar> s;
  s.v << 1, 2, 3, 4;
  const T t = s.full();
  CHECK(t(0, 0) == 1);
  CHECK(t(1, 1) == 2);
  CHECK(t(2, 2) == 3);
  CHECK(t(0, 1) == 4);
  CHECK(t(1, 0) == 4);
}

void check_spectral(const T& t) {
  const auto s = spectral(t);
  const Mat<Real, 3> n = full(s.directions);
  CHECK((n.transpose() * n - Mat<Real, 3>::Identity()).norm() < 1e-14);
  const Mat<Real, 3> back = n * s.values.asDiagonal() * n.transpose();
  CHECK((back - full(t)).norm() <= 4e-15 * full(t).norm());
}

TEST_CASE("the planar spectral form is exact for distinct, nearly equal and equal values") {
  check_spectral(tensor(2, 0.5, 0.5, 1, 3));
  check_spectral(tensor(1, 0.5, 0.5, 2, 3));
  check_spectral(tensor(1, -0.5, -0.5, 2, 3));
  check_spectral(tensor(-1, 0.3, 0.3, -4, 2));
  check_spectral(tensor(2, 0, 0, 2, 2));
  check_spectral(tensor(0, 0, 0, 0, 0));
  check_spectral(tensor(0, 1, 1, 0, 0));
  check_spectral(tensor(1, 0, 0, 3, 3));
  for (const Real gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    check_spectral(tensor(1 + gap, 0, 0, 1, 1));
    check_spectral(tensor(1, 0, 0, 1 + gap, 1));
    check_spectral(tensor(1, gap, gap, 1, 1));
    check_spectral(tensor(1 + gap, gap, gap, 1 - gap, 1));
    check_spectral(tensor(1 - gap, -gap, -gap, 1 + gap, 1));
  }
  const auto equal = spectral(tensor(2, 0, 0, 2, 5));
  CHECK(equal.directions(0, 0) == 1);
  CHECK(equal.directions(0, 1) == 0);
}

TEST_CASE("the smaller principal value of a nearly singular tensor keeps its digits") {
  // Exact in binary: Q diag(2^40, 1) Q^T turned by 45 degrees.
  const Real big = 1099511627776.0;
  const auto s = spectral(tensor(0.5 * (big + 1), 0.5 * (big - 1), 0.5 * (big - 1), 0.5 * (big + 1), 1));
  CHECK(std::max(s.values[0], s.values[1]) == doctest::Approx(big).epsilon(1e-14));
  CHECK(std::min(s.values[0], s.values[1]) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("the divided difference of the logarithm keeps its digits near equal arguments") {
  CHECK(log_difference(2.0, 2.0) == 0.5);
  CHECK(log_difference(3.0, 1.0) == doctest::Approx(std::log(3.0) / 2).epsilon(1e-15));
  for (const Real x : {1e-1, 2e-3, 1.0001e-3, 0.9999e-3, 1e-4, 1e-8, 1e-16, -1e-1, -2e-3, -0.9999e-3, -1e-8}) {
    const long double a = 0.7L * (1 + static_cast<long double>(x)), b = 0.7L;
    const long double exact = std::log1p(static_cast<long double>(x)) / (static_cast<long double>(x) * b);
    CHECK(log_difference(static_cast<Real>(a), static_cast<Real>(b)) ==
          doctest::Approx(static_cast<Real>(exact)).epsilon(1e-12));
  }
  // Symmetric in its arguments.
  CHECK(log_difference(1.3, 0.4) == doctest::Approx(log_difference(0.4, 1.3)).epsilon(1e-15));
  CHECK(log_difference(1.0005, 1.0) == doctest::Approx(log_difference(1.0, 1.0005)).epsilon(1e-14));
  // Its slope on both branches of the series' switch.
  for (const Real a : {1.5, 1.0009, 1.0011, 1.0}) {
    const auto d = log_difference(Dual<1>::variable(a, 0), Dual<1>(1.0));
    const Real h = 1e-3;
    const auto f = [](Real x) {
      return x == 1 ? 1.0L : std::log(static_cast<long double>(x)) / (static_cast<long double>(x) - 1);
    };
    const Real slope = static_cast<Real>((8 * (f(a + h) - f(a - h)) - (f(a + 2 * h) - f(a - 2 * h))) / (12 * h));
    CHECK(d.slope[0] == doctest::Approx(slope).epsilon(1e-9));
  }
}

// Every function of a dual number against central differences.
template <class F>
void check_function(F f, Real x) {
  const Dual<2> y = f(Dual<2>::variable(x, 1));
  const Real h = 1e-4;
  const auto g = [&](Real v) { return f(Dual<2>(v)).value; };
  const Real slope = (8 * (g(x + h) - g(x - h)) - (g(x + 2 * h) - g(x - 2 * h))) / (12 * h);
  CHECK(y.slope[1] == doctest::Approx(slope).epsilon(1e-9));
  CHECK(y.slope[0] == 0);
}
TEST_CASE("functions of dual numbers have exact derivatives") {
  using D = Dual<2>;
  const D c(0.7);
  for (const Real x : {0.3, 1.4}) {
    check_function([](const D& a) { return sqrt(a); }, x);
    check_function([](const D& a) { return exp(a); }, x);
    check_function([](const D& a) { return expm1(a); }, x);
    check_function([](const D& a) { return log(a); }, x);
    check_function([](const D& a) { return log1p(a); }, x);
    check_function([](const D& a) { return pow(a, 0.216); }, x);
    check_function([](const D& a) { return sin(a); }, x);
    check_function([](const D& a) { return cos(a); }, x);
    check_function([](const D& a) { return tanh(a); }, x);
    check_function([](const D& a) { return abs(a); }, x);
    check_function([](const D& a) { return abs(-a); }, x);
    check_function([&](const D& a) { return atan2(a, c); }, x);
    check_function([&](const D& a) { return atan2(c, a); }, x);
    check_function([&](const D& a) { return a * a + c * a - a / c + c / a; }, x);
    check_function(
        [&](const D& a) {
          D b = a;
          b += c;
          b *= a;
          b -= c;
          b /= a;
          return b;
        },
        x);
  }
  CHECK(exp(D(0.3)).value == std::exp(0.3));
  CHECK(tanh(D(0.3)).value == std::tanh(0.3));
  CHECK(atan2(D(0.3), D(-1)).value == std::atan2(0.3, -1.0));
  CHECK(pow(D(0.3), 0.2).value == std::pow(0.3, 0.2));
}
TEST_CASE("dual numbers compare by value") {
  const Dual<1> a = Dual<1>::variable(1, 0), b(1), c(2);
  CHECK(a == b);
  CHECK(a != c);
  CHECK(a < c);
  CHECK(c > a);
  CHECK(a <= b);
  CHECK(a >= b);
  CHECK(value_of(c) == 2);
}

TEST_CASE("logarithm, exponential and determinant near one keep the digits of the increment") {
  for (int k = -200; k < 0; ++k)
    for (const Real sign : {-0.9, 1.0}) {
      const Real x = sign * std::pow(10.0, 0.1 * k);
      CAPTURE(x);
      CHECK(log_one_plus(x) == doctest::Approx(std::log1p(x)).epsilon(2e-15));
      CHECK(exp_less_one(x) == doctest::Approx(std::expm1(x)).epsilon(1e-14));
      using D = Dual<1>;
      D d(x);
      d.slope[0] = 1;
      CHECK(log_one_plus(d).slope[0] == doctest::Approx(1 / (1 + x)).epsilon(1e-14));
      CHECK(exp_less_one(d).slope[0] == doctest::Approx(std::exp(x)).epsilon(1e-14));
    }
  // Of 1 + size H, whose trace is zero: the second and third order alone.
  const T H = tensor(0.3, 0.2, -0.5, 0.4, -0.7);
  for (const Real size : {1.0, 1e-3, 1e-6}) {
    T t;
    t.v = scaled(H.v, size);
    const Real second = 0.3 * 0.4 + 0.2 * 0.5 - 0.7 * (0.3 + 0.4), third = -0.7 * (0.3 * 0.4 + 0.2 * 0.5);
    const Real exact = size * size * (second + size * third);
    // The trace cancels by rounding its terms, which the tensor has to one part in 1e16 of them.
    CHECK(std::abs(determinant_less_one(t) - exact) < 3e-16 * size);
    Tensor<Real, Spatial> in_space;
    for (const auto& [i, j] : Planar::pairs) in_space(i, j) = t(i, j);
    CHECK(std::abs(determinant_less_one(in_space) - exact) < 3e-16 * size);
    CHECK(std::abs(1 + determinant_less_one(t) - determinant(plus_one(t))) < 1e-15);
  }
}

}  // namespace
