// SPDX-License-Identifier: BSL-1.0
// What takes its norms from a vector space takes them from no other: here the space is of two halves, as two processes
// would add them.
#include <stickslip/base/orthodir.hpp>
#include <stickslip/base/relaxation.hpp>
#include <stickslip/base/vector_space.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace {

using namespace stickslip;

// A field holds a half of each vector of twice its length, whose other half is the same.
struct Twice {
  Real dot(const Field& x, const Field& y) const { return 2 * x.dot(y); }
  Real norm(const Field& x) const { return std::sqrt(dot(x, x)); }
  Real max(const Field& x) const { return x.lpNorm<Eigen::Infinity>(); }
  Real max(Real part) const { return part; }
  Real sum(Real part) const { return 2 * part; }
};
static_assert(VectorSpace<Twice> && !VectorSpace<int>);

Field field(std::initializer_list<Real> entries) {
  Field x(static_cast<Index>(entries.size()));
  std::copy(entries.begin(), entries.end(), x.begin());
  return x;
}
Field doubled(const Field& x) {
  Field whole(2 * x.size());
  whole << x, x;
  return whole;
}

TEST_CASE("the serial space sums and compares all entries") {
  const SerialSpace space;
  const Field x = field({1, -4, 2}), y = field({2, 1, -1});
  CHECK(space.dot(x, y) == -4);
  CHECK(space.norm(x) == doctest::Approx(std::sqrt(21.0)));
  CHECK(space.max(x) == 4);
  CHECK(space.max(Field(0)) == 0);
  CHECK(space.sum(-3) == -3);
  CHECK(space.max(2.5) == 2.5);
}

// Solves (1 + c S) x = b, S shifting the entries by one, with the identity for the near solver.
template <class Space>
std::pair<Field, Index> solve(const Field& b, Index block) {
  Orthodir<Space> krylov;
  krylov.resize(Index(b.size()), Space{});
  krylov.begin(b);
  const Space space;
  const Real size = space.norm(b);
  while (krylov.count() < 60 && space.norm(krylov.residual()) > 1e-12 * size) {
    krylov.step() = krylov.next();
    Field& w = krylov.response();
    w = krylov.step();
    for (Index i = 0; i < b.size(); ++i)
      w[i] += 0.4 * krylov.step()[i % block == 0 ? i + block - 1 : i - 1] * (1 + 0.1 * (i % block));
    if (!krylov.add()) break;
  }
  return {krylov.solution(), krylov.count()};
}
TEST_CASE("Orthodir takes its products from the space: a half as the whole") {
  Field b(7);
  for (Index i = 0; i < 7; ++i) b[i] = std::sin(1.0 + i);
  const auto [half, half_count] = solve<Twice>(b, 7);
  const auto [whole, whole_count] = solve<SerialSpace>(doubled(b), 7);
  CHECK(half_count == whole_count);
  CHECK((doubled(half) - whole).norm() < 1e-12 * whole.norm());
}

// A space in which only the first entry counts.
struct FirstEntry {
  Real dot(const Field& x, const Field& y) const { return x[0] * y[0]; }
  Real norm(const Field& x) const { return std::abs(x[0]); }
  Real max(const Field& x) const { return std::abs(x[0]); }
  Real max(Real part) const { return part; }
  Real sum(Real part) const { return part; }
};
TEST_CASE("Aitken's factor is that of the space") {
  const Field first = field({1, 3}), second = field({-0.25, 5});
  Relaxation all, one;
  for (const Field& change : {first, second}) {
    all.next(change);
    one.next(change, FirstEntry{});
  }
  // -omega d1 . (d2 - d1) / |d2 - d1|^2
  CHECK(one.omega == doctest::Approx(1.25 / (1.25 * 1.25)));
  CHECK(all.omega == doctest::Approx(std::clamp(-(-1.25 + 6) / (1.25 * 1.25 + 4), 0.05, 2.0)));
}

}  // namespace
