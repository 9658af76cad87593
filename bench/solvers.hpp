// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "forming.hpp"

#include <benchmark/benchmark.h>

#include <type_traits>

namespace bench {

/// The friction law whose tangent is as wide as the solver takes.
template <class Solver>
using WidestFriction =
    std::conditional_t<Solver::accepts == stickslip::Symmetry::symmetric, stickslip::QuasiCoulomb, stickslip::Coulomb>;

inline void count(benchmark::State& state, const stickslip::SparseView& matrix) {
  state.counters["unknowns"] = matrix.size;
  state.counters["nnz"] = matrix.nonzeros();
}

template <class Solver>
void factorize(benchmark::State& state) {
  Forming<Stretching<WidestFriction<Solver>, Solver>> forming(static_cast<stickslip::Index>(state.range(0)));
  const stickslip::SparseView matrix = forming.system.tangent().stored;
  Solver solver;
  solver.analyze(matrix);
  for (auto _ : state)
    if (solver.factorize(matrix) == stickslip::Factorization::failed)
      return state.SkipWithError("the factorisation failed");
  count(state, matrix);
}

template <class Solver>
void solve(benchmark::State& state) {
  Forming<Stretching<WidestFriction<Solver>, Solver>> forming(static_cast<stickslip::Index>(state.range(0)));
  const stickslip::SparseView matrix = forming.system.tangent().stored;
  Solver solver;
  solver.analyze(matrix);
  if (solver.factorize(matrix) == stickslip::Factorization::failed)
    return state.SkipWithError("the factorisation failed");
  stickslip::Field x = forming.system.forces().residual;
  for (auto _ : state) {
    if (!solver.solve(forming.system.forces().residual.data(), x.data()))
      return state.SkipWithError("the solution failed");
    benchmark::ClobberMemory();
  }
  count(state, matrix);
}

/// Registers both at the three sizes.
template <class Solver>
bool offer(const std::string& name) {
  for (const auto& [what, function] : {std::pair{"factorize", &factorize<Solver>}, std::pair{"solve", &solve<Solver>}})
    benchmark::RegisterBenchmark((std::string(what) + "/" + name).c_str(), function)
        ->ArgName("refine")
        ->Arg(1)
        ->Arg(4)
        ->Arg(8)
        ->Unit(benchmark::kMicrosecond);
  return true;
}

}  // namespace bench
