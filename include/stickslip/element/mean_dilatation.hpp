// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/gradient_operator.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stickslip {

/// Q1/P0 element: the dilatation is the element mean, theta = v/V, and the material law takes F_bar = (theta/J)^(1/3)
/// F. Pressure and dilatation are condensed exactly: forces and tangent are the first and second derivative of one
/// potential sum_p w_p W(F_bar_p(u)), so the tangent is symmetric whenever the material's is (theory.md, eq. 2.6-2.12;
/// after Simo, Taylor & Pister 1985).
template <class Cell_ = Quad4>
struct MeanDilatation {
  using Role = role::Element;
  using Cell = Cell_;
  static constexpr int condensed_unknowns = 1;  ///< ln theta
  static constexpr bool takes_want = true, locks_in_bending = true;
  static constexpr int dim = Cell::dim, nodes = Cell::nodes, points = Cell::points, dofs = nodes * dim;

  template <class Kinematics>
  using Geometry = std::array<PointGeometry<Kinematics, nodes>, points>;

  /// Deformation gradients F_bar that enter the material law at the quadrature points [-], ln theta being the value of
  /// the condensed unknown.
  template <class Kinematics, class S>
  static std::array<Tensor<S, typename Kinematics::TensorPattern>, points> deformation(
      const std::array<PointGeometry<Kinematics, nodes>, points>& geometry, const Vec<S, dofs>& u,
      const S& log_theta) {
    std::array<Tensor<S, typename Kinematics::TensorPattern>, points> F;
    for (std::size_t p = 0; p < points; ++p) {
      const auto H = displacement_gradient(geometry[p], u);
      const S stretch = exp_less_one((log_theta - log_one_plus(determinant_less_one(H))) / Real(3));
      F[p].v = scaled(plus_one(H).v, S(1) + stretch);
    }
    return F;
  }

  /// Nodal forces and tangent of one element for nodal displacements u. With an open relation, ln theta is the value of
  /// the condensed unknown instead of that of u (theory.md, eq. 6.11, 6.12).
  template <class Kinematics, class Material, class State, class S>
  [[gnu::noinline]] static FailureCause evaluate(
      const std::array<PointGeometry<Kinematics, nodes>, points>& geometry, const Material& material,
      const Vec<S, dofs>& u, const std::array<State, points>& old, Real dt, ElementResult<S, dofs, points, State>& out,
      CondensedUnknown<S, dofs>& dilatation, Relation relation, Want want = Want::tangent) {
    using TensorPattern = typename Kinematics::TensorPattern;
    constexpr Symmetry symmetry = Material::symmetry;
    constexpr int size = TensorPattern::size;

    // Volumes, and their first derivatives: div_p = delta J_p / J_p, mean_div = delta theta / theta. J - 1 and ln theta
    // come from the displacement gradient H, because 1 + H loses digits.
    std::array<Tensor<S, TensorPattern>, points> F, F_inverse, H;
    std::array<S, points> J, log_J;
    std::array<Vec<S, dofs>, points> div;
    S reference = S(0), volume = S(0), gained = S(0);
    Vec<S, dofs> mean_div = Vec<S, dofs>::Zero();
    for (std::size_t p = 0; p < points; ++p) {
      H[p] = displacement_gradient(geometry[p], u);
      F[p] = plus_one(H[p]);
      const S growth = determinant_less_one(H[p]);
      J[p] = S(1) + growth;
      if (!(value_of(J[p]) > 0)) return FailureCause::element_inverted;
      log_J[p] = log_one_plus(growth);
      gained += growth * geometry[p].weight;
      F_inverse[p] = inverse(F[p]);
      div[p] = internal_force(geometry[p], transpose(F_inverse[p]));
      const S v = J[p] * geometry[p].weight;
      reference += S(geometry[p].weight);
      volume += v;
      add(mean_div, div[p], v);
    }
    mean_div = scaled<S>(mean_div, S(1) / volume);
    S log_theta = log_one_plus(gained / reference);
    Vec<S, dofs> by_dilatation = Vec<S, dofs>::Zero();  // d force / d ln theta
    const bool open = relation == Relation::open;
    if (open) {
      dilatation.residual = log_theta - dilatation.value;
      // A residual below the round-off of ln theta(u) counts as zero: the bulk modulus would turn it into forces.
      if (std::abs(value_of(dilatation.residual)) <= roundoff(geometry[0], u)) dilatation.residual = S(0);
      dilatation.gradient = mean_div;
      log_theta = dilatation.value;
    } else {
      dilatation.value = log_theta;
    }

    // Material law, forces, and the part of the tangent without sums over the points.
    const bool with_tangent = want != Want::residual;
    out.residual.setZero();
    if (with_tangent) out.tangent.setZero();
    std::array<Moduli<S, TensorPattern>, points> M;
    std::array<S, points> spherical;  // w_p tr(tau_p) / 3
    S spherical_sum = S(0);
    for (std::size_t p = 0; p < points; ++p) {
      const S stretch = exp_less_one((log_theta - log_J[p]) / Real(3));
      const S factor = S(1) + stretch;
      Deformation<S, TensorPattern> bar;
      Tensor<S, TensorPattern>& F_bar = bar.F;
      F_bar.v = scaled(F[p].v, factor);
      bar.H.v = scaled(H[p].v, factor);
      for (int i = 0; i < 3; ++i) bar.H(i, i) += stretch;
      bar.log_J = log_theta;
      const auto answer = answer_of(material, bar, old[p], dt);
      if (answer.cause != FailureCause::none) return answer.cause;
      out.states[p] = answer.state;

      const S weight = S(geometry[p].weight);
      const S trace_tau = contraction(answer.P.v, F_bar.v) * weight;
      Vec<S, dofs> da = scaled(mean_div, S(Real(1) / 3));  // delta ln factor
      add(da, div[p], S(Real(-1) / 3));
      const Vec<S, dofs> stress_force = scaled<S>(internal_force(geometry[p], answer.P), weight * factor);
      add(out.residual, stress_force);
      add(out.residual, da, trace_tau);
      if (!with_tangent && !open) continue;

      const S squared = weight * factor * factor;
      Tensor<S, TensorPattern> moduli_F;
      moduli_F.v = product(answer.dP_dF, F[p].v);
      const S half_stretch = S(0.5) * (squared * contraction(F[p].v, moduli_F.v) + trace_tau);
      const auto with_da = [&](const Tensor<S, TensorPattern>& moduli_times_F) {
        Vec<S, dofs> sum = stress_force;
        add(sum, internal_force(geometry[p], moduli_times_F), squared);
        add(sum, da, half_stretch);
        return sum;
      };
      const Vec<S, dofs> left = with_da(moduli_F);
      if (open) {
        add(by_dilatation, left, S(Real(1) / 3));
        add(by_dilatation, da, S(half_stretch * (Real(1) / 3)));
      }
      if (!with_tangent) continue;
      add_dyad<symmetry>(left, da, out.tangent);
      if constexpr (symmetry == Symmetry::symmetric) {
        add_dyad<symmetry>(da, left, out.tangent);
      } else {
        Tensor<S, TensorPattern> F_moduli;
        F_moduli.v = transposed_product(answer.dP_dF, F[p].v);
        add_dyad<symmetry>(da, with_da(F_moduli), out.tangent);
      }
      M[p] = scaled(answer.dP_dF, squared);
      spherical[p] = trace_tau / S(3);
      spherical_sum += spherical[p];
    }

    if (open) dilatation.force = scaled(by_dilatation, dilatation.residual);
    if (!with_tangent) return FailureCause::none;

    // Second derivatives of ln theta and ln J.
    for (std::size_t p = 0; p < points; ++p) {
      const S share = J[p] * geometry[p].weight / volume * spherical_sum;
      const S swirl = spherical[p] - share;
      for (int a = 0; a < size; ++a) {
        const auto [i, I] = TensorPattern::pairs[std::size_t(a)];
        for (int b = 0; b < size; ++b) {
          const auto [k, K] = TensorPattern::pairs[std::size_t(b)];
          if (TensorPattern::couples(I, k) && TensorPattern::couples(K, i))
            M[p](a, b) += swirl * F_inverse[p](I, k) * F_inverse[p](K, i);
        }
      }
      add_BtMB<symmetry>(geometry[p], M[p], out.tangent);
      add_dyad<symmetry>(scaled(div[p], share), div[p], out.tangent);
    }
    add_dyad<symmetry>(scaled(mean_div, S(-spherical_sum)), mean_div, out.tangent);
    if constexpr (symmetry == Symmetry::symmetric) copy_lower_to_upper(out.tangent);
    return FailureCause::none;
  }

 private:
  // Round-off of ln theta(u): the displacement gradient sums products of displacements and shape gradients.
  template <class Kinematics, class S>
  static Real roundoff(const PointGeometry<Kinematics, nodes>& point, const Vec<S, dofs>& u) {
    Real moved = 0, gradient = 0;
    for (int c = 0; c < dofs; ++c) moved = std::max(moved, std::abs(value_of(u[c])));
    for (int a = 0; a < nodes; ++a)
      for (int J = 0; J < dim; ++J) gradient = std::max(gradient, std::abs(value_of(point.dN_dX(a, J))));
    const Real largest = moved * gradient;
    return 4 * std::numeric_limits<Real>::epsilon() * largest * (1 + largest);
  }
};

}  // namespace stickslip
