// SPDX-License-Identifier: BSL-1.0
#include "forming.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>

#include <benchmark/benchmark.h>

namespace {

/// Residual and tangent of a whole scene; items are elements.
void assembly(benchmark::State& state) {
  const auto refine = static_cast<stickslip::Index>(state.range(0));
  bench::Forming<bench::Stretching<stickslip::QuasiCoulomb, stickslip::EigenLdlt>> forming(refine);
  forming.system.timings = {};
  for (auto _ : state) {
    const stickslip::Failure failure = forming.evaluate();
    if (failure) return state.SkipWithError(stickslip::describe(failure.cause));
  }
  state.SetItemsProcessed(state.iterations() * 28 * refine * refine);
  state.counters["touching"] = contact_summary(forming.system.pairs()).touching;
  state.counters["contact share"] =
      forming.system.timings.contact / (forming.system.timings.contact + forming.system.timings.assembly);
}
BENCHMARK(assembly)->ArgName("refine")->Arg(1)->Arg(4)->Arg(16)->Unit(benchmark::kMicrosecond);

}  // namespace
