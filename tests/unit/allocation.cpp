// SPDX-License-Identifier: BSL-1.0
// Nothing of ours is taken from the heap inside Newton's loop after the first iteration of a run. The linker sends the
// calls that this program's own object code makes (Eigen's among them) to the counters below.
#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

#include <doctest/doctest.h>

#include <cstdlib>
#include <new>

namespace {
// Where an allocation is counted; off outside of runs.
enum class Ledger { off, ours, solver } ledger = Ledger::off;
long ours = 0, solvers = 0;
void count() {
  if (ledger == Ledger::ours) ++ours;
  if (ledger == Ledger::solver) ++solvers;
}
}  // namespace

extern "C" {
void* __real_malloc(std::size_t);
void* __real_calloc(std::size_t, std::size_t);
void* __real_realloc(void*, std::size_t);
void* __real_aligned_alloc(std::size_t, std::size_t);
int __real_posix_memalign(void**, std::size_t, std::size_t);
void* __wrap_malloc(std::size_t n) {
  count();
  return __real_malloc(n);
}
void* __wrap_calloc(std::size_t n, std::size_t size) {
  count();
  return __real_calloc(n, size);
}
void* __wrap_realloc(void* p, std::size_t n) {
  count();
  return __real_realloc(p, n);
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t n) {
  count();
  return __real_aligned_alloc(alignment, n);
}
int __wrap_posix_memalign(void** p, std::size_t alignment, std::size_t n) {
  count();
  return __real_posix_memalign(p, alignment, n);
}
}

[[gnu::noinline]] void* operator new(std::size_t n) {
  count();
  if (void* p = __real_malloc(n ? n : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t n, std::align_val_t alignment) {
  count();
  if (void* p = __real_aligned_alloc(static_cast<std::size_t>(alignment), n)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

namespace {

using namespace stickslip;

long iterations = 0;

// Counts on our account from the end of the first solution of a run, save within the solver: what happens between the
// steps is counted with the loops.
class Watched {
 public:
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;
  void analyze(const SparseView& pattern) {
    const Ledger before = std::exchange(ledger, Ledger::off);
    solver_.analyze(pattern);
    ledger = before;
  }
  Factorization factorize(const SparseView& matrix) {
    const Ledger before = std::exchange(ledger, before_first() ? Ledger::off : Ledger::solver);
    const Factorization f = solver_.factorize(matrix);
    ledger = before;
    return f;
  }
  bool solve(const Real* b, Real* x) {
    ledger = before_first() ? Ledger::off : Ledger::solver;
    const bool good = solver_.solve(b, x);
    ++iterations;
    ledger = Ledger::ours;  // from the end of the first solution on
    return good;
  }

 private:
  static bool before_first() { return iterations == 0; }
  EigenLdlt solver_;
};

struct Model {
  using Kinematics = Axisymmetric;
  using Element = MeanDilatation<Quad4>;
  using Material = FiniteJ2<PowerHardening>;
  using Friction = QuasiCoulomb;
  using Enforcement = Penalty;
  using TimeIntegration = Quasistatic;
  using LinearSolver = Watched;
};

struct Bending : Model {
  using Element = AssumedStrain<Quad4>;
};

TEST_CASE("the allocation counters count the library's own allocations") {
  ledger = Ledger::ours;
  const long before = ours;
  Field* field = new Field(100);  // operator new, and Eigen's own malloc
  ledger = Ledger::off;
  CHECK(ours == before + 2);
  delete field;
  ours = 0;
}

TEST_CASE_TEMPLATE("Newton's loop allocates nothing after its first iteration", M, Model, Bending) {
  Problem<M> p(
      {.body = mesh::rectangle({.size = {10, 10}, .cells = {6, 6}}),
       .material = {.young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}},
       .contacts = {{.side = "top",
                     .tool = rigid::disc({0, 30}, 20),
                     .motion = [](Real t) { return Vec<Real, 2>(0, -1 * t); },
                     .friction = {.mu = 0.2},
                     .enforcement = {.normal = 1e5, .tangential = 1e4}}}});
  p.hold("left", 0).hold("bottom", 1);
  auto march = p.march({.end = 1, .steps = 10, .tolerance = 1e-8});
  iterations = ours = solvers = 0;
  long sliding = 0;
  for (const auto& step : march) sliding += step.contact.sliding;
  ledger = Ledger::off;
  CHECK(bool(march.outcome()));
  CHECK(march.report().steps == 10);
  CHECK(iterations > 30);
  CHECK(sliding > 0);
  CHECK(p.max_plastic_strain() > 0.01);
  CHECK(ours == 0);
  MESSAGE("the solver's own allocations: ", solvers, " in ", iterations, " iterations");
}

struct Stacked : Model {
  struct Block {
    using Element = MeanDilatation<Quad4>;
    using Material = FiniteJ2<PowerHardening>;
  };
  using Bodies = BodyTypes<Block>;
  using Surfaces = SurfaceContact<QuasiCoulomb>;
};

// Points, stencils and pattern are made where a step begins, and ways are checked where it ends: of one step without
// that check it is Newton's loop that is counted.
TEST_CASE("Newton's loop with surfaces in contact allocates nothing after its first iteration") {
  FiniteJ2<PowerHardening> steel;
  steel.young = 69004;
  steel.poisson = 0.3;
  steel.hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216};
  auto high = mesh::rectangle({.origin = {0, 5}, .size = {8, 5}, .cells = {5, 4}});
  for (auto& x : high.nodes) x[1] += 0.01 * x[0] * x[0];
  Problem<Stacked> p(
      {.bodies = {{.name = "low", .mesh = mesh::rectangle({.size = {10, 5}, .cells = {7, 4}}), .material = steel},
                  {.name = "high", .mesh = high, .material = steel}},
       .surfaces = {{.side = "high.bottom",
                     .against = "low.top",
                     .friction = {.mu = 0.2},
                     .enforcement = {.normal = 1e6, .tangential = 1e5, .per = PenaltyPer::area}}}});
  p.hold("low.bottom", 1).hold("low.left", 0).hold("high.left", 0);
  p.drive("high.top", 1, [](Real t) { return -0.3 * t; });
  auto march = p.march({.end = 1, .steps = 1, .tolerance = 1e-8, .detect_tunnelling = false});
  iterations = ours = solvers = 0;
  march.finish();
  ledger = Ledger::off;
  CHECK_MESSAGE(march.outcome(), march.outcome().message());
  CHECK(march.report().steps == 1);
  CHECK(iterations > 4);
  CHECK(p.contact("high.bottom on low.top").summary().touching > 2);
  CHECK(ours == 0);
}

struct Brick : Model {
  using Kinematics = ThreeDimensional;
  using Element = MeanDilatation<Hex8>;
  using Friction = Frictionless;
  using Enforcement = NoContact;
};

struct BendingBrick : Brick {
  using Element = AssumedStrain<Hex8>;
};

TEST_CASE_TEMPLATE("Newton's loop in space allocates nothing after its first iteration", M, Brick, BendingBrick) {
  Problem<M> p(
      {.body = mesh::box({.size = {2, 1, 1}, .cells = {4, 2, 2}}),
       .material = {
           .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}}});
  for (const Index i : {0, 1, 2}) p.hold("left", i);
  p.drive("right", 1, [](Real t) { return -0.4 * t; }).load("right", 2, [](Real t) { return 5 * t; });
  auto march = p.march({.end = 1, .steps = 10, .tolerance = 1e-8});
  iterations = ours = solvers = 0;
  for ([[maybe_unused]] const auto& step : march) {
  }
  ledger = Ledger::off;
  CHECK(bool(march.outcome()));
  CHECK(iterations > 30);
  CHECK(p.max_plastic_strain() > 0.01);
  CHECK(ours == 0);
}

}  // namespace
