// SPDX-License-Identifier: BSL-1.0
#include "laws.hpp"
#include "report.hpp"

#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>

namespace {

using namespace stickslip;
using bench::add;

/// An element, somewhat distorted, with displacements of the given strain.
template <class Kinematics, class Element, class Material, class S>
struct One {
  using State = typename Material::template State<S, typename Kinematics::Shape>;
  typename Element::template Geometry<Kinematics> geometry;
  Material material = bench::sheet_metal<Material>();
  Vec<S, 8> u;
  std::array<State, 4> old{};
  ElementResult<S, 8, 4, State> out;

  explicit One(double strain) {
    Mat<Real, 4, 2> X;
    X << 10, 0, 11, 0.1, 11.2, 0.9, 9.9, 1;
    const auto rule = Element::Cell::quadrature();
    for (std::size_t p = 0; p < rule.size(); ++p)
      geometry[p] = point_geometry<Kinematics, typename Element::Cell>(Kinematics{}, X, rule[p].xi, rule[p].weight);
    const double direction[] = {0.1, 0, 1, -0.1, 0.9, -0.8, 0, -1};
    for (int i = 0; i < 8; ++i) u[i] = S(strain * direction[i]);
  }
  Cause evaluate() { return Element::evaluate(geometry, material, u, old, 0, out); }
};

/// Forces and tangent of one element.
template <class Kinematics, class Element, class Material>
void evaluate(benchmark::State& state, double strain) {
  One<Kinematics, Element, Material, Real> element(strain);
  for (auto _ : state) {
    benchmark::DoNotOptimize(element.u);
    benchmark::DoNotOptimize(element.evaluate());
    benchmark::DoNotOptimize(element.out);
  }
  state.SetItemsProcessed(state.iterations());
  One<Kinematics, Element, Material, bench::Counted> counted(strain);
  bench::report(state, bench::count([&] { benchmark::DoNotOptimize(counted.evaluate()); }));
}

using Q1P0 = MeanDilatation<Quad4>;
using Q1 = FullyIntegrated<Quad4>;
[[maybe_unused]] const benchmark::internal::Benchmark* const elements[] = {
    add("element/PlaneStrain/FullyIntegrated/Hencky", &evaluate<PlaneStrain, Q1, Hencky>, bench::elastic),
    add("element/Axisymmetric/FullyIntegrated/Hencky", &evaluate<Axisymmetric, Q1, Hencky>, bench::elastic),
    add("element/Axisymmetric/MeanDilatation/Hencky", &evaluate<Axisymmetric, Q1P0, Hencky>, bench::elastic),
    add("element/PlaneStrain/MeanDilatation/J2Power/plastic", &evaluate<PlaneStrain, Q1P0, bench::J2Power>,
        bench::plastic),
    add("element/Axisymmetric/MeanDilatation/J2Power/elastic", &evaluate<Axisymmetric, Q1P0, bench::J2Power>,
        bench::elastic),
    add("element/Axisymmetric/MeanDilatation/J2Power/plastic", &evaluate<Axisymmetric, Q1P0, bench::J2Power>,
        bench::plastic),
};

}  // namespace
