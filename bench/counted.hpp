// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <cmath>

namespace bench {

/// What arithmetic a kernel did.
struct Operations {
  long add = 0;  ///< sums and differences
  long multiply = 0;
  long divide = 0;
  long root = 0;
  long transcendental = 0;  ///< exponentials, logarithms, powers, angles

  /// All of them, a root or a transcendental function counted as one.
  long total() const { return add + multiply + divide + root + transcendental; }
};

inline Operations operations;

/// A number that counts the operations it goes through: sent once through a kernel that the solver runs with Real. A
/// change of sign and a comparison are no operation.
struct Counted {
  double value = 0;

  Counted() = default;
  Counted(double v) : value(v) {}  // NOLINT(google-explicit-constructor): constants enter formulas as they are

  Counted& operator+=(const Counted& b) { return *this = *this + b; }
  Counted& operator-=(const Counted& b) { return *this = *this - b; }
  Counted& operator*=(const Counted& b) { return *this = *this * b; }
  Counted& operator/=(const Counted& b) { return *this = *this / b; }

  friend Counted operator-(const Counted& a) { return -a.value; }
  friend Counted operator+(const Counted& a, const Counted& b) { return counted(operations.add, a.value + b.value); }
  friend Counted operator-(const Counted& a, const Counted& b) { return counted(operations.add, a.value - b.value); }
  friend Counted operator*(const Counted& a, const Counted& b) {
    return counted(operations.multiply, a.value * b.value);
  }
  friend Counted operator/(const Counted& a, const Counted& b) { return counted(operations.divide, a.value / b.value); }
  friend bool operator==(const Counted& a, const Counted& b) { return a.value == b.value; }

  friend Counted sqrt(const Counted& x) { return counted(operations.root, std::sqrt(x.value)); }
  friend Counted exp(const Counted& x) { return counted(operations.transcendental, std::exp(x.value)); }
  friend Counted log(const Counted& x) { return counted(operations.transcendental, std::log(x.value)); }
  friend Counted log1p(const Counted& x) { return counted(operations.transcendental, std::log1p(x.value)); }
  friend Counted pow(const Counted& x, double p) { return counted(operations.transcendental, std::pow(x.value, p)); }
  friend Counted atan2(const Counted& y, const Counted& x) {
    return counted(operations.transcendental, std::atan2(y.value, x.value));
  }

 private:
  static Counted counted(long& counter, double v) {
    ++counter;
    return v;
  }
};

/// Found by the kernels through their argument, as that of Real is.
inline double value_of(const Counted& x) {
  return x.value;
}

/// Operations of one call.
template <class Kernel>
Operations count(Kernel&& kernel) {
  operations = {};
  kernel();
  return operations;
}

}  // namespace bench

template <>
struct Eigen::NumTraits<bench::Counted> : Eigen::NumTraits<double> {
  using Real = bench::Counted;
  using NonInteger = bench::Counted;
  using Nested = bench::Counted;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
// The geometry of an element is of type double.
template <class Operation>
struct Eigen::ScalarBinaryOpTraits<bench::Counted, double, Operation> {
  using ReturnType = bench::Counted;
};
