// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/gradient_operator.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>

namespace stickslip {

/// Fully integrated displacement element. It locks in the incompressible limit: use it for compressible elasticity and
/// to compare with MeanDilatation.
template <class Cell_ = Quad4>
struct FullyIntegrated {
  using Role = role::Element;
  using Cell = Cell_;
  static constexpr bool takes_want = true, locks_in_bending = true;
  static constexpr int dim = Cell::dim, nodes = Cell::nodes, points = Cell::points;

  template <class Kinematics>
  using Geometry = std::array<PointGeometry<Kinematics, nodes>, points>;

  /// Deformation gradients that enter the material law at the quadrature points [-].
  template <class Kinematics, class S>
  static std::array<Tensor<S, typename Kinematics::TensorPattern>, points> deformation(
      const std::array<PointGeometry<Kinematics, nodes>, points>& geometry, const Vec<S, nodes * dim>& u) {
    std::array<Tensor<S, typename Kinematics::TensorPattern>, points> F;
    for (std::size_t p = 0; p < points; ++p) F[p] = deformation_gradient(geometry[p], u);
    return F;
  }

  /// Nodal forces and tangent of one element (theory.md, eq. 2.4 and 2.5) for nodal displacements u.
  template <class Kinematics, class Material, class State, class S>
  [[gnu::noinline]] static FailureCause evaluate(
      const std::array<PointGeometry<Kinematics, nodes>, points>& geometry, const Material& material,
      const Vec<S, nodes * dim>& u, const std::array<State, points>& old, Real dt,
      ElementResult<S, nodes * dim, points, State>& out, Want want = Want::tangent) {
    using TensorPattern = typename Kinematics::TensorPattern;
    const bool with_tangent = want != Want::residual;
    out.residual.setZero();
    if (with_tangent) out.tangent.setZero();
    for (std::size_t p = 0; p < points; ++p) {
      Deformation<S, TensorPattern> deformation;
      deformation.H = displacement_gradient(geometry[p], u);
      deformation.F = plus_one(deformation.H);
      const S growth = determinant_less_one(deformation.H);
      if (!(value_of(growth) > -1)) return FailureCause::element_inverted;
      deformation.log_J = log_one_plus(growth);
      const auto answer = answer_of(material, deformation, old[p], dt);
      if (answer.cause != FailureCause::none) return answer.cause;
      const S weight = S(geometry[p].weight);
      add(out.residual, internal_force(geometry[p], answer.P), weight);
      out.states[p] = answer.state;
      if (!with_tangent) continue;
      const Moduli<S, TensorPattern> M = scaled(answer.dP_dF, weight);
      add_BtMB<Material::symmetry>(geometry[p], M, out.tangent);
    }
    if (with_tangent && Material::symmetry == Symmetry::symmetric) copy_lower_to_upper(out.tangent);
    return FailureCause::none;
  }
};

}  // namespace stickslip
