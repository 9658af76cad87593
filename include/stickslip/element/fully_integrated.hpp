// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/gradient_operator.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>

namespace stickslip {

/// The plain displacement element. It locks as the material becomes incompressible: use it for compressible elasticity
/// and to see what the mean dilatation buys.
template <class Cell_ = Quad4>
struct FullyIntegrated {
  using Role = role::Element;
  using Cell = Cell_;
  static constexpr int dim = Cell::dim, nodes = Cell::nodes, points = Cell::points;

  template <class Kinematics, class G = Real>
  using Geometry = std::array<PointGeometry<Kinematics, nodes, G>, points>;

  /// The deformation gradients that the material sees at the points.
  template <class Kinematics, class G, class S>
  static std::array<Tensor<S, typename Kinematics::Shape>, points> deformation(
      const std::array<PointGeometry<Kinematics, nodes, G>, points>& geometry, const Vec<S, nodes * dim>& u) {
    std::array<Tensor<S, typename Kinematics::Shape>, points> F;
    for (std::size_t p = 0; p < points; ++p) F[p] = deformation_gradient(geometry[p], u);
    return F;
  }

  /// Nodal forces and tangent of one element (theory.md, eq. 2.4 and 2.5) for nodal displacements u.
  template <class Kinematics, class G, class Material, class State, class S>
  [[gnu::noinline]] static Cause evaluate(const std::array<PointGeometry<Kinematics, nodes, G>, points>& geometry,
                                          const Material& material, const Vec<S, nodes * dim>& u,
                                          const std::array<State, points>& old, Real dt,
                                          ElementResult<S, nodes * dim, points, State>& out) {
    using Shape = typename Kinematics::Shape;
    out.residual.setZero();
    out.tangent.setZero();
    for (std::size_t p = 0; p < points; ++p) {
      Deformation<S, Shape> deformation;
      deformation.H = displacement_gradient(geometry[p], u);
      deformation.F = plus_one(deformation.H);
      const S growth = determinant_less_one(deformation.H);
      if (!(value_of(growth) > -1)) return Cause::element_inverted;
      deformation.log_J = log_one_plus(growth);
      const auto answer = answer_of(material, deformation, old[p], dt);
      if (answer.cause != Cause::none) return answer.cause;
      const S weight = S(geometry[p].weight);
      add(out.residual, pull_back(geometry[p], answer.P), weight);
      const Moduli<S, Shape> M = scaled(answer.dP_dF, weight);
      add_congruence<Material::symmetry>(geometry[p], M, out.tangent);
      out.states[p] = answer.state;
    }
    if constexpr (Material::symmetry == Symmetry::symmetric) mirror(out.tangent);
    return Cause::none;
  }
};

}  // namespace stickslip
