// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/assumed_strain_geometry.hpp>
#include <stickslip/element/assumed_strain_kernel.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/policy/element.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stickslip {

/// Element for bending: of the shears that vary in the element only the twist is kept, stretches that are linear along
/// their own direction are added, and the dilatation is linear (theory.md, eq. 2.14-2.22). Stretches and dilatations
/// are condensed unknowns. Forces and tangent are derivatives of one potential, so the tangent is symmetric whenever
/// the material's is. No parameter is tuned.
template <class Cell_ = Quad4>
struct AssumedStrain {
  using Role = role::Element;
  using Cell = Cell_;
  static constexpr bool takes_want = true, locks_in_varied_strain = true;
  static constexpr int dim = Cell::dim, nodes = Cell::nodes, points = Cell::points, dofs = nodes * dim;
  static constexpr int stretches = dim, dilatations = dim + 1;
  static constexpr int condensed_unknowns = stretches + dilatations;  ///< alpha_j, then theta_k [-]

  template <class Kinematics>
  using Geometry = AssumedStrainGeometry<Kinematics, Cell>;
  template <class Kinematics>
  static Geometry<Kinematics> geometry(const Kinematics& kinematics, const Mat<Real, nodes, dim>& X) {
    return {kinematics, X};
  }

  /// Deformation gradients that enter the material law at the quadrature points [-], for the value of the condensed
  /// unknowns.
  template <class Kinematics, class S>
  static std::array<Tensor<S, typename Kinematics::TensorPattern>, points> deformation(
      const AssumedStrainGeometry<Kinematics, Cell>& geometry, const Vec<S, dofs>& u,
      const Vec<S, condensed_unknowns>& value) {
    AssumedStrainKernel<Kinematics, Cell, S> kernel(geometry, u);
    std::array<Tensor<S, typename Kinematics::TensorPattern>, points> F;
    kernel.strain(stretches_of(value));
    for (std::size_t p = 0; p < points; ++p) F[p] = kernel.seen(p, dilatations_of(value)).F;
    return F;
  }

  /// Nodal forces and tangent of one element for nodal displacements u.
  template <class Kinematics, class Material, class State, class S>
  [[gnu::noinline]] static FailureCause evaluate(const AssumedStrainGeometry<Kinematics, Cell>& geometry,
                                                 const Material& material, const Vec<S, dofs>& u,
                                                 const std::array<State, points>& old, Real dt,
                                                 ElementResult<S, dofs, points, State>& out,
                                                 CondensedUnknown<S, dofs, condensed_unknowns>& condensed,
                                                 Relation relation, Want want = Want::tangent) {
    constexpr Symmetry symmetry = Material::symmetry;
    AssumedStrainKernel<Kinematics, Cell, S> kernel(geometry, u);
    if (!kernel.sound()) return FailureCause::element_inverted;
    Vec<S, stretches> alpha = stretches_of(condensed.value);
    Vec<S, dilatations> theta = dilatations_of(condensed.value);
    // Evaluates everything at alpha, and at theta or, where that relation is closed, at theta(u, alpha).
    const auto at = [&](Want wanted) {
      if (!kernel.strain(alpha)) return FailureCause::element_inverted;
      if (relation == Relation::closed) theta = kernel.dilatations_now();
      for (std::size_t p = 0; p < points; ++p) {
        const auto seen = kernel.seen(p, theta);
        const auto answer = answer_of(material, seen, old[p], dt);
        if (answer.cause != FailureCause::none) return answer.cause;
        out.states[p] = answer.state;
        kernel.take(p, answer.P, answer.dP_dF);
      }
      if (wanted == Want::residual && symmetry == Symmetry::symmetric)
        kernel.template assemble<symmetry, false>(theta);
      else
        kernel.template assemble<symmetry, true>(theta);
      return FailureCause::none;
    };

    if (relation == Relation::closed)
      if (const FailureCause cause = close(kernel, alpha, at); cause != FailureCause::none) return cause;
    if (const FailureCause cause = at(want); cause != FailureCause::none) return cause;
    if (relation == Relation::closed) {
      for (int j = 0; j < stretches; ++j) condensed.value[j] = alpha[j];
      for (int k = 0; k < dilatations; ++k) condensed.value[stretches + k] = theta[k];
    }
    return kernel.template condense<symmetry>(out.residual, out.tangent, condensed, relation, want != Want::residual);
  }

 private:
  template <class S>
  static Vec<S, stretches> stretches_of(const Vec<S, condensed_unknowns>& value) {
    Vec<S, stretches> alpha;
    for (int j = 0; j < stretches; ++j) alpha[j] = value[j];
    return alpha;
  }
  template <class S>
  static Vec<S, dilatations> dilatations_of(const Vec<S, condensed_unknowns>& value) {
    Vec<S, dilatations> theta;
    for (int k = 0; k < dilatations; ++k) theta[k] = value[stretches + k];
    return theta;
  }

  // Solves the relation of the stretches by Newton's method from alpha. The last correction is taken without looking
  // at its residual, so that derivatives carried along are exact as well.
  template <class Kernel, class S, class At>
  static FailureCause close(Kernel& kernel, Vec<S, stretches>& alpha, At&& at) {
    constexpr int most = 40;
    constexpr Real small = 1e-9;
    FailureCause cause = at(Want::residual);
    if (cause != FailureCause::none) return cause;
    for (int iteration = 0; iteration < most; ++iteration) {
      Vec<S, stretches> step;
      if (!kernel.stretch_step(step)) return FailureCause::singular_matrix;
      const Real force = kernel.stretch_force();
      Real largest = 0;
      for (int j = 0; j < stretches; ++j) largest = std::max(largest, std::abs(value_of(step[j])));
      if (!std::isfinite(largest)) return FailureCause::not_finite;
      const Vec<S, stretches> start = alpha;
      if (largest <= small) {
        alpha = start + step;
        return FailureCause::none;
      }
      for (Real length = 1;; length *= 0.5) {
        if (length < 1e-3) return cause != FailureCause::none ? cause : FailureCause::not_converged;
        alpha = start;
        add(alpha, step, S(length));
        cause = at(Want::residual);
        if (cause == FailureCause::none && kernel.stretch_force() < force) break;
      }
    }
    return FailureCause::not_converged;
  }
};

}  // namespace stickslip
