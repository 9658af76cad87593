// SPDX-License-Identifier: BSL-1.0
// The materials' tangents in three dimensions: all nine components of F.
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/material/neo_hookean.hpp>
#include <stickslip/verify/material.hpp>

#include <doctest/doctest.h>

namespace {

using namespace stickslip;
using F3 = Tensor<Real, Spatial>;
using Path = verify::DeformationPath<Spatial>;

F3 gradient(const Mat<Real, 3>& m) {
  F3 F;
  for (const auto& [i, j] : Spatial::pairs) F(i, j) = m(i, j);
  return F;
}
F3 stretch(Real a, Real b, Real c, Real angle = 0) {
  const F3 Q = verify::rotation<Spatial>(angle);
  return product(product(Q, gradient(Vec<Real, 3>(a, b, c).asDiagonal())), transpose(Q));
}
const F3 first = gradient(Mat<Real, 3>{{1.2, 0.3, -0.2}, {-0.1, 0.9, 0.15}, {0.25, -0.05, 1.1}});
const F3 second = gradient(Mat<Real, 3>{{1.4, -0.4, 0.3}, {0.2, 0.8, -0.35}, {-0.1, 0.45, 0.95}});
const F3 quarter_turn = product(verify::rotation<Spatial>(pi / 2), second);

const Hencky hencky{.young = 200e3, .poisson = 0.3};
const FiniteJ2<LinearHardening> linear{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 30, .modulus = 260}};
const FiniteJ2<PowerHardening> power{
    .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};

const NeoHookean neo_hookean{.young = 200e3, .poisson = 0.3};
const HypoelasticJ2<LinearHardening> hypoelastic{
    .young = 69e3, .poisson = 0.33, .hardening = {.yield = 30, .modulus = 260}};

template <class Material>
void check_path(const Material& material, const Path& path, Real step, Real accuracy) {
  const auto r = verify::material_tangent(material, path, 1, step);
  CHECK(r.by_duals < 1e-10);
  CHECK(r.by_differences < accuracy);
  if constexpr (Material::symmetry == Symmetry::symmetric) CHECK(r.asymmetry < 1e-13);
  CHECK(verify::material_memory(material, path) < 1e-11);
  for (const Real angle : {1e-3, 0.7, 2.9}) CHECK(verify::material_objectivity(material, path, angle) < 1e-11);
}
template <class Material>
bool yields(const Material& material, const Path& path) {
  const auto old = verify::detail::preloaded<Real, Spatial>(material, path, 1);
  return material.respond(path.back(), old, 1).state.plastic_strain > old.plastic_strain;
}

TEST_CASE("hyperelastic tangents in space are exact") {
  for (const Path& path : {Path{first}, Path{second}, Path{quarter_turn}}) {
    check_path(hencky, path, 1e-4, 1e-9);
    check_path(neo_hookean, path, 1e-4, 1e-9);
  }
}

TEST_CASE("finite J2's tangent in space is exact in flow, elastic loading and unloading") {
  const auto check = [](const auto& material) {
    for (const Path& path : {Path{first}, Path{first, second}, Path{second, first, quarter_turn}}) {
      CHECK(yields(material, path));
      check_path(material, path, 1e-4, 1e-8);
    }
    F3 small = F3::identity(), back = first;
    small.v += 2e-4 * first.v;
    back.v *= 0.9999;
    back(0, 1) *= 0.9999;
    CHECK_FALSE(yields(material, {small}));
    check_path(material, {small}, 1e-6, 1e-9);
    CHECK_FALSE(yields(material, {first, back}));
    check_path(material, {first, back}, 1e-6, 1e-9);
  };
  check(linear);
  check(power);
}

TEST_CASE("hypoelastic J2's tangent in space is exact in flow") {
  for (const Path& path : {Path{first}, Path{first, second}, Path{second, first, quarter_turn}}) {
    CHECK(yields(hypoelastic, path));
    check_path(hypoelastic, path, 1e-4, 1e-8);
  }
}

TEST_CASE("plastic flow in space keeps the volume and stays on the yield surface") {
  for (const Path& path : {Path{first}, Path{first, second}}) {
    const auto r = power.respond(path.back(), verify::detail::preloaded<Real, Spatial>(power, path, 1), 1);
    CHECK(determinant(r.state.Cp_inverse.full()) == doctest::Approx(1).epsilon(1e-12));
    CHECK(von_mises(kirchhoff(r.P, path.back())) ==
          doctest::Approx(power.hardening.flow(r.state.plastic_strain).value).epsilon(1e-12));
  }
}

TEST_CASE("tangents in space are exact where principal stretches coincide or nearly do") {
  for (const Real angle : {0.0, 0.8})
    for (const Real gap : {0.0, 1e-15, 1e-12, 1e-8, 1e-6, 1e-4, 1e-2}) {
      const F3 two = stretch(1.2, 0.9, 1.2 + gap, angle), three = stretch(1.1, 1.1 + gap, 1.1 - gap, angle);
      for (const auto& [F, limit] :
           {std::pair(two, stretch(1.2, 0.9, 1.2, angle)), std::pair(three, stretch(1.1, 1.1, 1.1, angle))}) {
        const auto near = hencky.respond(F, {}, 1).dP_dF, at = hencky.respond(limit, {}, 1).dP_dF;
        CHECK(verify::relative_error(near, at) < 10 * gap + 1e-13);
        const auto r = verify::material_tangent(hencky, Path{F});
        CHECK(r.by_differences < 1e-9);
        CHECK(r.asymmetry < 1e-13);
      }
      CHECK(verify::material_tangent(linear, Path{two}).by_differences < 1e-8);
      CHECK(verify::material_tangent(power, Path{two}).by_differences < 1e-8);
      // After flow the trial's principal values coincide no more.
      CHECK(verify::material_tangent(linear, Path{first, two}).by_duals < 1e-10);
    }
  CHECK(verify::material_tangent(hencky, Path{F3::identity()}).by_differences < 1e-9);
}

TEST_CASE("a plane deformation gradient has the same stress and moduli in the spatial law") {
  Tensor<Real, Planar> F, before;
  F.v << 1.3, -0.4, 0.3, 0.9, 0.8;
  before.v << 1.1, 0.2, 0.1, 0.95, 1.0;
  const auto spatial = [](const Tensor<Real, Planar>& plane) {
    F3 filled;
    for (const auto& [i, j] : Planar::pairs) filled(i, j) = plane(i, j);
    return filled;
  };
  const auto plane = power.respond(F, power.respond(before, {}, 1).state, 1);
  const auto space = power.respond(spatial(F), power.respond(spatial(before), {}, 1).state, 1);
  CHECK(space.state.plastic_strain == doctest::Approx(plane.state.plastic_strain).epsilon(1e-12));
  const Real stress = plane.P.v.cwiseAbs().maxCoeff(), modulus = plane.dP_dF.cwiseAbs().maxCoeff();
  for (const auto& [i, j] : Spatial::pairs) {
    const bool in_plane = Planar::couples(i, j);
    CHECK(std::abs(space.P(i, j) - (in_plane ? plane.P(i, j) : 0)) < 1e-12 * stress);
    for (const auto& [k, l] : Spatial::pairs) {
      if (in_plane != Planar::couples(k, l))
        CHECK(std::abs(space.dP_dF(Spatial::at(i, j), Spatial::at(k, l))) < 1e-12 * modulus);
      else if (in_plane)
        CHECK(std::abs(space.dP_dF(Spatial::at(i, j), Spatial::at(k, l)) -
                       plane.dP_dF(Planar::at(i, j), Planar::at(k, l))) < 1e-12 * modulus);
    }
  }
}

}  // namespace
