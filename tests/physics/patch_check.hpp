// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <doctest/doctest.h>

#include <map>

namespace scene {

/// A homogeneous field u = H X imposed on the boundary of a mesh, the nodes of `sides`: it must hold at the `inside`
/// other nodes, with constant P.
template <class M, class MeshType>
void check_patch(MeshType mesh, const std::vector<const char*>& sides, const Mat<Real, M::Kinematics::dim>& H,
                 Index steps, Index inside) {
  constexpr int dim = M::Kinematics::dim;
  // A side for every node of the boundary.
  std::map<Index, std::string> boundary;
  for (const char* side : sides)
    for (const Index n : mesh.sides[side].nodes) boundary[n] = "node " + std::to_string(n);
  for (const auto& [n, name] : boundary) mesh.sides[name].nodes = {n};
  Problem<M> p({.body = mesh, .material = material<typename M::Material>()});
  for (const auto& [n, name] : boundary) {
    const Vec<Real, dim> u = H * mesh.nodes[std::size_t(n)];
    for (int i = 0; i < dim; ++i) p.drive(name, i, [v = u[i]](Real t) { return t * v; });
  }
  auto march = p.march({.end = 1, .steps = steps, .tolerance = 1e-13});
  CHECK(bool(march.finish()));
  CHECK(mesh.node_count() - static_cast<Index>(boundary.size()) == inside);
  CHECK(p.unknowns() == inside * dim);
  Real worst = 0;
  for (Index n = 0; n < mesh.node_count(); ++n)
    worst = std::max(worst, (p.displacement(n) - H * mesh.nodes[std::size_t(n)]).norm());
  CHECK(worst < 1e-10);
  constexpr int size = M::Kinematics::TensorPattern::size;
  Vec<Real, size> first = Vec<Real, size>::Zero();
  Real spread = 0, scale = 0;
  p.body().visit_points(p.displacement(), [&](Index e, int q, const auto& F, const auto& state, Real) {
    const Vec<Real, size> P = p.body().material().respond(F, state, 0).P.v;
    if (e == 0 && q == 0) first = P;
    spread = std::max(spread, (P - first).norm());
    scale = std::max(scale, P.norm());
  });
  CHECK(scale > 1);
  CHECK(spread < 1e-10 * scale);
  if constexpr (!std::is_same_v<typename M::Material, Hencky>) CHECK(p.max_plastic_strain() > 0.01);
}

}  // namespace scene
