// SPDX-License-Identifier: BSL-1.0
#include "laws.hpp"
#include "report.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/element/hex8.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>

namespace {

using namespace stickslip;
using bench::add;

/// An element, somewhat distorted, with displacements of the given strain; a hexahedron is a layer of the
/// quadrilateral. Condensed unknowns are open, as in Newton's loop, at the values of these displacements.
template <class Kinematics, class Element, class Material, class S>
struct One {
  static constexpr int dim = Element::dim, nodes = Element::nodes, points = Element::points, dofs = nodes * dim;
  using State = typename Material::template State<S, typename Kinematics::TensorPattern>;
  typename Element::template Geometry<Kinematics> geometry;
  Material material = bench::sheet_metal<Material>();
  Vec<S, dofs> u;
  std::array<State, points> old{};
  ElementResult<S, dofs, points, State> out;
  static constexpr int unknowns = condensed_unknowns<Element>;
  CondensedUnknown<S, dofs, unknowns == 0 ? 1 : unknowns> condensed;

  explicit One(double strain) {
    const double corner[4][2] = {{10, 0}, {11, 0.1}, {11.2, 0.9}, {9.9, 1}};
    const double direction[4][2] = {{0.1, 0}, {1, -0.1}, {0.9, -0.8}, {0, -1}};
    Mat<Real, nodes, dim> X;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i) {
        X(a, i) = i < 2 ? corner[a % 4][i] : a / 4 + 0.1 * corner[a % 4][0];
        u[a * dim + i] = S(strain * (i < 2 ? direction[a % 4][i] : 0.3 * direction[a % 4][0] - 0.4 * (a / 4)));
      }
    geometry = geometry_of<Element>(Kinematics{}, X);
    evaluate(Relation::closed);
  }
  FailureCause evaluate([[maybe_unused]] Relation relation = Relation::open, Want want = Want::tangent) {
    if constexpr (unknowns > 0)
      return evaluate_element<Element>(geometry, material, u, old, 0, out, want, condensed, relation);
    else
      return evaluate_element<Element>(geometry, material, u, old, 0, out, want);
  }
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
using Bends = AssumedStrain<Quad4>;
using H1P0 = MeanDilatation<Hex8>;
using H1Bends = AssumedStrain<Hex8>;
using H1 = FullyIntegrated<Hex8>;
[[maybe_unused]] const benchmark::internal::Benchmark* const elements[] = {
    add("element/PlaneStrain/FullyIntegrated/Hencky", &evaluate<PlaneStrain, Q1, Hencky>, bench::elastic),
    add("element/PlaneStrain/MeanDilatation/Hencky", &evaluate<PlaneStrain, Q1P0, Hencky>, bench::elastic),
    add("element/PlaneStrain/AssumedStrain/Hencky", &evaluate<PlaneStrain, Bends, Hencky>, bench::elastic),
    add("element/Axisymmetric/FullyIntegrated/Hencky", &evaluate<Axisymmetric, Q1, Hencky>, bench::elastic),
    add("element/Axisymmetric/MeanDilatation/Hencky", &evaluate<Axisymmetric, Q1P0, Hencky>, bench::elastic),
    add("element/Axisymmetric/AssumedStrain/Hencky", &evaluate<Axisymmetric, Bends, Hencky>, bench::elastic),
    add("element/PlaneStrain/MeanDilatation/J2Power/plastic", &evaluate<PlaneStrain, Q1P0, bench::J2Power>,
        bench::plastic),
    add("element/PlaneStrain/AssumedStrain/J2Power/plastic", &evaluate<PlaneStrain, Bends, bench::J2Power>,
        bench::plastic),
    add("element/Axisymmetric/MeanDilatation/J2Power/elastic", &evaluate<Axisymmetric, Q1P0, bench::J2Power>,
        bench::elastic),
    add("element/Axisymmetric/MeanDilatation/J2Power/plastic", &evaluate<Axisymmetric, Q1P0, bench::J2Power>,
        bench::plastic),
    add("element/Axisymmetric/AssumedStrain/J2Power/plastic", &evaluate<Axisymmetric, Bends, bench::J2Power>,
        bench::plastic),
    add("element/ThreeDimensional/FullyIntegrated/Hencky", &evaluate<ThreeDimensional, H1, Hencky>, bench::elastic),
    add("element/ThreeDimensional/MeanDilatation/Hencky", &evaluate<ThreeDimensional, H1P0, Hencky>, bench::elastic),
    add("element/ThreeDimensional/AssumedStrain/Hencky", &evaluate<ThreeDimensional, H1Bends, Hencky>, bench::elastic),
    add("element/ThreeDimensional/MeanDilatation/J2Power/plastic", &evaluate<ThreeDimensional, H1P0, bench::J2Power>,
        bench::plastic),
    add("element/ThreeDimensional/AssumedStrain/J2Power/plastic", &evaluate<ThreeDimensional, H1Bends, bench::J2Power>,
        bench::plastic),
};

}  // namespace
