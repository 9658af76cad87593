// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "counted.hpp"

#include <benchmark/benchmark.h>

#include <type_traits>

namespace bench {

/// Adds a kernel's arithmetic to its row: operations a call, what of them is dear, and operations a second.
inline void report(benchmark::State& state, const Operations& done) {
  state.counters["flop"] = static_cast<double>(done.total());
  state.counters["div+root"] = static_cast<double>(done.divide + done.root);
  state.counters["transc"] = static_cast<double>(done.transcendental);
  state.counters["flop/s"] =
      benchmark::Counter(static_cast<double>(done.total()), benchmark::Counter::kIsIterationInvariantRate);
}

/// Registers function(state, argument) as `name`.
template <class Argument>
benchmark::internal::Benchmark* add(const char* name, void (*function)(benchmark::State&, Argument),
                                    const std::type_identity_t<Argument>& argument) {
  return benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { function(state, argument); });
}

}  // namespace bench
