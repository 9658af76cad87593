// SPDX-License-Identifier: BSL-1.0
#include "laws.hpp"
#include "report.hpp"

namespace {

using namespace stickslip;
using bench::add;

template <class S>
Tensor<S, Planar> stretch(double strain) {
  auto F = Tensor<S, Planar>::identity();
  const double dF[] = {1.0, 0.3, -0.2, -0.6, -0.3};
  for (int i = 0; i < Planar::size; ++i) F.v[i] = S(F.v[i] + S(strain * dF[i]));
  return F;
}

/// One answer of a material: stress, consistent tangent, new memory.
template <class Material>
void respond(benchmark::State& state, double strain) {
  const Material material = bench::sheet_metal<Material>();
  Tensor<Real, Planar> F = stretch<Real>(strain);
  const typename Material::template State<Real, Planar> old{};
  for (auto _ : state) {
    benchmark::DoNotOptimize(F);
    auto answer = material.respond(F, old, 0);
    benchmark::DoNotOptimize(answer);
  }
  const auto counted = stretch<bench::Counted>(strain);
  const typename Material::template State<bench::Counted, Planar> none{};
  bench::report(state, bench::count([&] { benchmark::DoNotOptimize(material.respond(counted, none, 0)); }));
}

[[maybe_unused]] const benchmark::internal::Benchmark* const materials[] = {
    add("material/Hencky", &respond<Hencky>, bench::elastic),
    add("material/NeoHookean", &respond<NeoHookean>, bench::elastic),
    add("material/FiniteJ2<LinearHardening>/elastic", &respond<bench::J2Linear>, bench::elastic),
    add("material/FiniteJ2<LinearHardening>/plastic", &respond<bench::J2Linear>, bench::plastic),
    add("material/FiniteJ2<PowerHardening>/elastic", &respond<bench::J2Power>, bench::elastic),
    add("material/FiniteJ2<PowerHardening>/plastic", &respond<bench::J2Power>, bench::plastic),
    add("material/HypoelasticJ2<LinearHardening>/elastic", &respond<bench::HypoLinear>, bench::elastic),
    add("material/HypoelasticJ2<LinearHardening>/plastic", &respond<bench::HypoLinear>, bench::plastic),
};

}  // namespace
