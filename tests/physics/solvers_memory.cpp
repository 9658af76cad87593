// SPDX-License-Identifier: BSL-1.0
// What a factor takes of memory is told, and that it does not fit is not told as a singular matrix.
#include "solvers.hpp"

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/linear_solver/mumps.hpp>
#include <stickslip/linear_solver/umfpack.hpp>

#include <doctest/doctest.h>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <new>

namespace solvers_memory {

using namespace solvers;

// The lower triangle of the Laplacian of a cube of n points a side.
Matrix laplacian(Index n) {
  Matrix m{{0}, {}, {}, Symmetry::symmetric};
  for (Index c = 0; c < n * n * n; ++c) {
    const auto add = [&](bool there, Index r, Real v) {
      if (!there) return;
      m.row.push_back(r);
      m.values.push_back(v);
    };
    add(true, c, 6);
    add(c % n < n - 1, c + 1, -1);
    add(c / n % n < n - 1, c + n, -1);
    add(c / (n * n) < n - 1, c + n * n, -1);
    m.start.push_back(static_cast<Index>(m.row.size()));
  }
  return m;
}

enum Told : int { done, singular, no_memory, other };

// What a process tells that factorises a cube with no more than `bytes` besides what a small one took: OpenBLAS, which
// makes room for itself the first time, waits for ever if there is none.
template <class Solver>
Told factorized(Index n, rlim_t bytes) {
  const Matrix small = stored<Solver>(laplacian(8)), cube = stored<Solver>(laplacian(n));
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    alarm(60);
    Told told = other;
    try {
      Solver solver;
      solver.analyze(small.view());
      if (solver.factorize(small.view()) != Factorization::done) _exit(other);
      malloc_trim(0);
      rlim_t pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      const rlim_t limit = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes;
      const rlimit memory{limit, limit};
      setrlimit(RLIMIT_AS, &memory);
      solver.analyze(cube.view());
      told = solver.factorize(cube.view()) == Factorization::failed ? singular : done;
    } catch (const std::bad_alloc&) {
      told = no_memory;
    } catch (...) {
    }
    _exit(told);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? static_cast<Told>(WEXITSTATUS(status)) : other;
}

// The shadow memory of AddressSanitizer takes more addresses than any limit leaves. GCC tells of it by a macro, Clang
// by a feature.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ADDRESSES_CANNOT_BE_LIMITED
#endif
#endif
#if !defined(__SANITIZE_ADDRESS__) && !defined(ADDRESSES_CANNOT_BE_LIMITED)
TEST_CASE_TEMPLATE("a factor that does not fit into memory is refused as such", Solver, Cholmod, Umfpack, MumpsLdlt,
                   MumpsLu) {
  CHECK(factorized<Solver>(12, rlim_t(1) << 30) == done);
  CHECK(factorized<Solver>(36, rlim_t(1) << 26) == no_memory);
}
#endif

// What the factor of a chain of n springs takes: its triangles have 2 n - 1 entries each, in any good order.
template <class Solver>
std::size_t bytes_of_chain(Index n) {
  Matrix m{{0}, {}, {}, Symmetry::symmetric};
  for (Index i = 0; i < n; ++i) {
    m.row.push_back(i);
    m.values.push_back(2.1);
    if (i + 1 < n) {
      m.row.push_back(i + 1);
      m.values.push_back(-1);
    }
    m.start.push_back(static_cast<Index>(m.row.size()));
  }
  const Matrix chain = stored<Solver>(m);
  Solver solver;
  solver.analyze(chain.view());
  CHECK(solver.factorize(chain.view()) == Factorization::done);
  return solver.factor_bytes();
}
TEST_CASE_TEMPLATE("a sparse factor reports its memory", Solver, EigenLdlt, EigenLu, Cholmod, Umfpack, MumpsLdlt,
                   MumpsLu) {
  const std::size_t one = bytes_of_chain<Solver>(1000), ten = bytes_of_chain<Solver>(10000);
  MESSAGE(one << " bytes of 1000 unknowns, " << ten << " of 10 000");
  CHECK(one > 1999 * sizeof(Real));
  CHECK(one < 20 * 1999 * sizeof(Real));
  CHECK(ten > 5 * one);  // ten times as much, but for what goes by blocks
  CHECK(ten < 20 * one);
}
TEST_CASE("a band factor reports its memory") {
  CHECK(bytes_of_chain<BandedCholesky>(1000) == 2 * 1000 * sizeof(Real));
  CHECK(bytes_of_chain<BandedLu>(1000) == 4 * 1000 * sizeof(Real) + 1000 * sizeof(int));  // one more, for pivoting
}

}  // namespace solvers_memory
