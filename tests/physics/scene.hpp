// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/no_contact.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

namespace scene {

using namespace stickslip;
using V = Vec<Real, 2>;

template <class S, class F = Frictionless, class M = Hencky, class K = PlaneStrain, class E = MeanDilatation<Quad4>,
          class C = Penalty>
struct Model {
  using Kinematics = K;
  using Element = E;
  using Material = M;
  using Friction = F;
  using Enforcement = C;
  using TimeIntegration = Quasistatic;
  using LinearSolver = S;
};
/// A body alone.
template <class S, class M = Hencky, class K = PlaneStrain, class E = MeanDilatation<Quad4>>
using Lone = Model<S, Frictionless, M, K, E, NoContact>;

template <class Material>
Material material() {
  if constexpr (std::is_same_v<Material, Hencky>)
    return {.young = 69004, .poisson = 0.3};
  else if constexpr (std::is_same_v<Material, FiniteJ2<LinearHardening>>)
    return {.young = 69004, .poisson = 0.3, .hardening = {.yield = 100, .modulus = 500}};
  else
    return {.young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};
}

/// Moves the nodes within a mesh of the unit square, and along its sides, by a smooth field that vanishes at the
/// corners.
template <class MeshType>
MeshType distorted(MeshType mesh, Real amount = 0.06) {
  for (auto& x : mesh.nodes) {
    const Real a = std::sin(pi * x[0]), b = std::sin(pi * x[1]);
    x += V(amount * a * std::cos(2.3 * x[1] + 0.4), amount * b * std::cos(3.1 * x[0] + 0.2));
  }
  return mesh;
}

/// Moves the nodes by up to 1e-9 of the largest coordinate, in another way for each seed and not for 0: another
/// round-off.
template <class MeshType>
MeshType disturbed(MeshType mesh, unsigned seed) {
  unsigned random = seed;
  Real largest = 0;
  for (const auto& x : mesh.nodes) largest = std::max(largest, x.cwiseAbs().maxCoeff());
  for (auto& x : mesh.nodes)
    for (auto& c : x) {
      random = random * 1664525u + 1013904223u;
      if (seed > 0) c += 1e-9 * largest * (Real(random >> 8) / (1 << 23) - 1);
    }
  return mesh;
}

/// A block of 10 x 5, its top held along x and pushed down by `press` onto a disc, which from
/// time 0.3 on is dragged along with the speed `drag`. `stiffening` multiplies the penalties, `sticking` the tangential
/// one if it is given; the mesh is disturbed by `seed`.
template <class M>
std::unique_ptr<Problem<M>> press_and_drag(Real mu, Real press = 0.5, Real drag = 1,
                                           std::array<Index, 2> cells = {8, 4}, Real stiffening = 1, Real sticking = 0,
                                           unsigned seed = 0) {
  Contact<M> contact{
      .side = "bottom",
      .tool = rigid::disc({5, -20}, 20),
      .motion = [drag](Real t) { return V(drag * std::max(0.0, t - 0.3), 0); },
      .enforcement = {.normal = 1e5 * stiffening, .tangential = 2e4 * (sticking > 0 ? sticking : stiffening)},
      .name = "tool"};
  if constexpr (has_friction<M>) contact.friction = {.mu = mu};
  auto problem = std::make_unique<Problem<M>>(
      typename Problem<M>::Parameters{.body = disturbed(mesh::rectangle({.size = {10, 5}, .cells = cells}), seed),
                                      .material = material<typename M::Material>(),
                                      .contacts = {contact}});
  problem->hold("top", 0).drive("top", 1, [press](Real t) { return -press * t; });
  return problem;
}

}  // namespace scene
