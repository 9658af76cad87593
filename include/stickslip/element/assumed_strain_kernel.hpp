// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/symmetry.hpp>
#include <stickslip/element/assumed_strain_geometry.hpp>
#include <stickslip/element/gradient_operator.hpp>
#include <stickslip/policy/condensed_unknown.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/tensor/near_one.hpp>
#include <stickslip/tensor/products.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace stickslip {

/// One evaluation of AssumedStrain, whatever the material. Strains and stresses have covariant and contravariant
/// components to the base a_j = F_0 g_j in the present configuration and g_j in the reference one, in which assumed
/// strains are sparse (theory.md, eq. 2.17-2.22). Its generalised variables are, in this order, the stretches alpha_j,
/// the hourglass components c_Ij = a_j . y_I, B_ij = a_i . a_j(u), and in axisymmetry the radial displacements.
template <class Kinematics, class Cell, class S>
class AssumedStrainKernel {
 public:
  using Geometry = AssumedStrainGeometry<Kinematics, Cell>;
  using TensorPattern = typename Kinematics::TensorPattern;
  static constexpr int dim = Cell::dim, nodes = Cell::nodes, dofs = nodes * dim, modes = Geometry::modes;
  static constexpr std::size_t points = Cell::points;
  static constexpr int stretches = dim, dilatations = dim + 1, unknowns = stretches + dilatations;
  static constexpr int size = TensorPattern::size;
  static constexpr int first_c = stretches, first_B = first_c + modes * dim, first_hoop = first_B + dim * dim;
  static constexpr int variables = first_hoop + (Kinematics::hoop ? nodes : 0), of_u = variables - stretches;
  static constexpr int of_vectors = (dim + modes) * dim, core = first_hoop - stretches;

  AssumedStrainKernel(const Geometry& geometry, const Vec<S, dofs>& u) : geometry_(geometry), u_(u) {
    Mat<S, dim> change;  // of the base a_j
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        change(i, j) = S(0);
        for (int a = 0; a < nodes; ++a) change(i, j) += u[a * dim + i] * S(geometry.gradient(a, j));
        a_(i, j) = S(geometry.base(i, j)) + change(i, j);
      }
      for (int I = 0; I < modes; ++I) {
        y_(I, i) = S(0);
        for (int a = 0; a < nodes; ++a) y_(I, i) += u[a * dim + i] * S(geometry.hourglass(a, I));
      }
    }
    for (int j = 0; j < dim; ++j)
      for (int l = 0; l < dim; ++l) dual_(j, l) = S(geometry.dual(j, l));
    mean_ = product(change, dual_);
    metric_ = transposed_product(a_, a_);
    c_ = product(y_, a_);
    S det;
    a_inverse_ = inverse(a_, det);
    sound_ = value_of(det) > 0;
    S unused;
    metric_inverse_ = inverse(metric_, unused);
  }

  /// Whether the mean deformation is not turned inside out.
  bool sound() const { return sound_; }

  /// Strains for the stretches alpha (theory.md, eq. 2.15, 2.16). False if a point is turned inside out.
  bool strain(const Vec<S, stretches>& alpha) {
    for (std::size_t p = 0; p < points; ++p) {
      const auto& g = geometry_[p];
      Point& point = point_[p];
      for (int j = 0; j < dim; ++j) {
        S e = alpha[j] * S(g.stretch[j]);
        for (int I = 0; I < modes; ++I) e += c_(I, j) * S(g.q(I, j));
        point.E(j, j) = e;
        if constexpr (dim == 3)
          for (int k = 0; k < j; ++k)
            point.E(j, k) = point.E(k, j) = S(0.5) * (c_(j, j) * S(g.q(j, k)) + c_(k, k) * S(g.q(k, j)));
        else
          for (int k = 0; k < j; ++k) point.E(j, k) = point.E(k, j) = S(0);
      }
      point.K = product(metric_inverse_, point.E);
      // G - 1 = F_0 - 1 + a^-T E g^-1, without the 1.
      const Mat<S, dim> block = product(transposed_product(a_inverse_, point.E), dual_);
      Tensor<S, TensorPattern>& H = point.H;
      H.v.setZero();
      for (int i = 0; i < dim; ++i)
        for (int J = 0; J < dim; ++J) H(i, J) = mean_(i, J) + block(i, J);
      if constexpr (Kinematics::hoop)
        for (int a = 0; a < nodes; ++a) H(2, 2) += u_[a * dim] * S(g.N_over_R[a]);
      const S growth = determinant_less_one(H);
      if (!(value_of(growth) > -1)) return false;
      point.log_J = log_one_plus(growth);
      const Mat<S, dim> G = sum(metric_, point.E);
      S det;
      const Mat<S, dim> N = inverse(G, det);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) {
          point.G[TensorPattern::at(i, j)] = G(i, j);
          point.N[TensorPattern::at(i, j)] = N(i, j);
        }
      if constexpr (dim == 2) {
        point.G[TensorPattern::at(2, 2)] = S(1) + H(2, 2);
        point.N[TensorPattern::at(2, 2)] = S(1) / (S(1) + H(2, 2));
      }
    }
    return true;
  }

  /// The dilatations of the strains: the projection of ln det G.
  Vec<S, dilatations> dilatations_now() const {
    Vec<S, dilatations> theta;
    for (int k = 0; k < dilatations; ++k) {
      theta[k] = S(0);
      for (std::size_t p = 0; p < points; ++p) theta[k] += S(share(p, k)) * point_[p].log_J;
    }
    return theta;
  }

  /// What the material sees at a point when the dilatations are theta.
  Deformation<S, TensorPattern> seen(std::size_t p, const Vec<S, dilatations>& theta) {
    Point& point = point_[p];
    S log_J = S(0);
    for (int k = 0; k < dilatations; ++k) log_J += S(geometry_[p].dilatation[k]) * theta[k];
    const S stretch = exp_less_one((log_J - point.log_J) * S(1. / 3));
    point.factor = S(1) + stretch;
    Deformation<S, TensorPattern> d;
    d.H.v = scaled(point.H.v, point.factor);
    d.F.v = scaled(plus_one(point.H).v, point.factor);
    for (int i = 0; i < 3; ++i) d.H(i, i) += stretch;
    d.log_J = log_J;
    return d;
  }

  /// Takes the material's answer at a point.
  void take(std::size_t p, const Tensor<S, TensorPattern>& P, const Moduli<S, TensorPattern>& dP_dF) {
    const S force = S(geometry_[p].weight) * point_[p].factor;
    point_[p].stress = scaled(P.v, force);
    point_[p].moduli = scaled(dP_dF, S(force * point_[p].factor));
  }

  /// Forces and their derivatives by displacements and stretches, with the dilatations theta condensed. Without `full`,
  /// only the derivatives by the stretches.
  template <Symmetry symmetry, bool full>
  [[gnu::noinline]] void assemble(const Vec<S, dilatations>& theta) {
    constexpr bool general = symmetry == Symmetry::general;
    constexpr int columns = full ? variables : stretches, vectors = general ? 4 : 3;
    // Stresses and moduli at the points; mean pressures.
    Vec<S, dilatations> pressure;
    for (int k = 0; k < dilatations; ++k) pressure[k] = S(0);
    for (std::size_t p = 0; p < points; ++p) {
      Point& point = point_[p];
      point.stress = contravariant(point.stress);
      point.trace = contraction(point.stress, point.G);
      for (int k = 0; k < dilatations; ++k) pressure[k] += S(geometry_[p].dilatation[k]) * point.trace * S(1. / 3);
    }

    Mat<S, columns, variables> H;  // transposed: row j, column i is the derivative of force i by variable j
    Vec<S, variables> r;
    Mat<S, variables, dilatations> pL, pR, t;
    Mat<S, dilatations> bulk;
    Mat<S, dim> SE;
    std::array<Mat<S, dim>, first_B> SEz;
    H.setZero(), r.setZero(), pL.setZero(), pR.setZero(), t.setZero(), bulk.setZero(), SE.setZero();
    for (auto& m : SEz) m.setZero();

    for (std::size_t p = 0; p < points; ++p) {
      Point& point = point_[p];
      const auto& g = geometry_[p];
      Moduli<S, TensorPattern> M;
      contravariant<!general>(point.moduli, M);
      if constexpr (!general)
        for (int b = 1; b < size; ++b)
          for (int a = 0; a < b; ++a) M(a, b) = M(b, a);
      const Vec<S, size>&G = point.G, &N = point.N, &Q = point.stress;
      Vec<S, size> BL = product(M, G);
      add(BL, Q);
      Vec<S, size> BR = BL;
      if constexpr (general) {
        BR = transposed_product(M, G);
        add(BR, Q);
      }
      const S eta = contraction(G, BL), third = point.trace * S(1. / 3);
      S projected = S(0);
      for (int k = 0; k < dilatations; ++k) projected += S(share(p, k)) * pressure[k];

      Mat<S, vectors, size> v;  // rows: stress, derivative of the forces by the dilatation, N, that of the pressure
      for (int a = 0; a < size; ++a) {
        v(0, a) = Q[a] + (projected - third) * N[a];
        v(1, a) = (BL[a] - eta * S(1. / 3) * N[a]) * S(1. / 3);
        v(2, a) = N[a];
        if constexpr (general) v(3, a) = (BR[a] - eta * S(1. / 3) * N[a]) * S(1. / 3);
      }
      Mat<S, vectors, variables> w;
      pull<variables, Into::all>(g, point.K, v, w);
      for (int i = 0; i < variables; ++i) {
        r[i] += w(0, i);
        for (int k = 0; k < dilatations; ++k) {
          const S chi = S(g.dilatation[k]);
          pL(i, k) += chi * w(1, i);
          t(i, k) += S(share(p, k)) * w(2, i);
          if constexpr (general) pR(i, k) += chi * w(3, i);
        }
      }
      for (int k = 0; k < dilatations; ++k)
        for (int l = 0; l < dilatations; ++l) bulk(k, l) += S(g.dilatation[k] * g.dilatation[l]) * eta * S(1. / 9);

      // The derivative of the stress that forces take.
      const S swirl = third - projected;
      Vec<S, size> left, right;
      for (int a = 0; a < size; ++a) {
        left[a] = BL[a] * S(1. / 3) - eta * S(1. / 18) * N[a];
        right[a] = BR[a] * S(1. / 3) - eta * S(1. / 18) * N[a];
      }
      for (int b = 0; b < size; ++b) {
        const auto [m, n] = TensorPattern::pairs[std::size_t(b)];
        for (int a = general ? 0 : b; a < size; ++a) {
          const auto [k, l] = TensorPattern::pairs[std::size_t(a)];
          M(a, b) -= left[a] * N[b] + N[a] * right[b];
          if (TensorPattern::couples(l, m) && TensorPattern::couples(n, k))
            M(a, b) += swirl * N[TensorPattern::at(l, m)] * N[TensorPattern::at(n, k)];
          if constexpr (!general) M(b, a) = M(a, b);
        }
      }
      Mat<S, size, columns> Y;
      pull<columns, Into::all>(g, point.K, M, Y);
      pull<variables, full && !general ? Into::lower_sum : Into::sum>(g, point.K, transposed(Y), H);

      Mat<S, dim> stress;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) stress(i, j) = v(0, TensorPattern::at(i, j));
      add(SE, product(stress, point.E));
      for (int j = 0; j < dim; ++j) {
        for (int i = 0; i < dim; ++i) SEz[std::size_t(j)](i, j) += stress(i, j) * S(g.stretch[j]);
        if (full)
          for (int I = 0; I < modes; ++I) {
            Mat<S, dim>& m = SEz[std::size_t(first_c + I * dim + j)];
            for (int i = 0; i < dim; ++i) m(i, j) += stress(i, j) * S(g.q(I, j));
            if constexpr (dim == 3)
              if (I == j)
                for (int k = 0; k < dim; ++k)
                  if (k != j)
                    for (int i = 0; i < dim; ++i) {
                      m(i, k) += stress(i, j) * S(0.5 * g.q(j, k));
                      m(i, j) += stress(i, k) * S(0.5 * g.q(j, k));
                    }
          }
      }
    }

    // Second derivatives of G (theory.md, eq. 2.20).
    for (int z = 0; z < (full ? first_B : stretches); ++z) {
      const Mat<S, dim> m = product(SEz[std::size_t(z)], metric_inverse_);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) {
          if constexpr (full) H(first_B + j * dim + i, z) -= m(i, j);
          if constexpr (!full || general) H(z, first_B + j * dim + i) -= m(i, j);
        }
    }
    if constexpr (full) {
      const Mat<S, dim> m = product(SE, metric_inverse_);
      for (int k = 0; k < dim; ++k)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            for (int l = 0; l < dim; ++l) {
              const S value = m(i, j) * metric_inverse_(k, l);
              const int one = first_B + k * dim + i, two = first_B + j * dim + l;
              if (general || one >= two) H(one, two) += value;
              if (general || two >= one) H(two, one) += value;
            }
    }
    to_nodes<symmetry, full>(theta, H, r, pL, general ? pR : pL, t, bulk);
  }

  /// The step of the stretches that closes their relation, the displacements standing still. False if there is none.
  bool stretch_step(Vec<S, stretches>& step) const {
    S det;
    const Mat<S, dim> inverse_K = inverse(K_aa_, det);
    if (!solvable(det)) return false;
    step = scaled(product(inverse_K, f_a_), S(-1));
    return true;
  }
  /// Largest residual of that relation.
  Real stretch_force() const {
    Real largest = 0;
    for (int j = 0; j < stretches; ++j) largest = std::max(largest, std::abs(value_of(f_a_[j])));
    return largest;
  }

  /// Condenses the stretches: forces, tangent and the relations of the condensed unknowns (theory.md, eq. 2.22).
  template <Symmetry symmetry>
  FailureCause condense(Vec<S, dofs>& residual, Mat<S, dofs>& tangent, CondensedUnknown<S, dofs, unknowns>& condensed,
                        Relation relation, bool with_tangent) const {
    S det;
    const Mat<S, dim> inverse_K = inverse(K_aa_, det);
    if (!solvable(det)) return FailureCause::singular_matrix;
    residual = f_u_;
    const Mat<S, dim, dofs> slope = scaled(product(inverse_K, K_au_), S(-1));
    if (with_tangent) {
      tangent = K_uu_;
      add(tangent, product(K_ua_, slope));
      if constexpr (symmetry == Symmetry::symmetric) copy_lower_to_upper(tangent);
    }
    if (relation == Relation::closed) return FailureCause::none;
    const Vec<S, dim> defect = scaled(product(inverse_K, f_a_), S(-1));
    condensed.force = excess_;
    add(condensed.force, product(K_ua_, defect));
    for (int j = 0; j < stretches; ++j) {
      condensed.residual[j] = defect[j];
      for (int i = 0; i < dofs; ++i) condensed.gradient(i, j) = slope(j, i);
    }
    for (int k = 0; k < dilatations; ++k) {
      S sum = theta_defect_[k];
      for (int j = 0; j < stretches; ++j) sum += t_a_(j, k) * defect[j];
      condensed.residual[stretches + k] = sum;
      for (int i = 0; i < dofs; ++i) {
        S slope_of_theta = t_u_(i, k);
        for (int j = 0; j < stretches; ++j) slope_of_theta += t_a_(j, k) * slope(j, i);
        condensed.gradient(i, stretches + k) = slope_of_theta;
      }
    }
    return FailureCause::none;
  }

 private:
  struct Point {
    Mat<S, dim> E, K;            // assumed strain, and C^-1 E
    Tensor<S, TensorPattern> H;  // G - 1
    Vec<S, size> G, N;           // of G, and of G^-T
    S log_J, factor, trace;      // ln det G; over G what the material sees; w tr(tau)
    Vec<S, size> stress;         // w f P
    Moduli<S, TensorPattern> moduli;
  };

  // Weight of ln J of a point in dilatation k.
  Real share(std::size_t p, int k) const { return geometry_[p].share * geometry_[p].dilatation[k]; }

  static Mat<S, dim> sum(const Mat<S, dim>& a, const Mat<S, dim>& b) {
    Mat<S, dim> r = a;
    add(r, b);
    return r;
  }
  // Whether the stretches' matrix of this determinant has digits.
  bool solvable(const S& det) const {
    Real scale = 1;
    for (int j = 0; j < dim; ++j) scale *= std::abs(value_of(K_aa_(j, j)));
    return std::isfinite(value_of(det)) && std::abs(value_of(det)) > 1e-12 * scale;
  }

  // Contravariant components, in every row: S^kl = a^k . S . g^l. With `lower`, only rows from a column's own number
  // on.
  template <bool lower, int rows>
  void contravariant_rows(const Mat<S, rows, size>& in, Mat<S, rows, size>& out) const {
    Mat<S, rows, size> half;
    for (int k = 0; k < dim; ++k)
      for (int J = 0; J < dim; ++J) {
        const int to = TensorPattern::at(k, J), first = lower ? TensorPattern::at(k, 0) : 0;
        for (int r = first; r < rows; ++r) half(r, to) = a_inverse_(k, 0) * in(r, TensorPattern::at(0, J));
        for (int i = 1; i < dim; ++i)
          for (int r = first; r < rows; ++r) half(r, to) += a_inverse_(k, i) * in(r, TensorPattern::at(i, J));
      }
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l) {
        const int to = TensorPattern::at(k, l), first = lower ? to : 0;
        for (int r = first; r < rows; ++r) out(r, to) = dual_(l, 0) * half(r, TensorPattern::at(k, 0));
        for (int J = 1; J < dim; ++J)
          for (int r = first; r < rows; ++r) out(r, to) += dual_(l, J) * half(r, TensorPattern::at(k, J));
      }
    if constexpr (dim == 2)  // the normal component stays
      for (int r = 0; r < rows; ++r) out(r, TensorPattern::at(2, 2)) = in(r, TensorPattern::at(2, 2));
  }
  Vec<S, size> contravariant(const Vec<S, size>& v) const {
    Mat<S, 1, size> out;
    contravariant_rows<false>(transposed(v), out);
    return transposed(out);
  }
  // Of both index pairs; of a symmetric one the lower triangle.
  template <bool symmetric>
  void contravariant(const Moduli<S, TensorPattern>& m, Moduli<S, TensorPattern>& out) const {
    Moduli<S, TensorPattern> half;
    contravariant_rows<false>(m, half);
    contravariant_rows<symmetric>(transposed(half), out);  // transposed
    if constexpr (!symmetric) out = transposed(out);
  }

  template <int rows, int c1, int c2>
  static void combine(Mat<S, rows, c1>& to, int j, const Mat<S, rows, c2>& from, int i, const S& factor) {
    for (int r = 0; r < rows; ++r) to(r, j) = factor * from(r, i);
  }
  template <int rows, int c1, int c2>
  static void combine_add(Mat<S, rows, c1>& to, int j, const Mat<S, rows, c2>& from, int i, const S& factor) {
    for (int r = 0; r < rows; ++r) to(r, j) += factor * from(r, i);
  }

  template <int rows, int columns>
  static Mat<S, columns, rows> transposed(const Mat<S, rows, columns>& m) {
    Mat<S, columns, rows> r;
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i) r(j, i) = m(i, j);
    return r;
  }

  // Whether a result is put in the place of what was there, or added to it, and to all rows or only to those from a
  // column's own number on.
  enum class Into { all, sum, lower_sum };
  // What acts on G at a point, in every row, as it acts on the first `columns` generalised variables (theory.md, eq.
  // 2.18).
  template <int columns, Into into, int rows>
  static void pull(const typename Geometry::Point& g, const Mat<S, dim>& K, const Mat<S, rows, size>& in,
                   Mat<S, rows, columns>& out) {
    const auto at = [](int i, int j) { return TensorPattern::at(i, j); };
    const auto add_to = [&](int to, int from, const S& factor) {
      for (int r = into == Into::lower_sum && rows > 12 ? to : 0; r < rows; ++r) out(r, to) += factor * in(r, from);
    };
    const auto first_to = [&](int to, int from, const S& factor) {
      if constexpr (into == Into::all)
        for (int r = 0; r < rows; ++r) out(r, to) = factor * in(r, from);
      else
        add_to(to, from, factor);
    };
    for (int j = 0; j < dim; ++j) first_to(j, at(j, j), S(g.stretch[j]));
    if constexpr (columns == variables) {
      for (int I = 0; I < modes; ++I)
        for (int j = 0; j < dim; ++j) {
          const int to = first_c + I * dim + j;
          first_to(to, at(j, j), S(g.q(I, j)));
          if constexpr (dim == 3)
            if (I == j)
              for (int k = 0; k < dim; ++k)
                if (k != j) {
                  add_to(to, at(j, k), S(0.5 * g.q(j, k)));
                  add_to(to, at(k, j), S(0.5 * g.q(j, k)));
                }
        }
      for (int m = 0; m < dim; ++m)
        for (int n = 0; n < dim; ++n) {
          const int to = first_B + m * dim + n;
          first_to(to, at(m, n), S(1));
          for (int l = 0; l < dim; ++l) add_to(to, at(n, l), S(-K(m, l)));
        }
      if constexpr (Kinematics::hoop)
        for (int a = 0; a < nodes; ++a) first_to(first_hoop + a, at(2, 2), S(g.N_over_R[a]));
    }
  }

  // What acts on the components c_Ij and B_ij, in every row, as it acts on the vectors a_j and y_I by component.
  template <int rows, int columns>
  Mat<S, rows, of_vectors> on_vectors(const Mat<S, rows, columns>& in) const {
    Mat<S, rows, of_vectors> out;
    const int B = modes * dim;
    for (int j = 0; j < dim; ++j)
      for (int i = 0; i < dim; ++i) {
        const int to = j * dim + i;
        combine(out, to, in, B + j, a_(i, 0));
        for (int k = 1; k < dim; ++k) combine_add(out, to, in, B + k * dim + j, a_(i, k));
        for (int I = 0; I < modes; ++I) combine_add(out, to, in, I * dim + j, y_(I, i));
      }
    for (int I = 0; I < modes; ++I)
      for (int i = 0; i < dim; ++i) {
        const int to = (dim + I) * dim + i;
        combine(out, to, in, I * dim, a_(i, 0));
        for (int j = 1; j < dim; ++j) combine_add(out, to, in, I * dim + j, a_(i, j));
      }
    return out;
  }
  // The same on nodal displacements. With `lower`, only rows from a column's node on.
  template <bool lower = false, int rows>
  Mat<S, rows, dofs> on_nodes(const Mat<S, rows, of_vectors>& in) const {
    Mat<S, rows, dofs> out;
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < dim; ++i) {
        const int to = a * dim + i, first = lower ? to : 0;
        for (int r = first; r < rows; ++r) out(r, to) = S(geometry_.gradient(a, 0)) * in(r, i);
        for (int j = 1; j < dim; ++j)
          for (int r = first; r < rows; ++r) out(r, to) += S(geometry_.gradient(a, j)) * in(r, j * dim + i);
        for (int I = 0; I < modes; ++I)
          for (int r = first; r < rows; ++r) out(r, to) += S(geometry_.hourglass(a, I)) * in(r, (dim + I) * dim + i);
      }
    return out;
  }
  // What acts on the generalised variables but the stretches, in every row, as it acts on nodal displacements.
  template <int rows>
  Mat<S, rows, dofs> nodal(const Mat<S, rows, of_u>& in) const {
    Mat<S, rows, dofs> out = on_nodes(on_vectors(in));
    if constexpr (Kinematics::hoop)
      for (int a = 0; a < nodes; ++a)
        for (int r = 0; r < rows; ++r) out(r, a * dim) += in(r, core + a);
    return out;
  }

  // Forces and derivatives by nodal displacements and stretches, from those by generalised variables; adds what the
  // condensed dilatations bring (theory.md, eq. 2.21). H is transposed; of a full symmetric one the lower triangle
  // counts.
  template <Symmetry symmetry, bool full, int columns>
  void to_nodes(const Vec<S, dilatations>& theta, const Mat<S, columns, variables>& H, const Vec<S, variables>& r,
                const Mat<S, variables, dilatations>& pL, const Mat<S, variables, dilatations>& pR,
                const Mat<S, variables, dilatations>& t, const Mat<S, dilatations>& bulk) {
    constexpr bool general = symmetry == Symmetry::general, lower = full && !general;
    // The relation of the dilatations. What is below round-off counts as zero: the bulk modulus would make forces of
    // it.
    const Vec<S, dilatations> now = dilatations_now();
    const Real floor = roundoff();
    for (int k = 0; k < dilatations; ++k) {
      theta_defect_[k] = now[k] - theta[k];
      if (std::abs(value_of(theta_defect_[k])) <= floor) theta_defect_[k] = S(0);
    }
    // K = H + pL t^T + t pR^T + t bulk t^T; half of the last with each of the others.
    const Mat<S, variables, dilatations> t_bulk = product(t, bulk);
    Mat<S, variables, dilatations> L = pL, R = pR;
    add(L, t_bulk, S(0.5));
    add(R, t_bulk, S(0.5));
    const auto entry = [&](int i, int j) {  // derivative of force i by variable j
      S sum = lower && i > j ? H(i, j) : H(j, i);
      for (int k = 0; k < dilatations; ++k) sum += L(i, k) * t(j, k) + t(i, k) * R(j, k);
      return sum;
    };

    // d force / d theta_k = pL_k + t_l bulk_lk.
    Mat<S, 2 + dilatations + stretches, of_u> rows;
    for (int i = 0; i < variables; ++i) {
      S excess = S(0);
      for (int k = 0; k < dilatations; ++k) excess += (pL(i, k) + t_bulk(i, k)) * theta_defect_[k];
      if (i < stretches) {
        f_a_[i] = r[i] + excess;
        for (int k = 0; k < dilatations; ++k) t_a_(i, k) = t(i, k);
        for (int j = 0; j < stretches; ++j) K_aa_(i, j) = entry(i, j);
        continue;
      }
      rows(0, i - stretches) = r[i];
      rows(1, i - stretches) = excess;
      for (int k = 0; k < dilatations; ++k) rows(2 + k, i - stretches) = t(i, k);
      for (int j = 0; j < stretches; ++j) rows(2 + dilatations + j, i - stretches) = entry(i, j);
    }
    const Mat<S, 2 + dilatations + stretches, dofs> of_nodes = nodal(rows);
    for (int i = 0; i < dofs; ++i) {
      f_u_[i] = of_nodes(0, i);
      excess_[i] = of_nodes(1, i);
      for (int k = 0; k < dilatations; ++k) t_u_(i, k) = of_nodes(2 + k, i);
      for (int j = 0; j < stretches; ++j) K_au_(j, i) = K_ua_(i, j) = of_nodes(2 + dilatations + j, i);
    }
    if constexpr (full) {
      if constexpr (general) {
        Mat<S, stretches, of_u> by_u;
        for (int j = 0; j < stretches; ++j)
          for (int i = 0; i < of_u; ++i) by_u(j, i) = entry(j, stretches + i);
        K_au_ = nodal(by_u);
      }
      Mat<S, core> square;
      for (int j = 0; j < core; ++j)
        for (int i = lower ? j : 0; i < core; ++i) {
          square(i, j) = entry(stretches + i, stretches + j);
          if constexpr (lower) square(j, i) = square(i, j);
        }
      Mat<S, of_vectors> K = on_vectors(transposed(on_vectors(square)));
      // c_Ij is bilinear in the displacements.
      for (int I = 0; I < modes; ++I)
        for (int j = 0; j < dim; ++j)
          for (int i = 0; i < dim; ++i) {
            K(j * dim + i, (dim + I) * dim + i) += r[first_c + I * dim + j];
            K((dim + I) * dim + i, j * dim + i) += r[first_c + I * dim + j];
          }
      K_uu_ = on_nodes<lower>(transposed(on_nodes(K)));
      if constexpr (Kinematics::hoop) {
        // Radial displacements stretch the hoop by themselves.
        Mat<S, nodes, core> forces, slopes;  // of the hoop by the others, and of the others by the hoop
        for (int a = 0; a < nodes; ++a)
          for (int j = 0; j < core; ++j) {
            forces(a, j) = entry(first_hoop + a, stretches + j);
            if constexpr (general) slopes(a, j) = entry(stretches + j, first_hoop + a);
          }
        const Mat<S, nodes, dofs> left = on_nodes(on_vectors(forces)),
                                  right = general ? on_nodes(on_vectors(slopes)) : left;
        for (int a = 0; a < nodes; ++a) {
          for (int i = 0; i < dofs; ++i) {
            if (!lower || i <= a * dim) K_uu_(a * dim, i) += left(a, i);
            if (!lower || i >= a * dim) K_uu_(i, a * dim) += right(a, i);
          }
          for (int b = 0; b < nodes; ++b)
            if (!lower || b <= a) K_uu_(a * dim, b * dim) += entry(first_hoop + a, first_hoop + b);
        }
      }
    }
  }

  // Round-off of the dilatations: the displacement gradient sums products of displacements and shape gradients.
  Real roundoff() const {
    Real moved = 0;
    for (int c = 0; c < dofs; ++c) moved = std::max(moved, std::abs(value_of(u_[c])));
    const Real largest = moved * geometry_.steepest;
    return 4 * std::numeric_limits<Real>::epsilon() * largest * (1 + largest);
  }

  const Geometry& geometry_;
  const Vec<S, dofs>& u_;
  Mat<S, dim> a_, a_inverse_, dual_, metric_, metric_inverse_, mean_;  // a_j; a^j; g^j; a_i . a_j; F_0 - 1
  Mat<S, modes, dim> y_, c_;
  bool sound_;
  std::array<Point, points> point_;

  // Of the last assembly: f forces, K their derivatives, by u and the stretches a; t derivatives of the dilatations.
  Vec<S, dofs> f_u_, excess_;
  Vec<S, stretches> f_a_;
  Vec<S, dilatations> theta_defect_;
  Mat<S, dofs> K_uu_;
  Mat<S, dofs, stretches> K_ua_;
  Mat<S, stretches, dofs> K_au_;
  Mat<S, stretches> K_aa_;
  Mat<S, dofs, dilatations> t_u_;
  Mat<S, stretches, dilatations> t_a_;
};

}  // namespace stickslip
