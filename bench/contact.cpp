// SPDX-License-Identifier: BSL-1.0
#include "report.hpp"

#include <stickslip/contact/node_kernel.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/geometry/profile.hpp>

namespace {

using namespace stickslip;
using bench::add;

const rigid::Profile die = rigid::path({52.83, -106.35}, {0, 1}).straight(100).right(6.35, pi / 2).straight(50);

template <class S>
SurfacePoint<S, 2> on_the_die() {
  const Vec<Real, 2> x(55, -1.9);  // a little inside the fillet
  return die.closest(Vec<S, 2>(S(x[0]), S(x[1])));
}

/// Force and stiffness of a node that has slid by `slipped` since the converged state; 1e-5 sticks, 1 slides.
template <class Friction, class S>
auto node(const SurfacePoint<S, 2>& at, double slipped) {
  NodeMemory<S, 2, Penalty, Friction> old{};
  if constexpr (Friction::active)
    if constexpr (requires { old.friction.pressure.pressure; }) old.friction.pressure.pressure = S(1e4);
  typename Friction::Law law{};
  if constexpr (requires { law.mu; }) law.mu = 0.15;
  const Penalty penalty{.normal = 1e5, .tangential = 1e4};
  return contact_node<S, 2>(penalty, law, Friction{}, 1.0, at, Vec<S, 1>(S(slipped)), old,
                            penalty_pressure(penalty, 1.0, at.gap, old), 0);
}

template <class Friction>
void contact(benchmark::State& state, double slipped) {
  SurfacePoint<Real, 2> at = on_the_die<Real>();
  if (!(at.gap < 0)) return state.SkipWithError("the node is not in contact");
  for (auto _ : state) {
    benchmark::DoNotOptimize(at);
    auto result = node<Friction>(at, slipped);
    benchmark::DoNotOptimize(result);
  }
  const auto counted = on_the_die<bench::Counted>();
  bench::report(state, bench::count([&] { benchmark::DoNotOptimize(node<Friction>(counted, slipped)); }));
}
[[maybe_unused]] const benchmark::internal::Benchmark* const laws[] = {
    add("contact/Frictionless", &contact<Frictionless>, 1),
    add("contact/Coulomb/stick", &contact<Coulomb>, 1e-5),
    add("contact/Coulomb/slide", &contact<Coulomb>, 1),
    add("contact/QuasiCoulomb/stick", &contact<QuasiCoulomb>, 1e-5),
    add("contact/QuasiCoulomb/slide", &contact<QuasiCoulomb>, 1),
};

/// Closest point on a tool, from a place whose closest piece is the fillet. The search for the piece runs in plain
/// numbers and is in the time, not in the count.
void closest(benchmark::State& state, const rigid::Profile& tool) {
  Vec<Real, 2> x(55, -1.9);
  for (auto _ : state) {
    benchmark::DoNotOptimize(x);
    auto at = tool.closest(x);
    benchmark::DoNotOptimize(at);
  }
  const Vec<bench::Counted, 2> counted(x[0], x[1]);
  bench::report(state, bench::count([&] { benchmark::DoNotOptimize(tool.closest(counted)); }));
}
[[maybe_unused]] const benchmark::internal::Benchmark* const tools[] = {
    add("closest point/line", &closest, rigid::line({0, 0}, {1, 0})),
    add("closest point/disc", &closest, rigid::disc({50, -10}, 9)),
    add("closest point/die of 3 pieces", &closest, die),
};

}  // namespace
