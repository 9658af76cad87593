// SPDX-License-Identifier: BSL-1.0
#include "planar.hpp"

#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;
using Path = verify::DeformationPath<Planar>;

const F2 one = F2::identity();

const Hencky hencky{.young = 200e3, .poisson = 0.3};
const FiniteJ2<LinearHardening> linear{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 30, .modulus = 260}};
const FiniteJ2<PowerHardening> power{
    .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};

template <class Material>
Real plastic_strain(const Material& material, const Path& path) {
  return material.respond(path.back(), verify::detail::preloaded<Real, Planar>(material, path, 1), 1)
      .state.plastic_strain;
}
template <class Material>
bool yields(const Material& material, const Path& path) {
  const auto old = verify::detail::preloaded<Real, Planar>(material, path, 1);
  return material.respond(path.back(), old, 1).state.plastic_strain > old.plastic_strain;
}

// The shear that just makes a material yield, on the memory of a path: bisection on the switch.
template <class Material>
Real yield_shear(const Material& material) {
  Real low = 0, high = 0.1;
  for (int i = 0; i < 100; ++i) {
    const Real mid = 0.5 * (low + high);
    (yields(material, {gradient(1, mid, 0, 1.0001, 1)}) ? high : low) = mid;
  }
  return low;
}

const std::vector<Path> elastic_paths{
    {gradient(1.2, 0.3, -0.1, 0.9, 1.1)},
    {gradient(0.5, 0.8, -0.6, 1.7, 0.7)},
    {gradient(2.5, 0.1, 0, 0.4, 1)},
    {gradient(0, -1.1, 0.9, 0, 1)},  // a quarter turn
};
const std::vector<Path> plastic_paths{
    {gradient(1.2, 0.3, -0.1, 0.9, 1.1)},
    {gradient(1.1, 0, 0.2, 0.95, 1), gradient(1.4, 0.3, 0.2, 0.8, 1.05)},
    {gradient(1.01, 0.02, 0, 1, 1), gradient(1.3, -0.4, 0.3, 0.9, 0.8), gradient(1.9, -0.4, 0.6, 0.7, 0.7)},
};

template <class Material>
void check_path(const Material& material, const Path& path, Real step, Real accuracy) {
  const auto r = verify::material_tangent(material, path, 1, step);
  CHECK(r.by_duals < 1e-10);
  CHECK(r.by_differences < accuracy);
  CHECK(r.asymmetry < 1e-13);
  CHECK(verify::material_memory(material, path) < 1e-11);
}

TEST_CASE("Hencky's tangent is exact") {
  for (const Path& path : elastic_paths) check_path(hencky, path, 1e-4, 1e-9);
}

TEST_CASE("Hencky's stress is the gradient of its energy") {
  for (const Path& path : elastic_paths) {
    const auto F = path.back();
    const auto P = hencky.respond(F, {}, 1).P;
    Tensor<Dual<5>, Planar> dual;
    dual.v = verify::seeded<5>(F.v);
    const Vec<Real, 5> slope = hencky.energy(dual, {}).slope.matrix();
    CHECK(verify::relative_error(P.v, slope) < 1e-12);
  }
}

TEST_CASE_TEMPLATE("finite J2's tangent is exact in plastic flow", Material, FiniteJ2<LinearHardening>,
                   FiniteJ2<PowerHardening>) {
  const Material& material = []() -> const Material& {
    if constexpr (std::is_same_v<Material, FiniteJ2<LinearHardening>>)
      return linear;
    else
      return power;
  }();
  for (const Path& path : plastic_paths) {
    CHECK(yields(material, path));
    check_path(material, path, 1e-4, 1e-8);
  }
}

TEST_CASE_TEMPLATE("finite J2's tangent is exact in elastic loading and in unloading after flow", Material,
                   FiniteJ2<LinearHardening>, FiniteJ2<PowerHardening>) {
  const Material& material = []() -> const Material& {
    if constexpr (std::is_same_v<Material, FiniteJ2<LinearHardening>>)
      return linear;
    else
      return power;
  }();
  const Path small{gradient(1.0002, 0.0001, 0, 0.9999, 1)};
  CHECK_FALSE(yields(material, small));
  check_path(material, small, 1e-6, 1e-9);
  const Path back{gradient(1.2, 0.3, -0.1, 0.9, 1.1), gradient(1.2 * 0.9999, 0.3 * 1.0001, -0.1, 0.9, 1.1)};
  CHECK_FALSE(yields(material, back));
  CHECK(plastic_strain(material, back) > 0.1);
  check_path(material, back, 1e-6, 1e-9);
}

TEST_CASE_TEMPLATE("finite J2's tangent is exact on either side of the yield switch", Material,
                   FiniteJ2<LinearHardening>, FiniteJ2<PowerHardening>) {
  const Material& material = []() -> const Material& {
    if constexpr (std::is_same_v<Material, FiniteJ2<LinearHardening>>)
      return linear;
    else
      return power;
  }();
  const Real switch_at = yield_shear(material);
  const Path below{gradient(1, switch_at * (1 - 1e-7), 0, 1.0001, 1)},
      above{gradient(1, switch_at * (1 + 1e-7), 0, 1.0001, 1)};
  CHECK_FALSE(yields(material, below));
  CHECK(yields(material, above));
  const auto r = verify::material_tangent(material, below), s = verify::material_tangent(material, above);
  CHECK(r.by_duals < 1e-10);
  CHECK(s.by_duals < 1e-10);
  // The two tangents differ: the switch is a kink, not a smooth turn.
  const auto elastic = material.respond(below.back(), {}, 1).dP_dF,
             plastic = material.respond(above.back(), {}, 1).dP_dF;
  CHECK(verify::relative_error(plastic, elastic) > 0.05);
  // The stress does not jump.
  CHECK(verify::relative_error(material.respond(above.back(), {}, 1).P.v, material.respond(below.back(), {}, 1).P.v) <
        1e-6);
}

TEST_CASE("tangents are exact where principal stretches coincide") {
  const std::vector<Path> equal{
      {one}, {gradient(1.3, 0, 0, 1.3, 1)}, {gradient(1.2, 0, 0, 1.2, 1.2)}, {gradient(0, -0.8, 0.8, 0, 1.1)}};
  for (const Path& path : equal) {
    const auto r = verify::material_tangent(hencky, path);
    CHECK(r.by_differences < 1e-9);
    CHECK(r.asymmetry < 1e-14);
  }
  for (const Path& path : equal) {
    // Without deviator the step must stay elastic on both sides.
    const Real step = value_of(path.back()(2, 2)) == value_of(path.back()(0, 0)) ? 1e-6 : 1e-4;
    CHECK(verify::material_tangent(linear, path, 1, step).by_differences < 1e-8);
    CHECK(verify::material_tangent(power, path, 1, step).by_differences < 1e-8);
    CHECK(verify::material_tangent(linear, path, 1, step).asymmetry < 1e-13);
  }
  const Path preloaded{gradient(1.2, 0.3, -0.1, 0.9, 1.1), gradient(1.3, 0, 0, 1.3, 0.6)};
  CHECK(verify::material_tangent(linear, preloaded).by_differences < 1e-8);
  CHECK(verify::material_tangent(linear, preloaded).by_duals < 1e-10);
}

TEST_CASE("tangents are exact where principal stretches nearly coincide") {
  for (const Real gap : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12, 1e-15}) {
    const F2 F = gradient(1.2 + gap, 0, 0, 1.2, 0.9);
    const auto near = hencky.respond(F, {}, 1).dP_dF, at = hencky.respond(gradient(1.2, 0, 0, 1.2, 0.9), {}, 1).dP_dF;
    CHECK(verify::relative_error(near, at) < 10 * gap + 1e-13);
    CHECK(verify::material_tangent(hencky, Path{F}).by_differences < 1e-9);
    CHECK(verify::material_tangent(linear, Path{F}).by_differences < 1e-8);
  }
}

TEST_CASE("plastic flow keeps the volume, and the elastic energy gives the stress") {
  for (const Path& path : plastic_paths) {
    const auto r = power.respond(path.back(), verify::detail::preloaded<Real, Planar>(power, path, 1), 1);
    CHECK(determinant(r.state.Cp_inverse.full()) == doctest::Approx(1).epsilon(1e-12));
    // P = dW/dF at fixed memory: the return map leaves the elastic strain that carries the stress.
    Tensor<Dual<5>, Planar> dual;
    dual.v = verify::seeded<5>(path.back().v);
    FiniteJ2<PowerHardening>::State<Dual<5>, Planar> state;
    state.Cp_inverse.v = r.state.Cp_inverse.v.template cast<Dual<5>>();
    const Vec<Real, 5> slope = power.energy(dual, state).slope.matrix();
    CHECK(verify::relative_error(r.P.v, slope) < 1e-11);
    // On the yield surface.
    const Real tau = von_mises(kirchhoff(r.P, path.back()));
    CHECK(tau == doctest::Approx(power.hardening.flow(r.state.plastic_strain).value).epsilon(1e-12));
  }
}

struct Wrong : Hencky {
  template <class S, class TensorPattern>
  auto respond(const Tensor<S, TensorPattern>& F, const State<S, TensorPattern>& old, Real dt) const {
    auto out = Hencky::respond(F, old, dt);
    out.dP_dF(0, 3) *= S(1.001);
    return out;
  }
};

TEST_CASE("the tangent checks detect a wrong tangent") {
  const auto r = verify::material_tangent(Wrong{{hencky}}, elastic_paths[0]);
  CHECK(r.by_duals > 1e-5);
  CHECK(r.by_differences > 1e-5);
  CHECK(r.asymmetry > 1e-5);
}

}  // namespace
