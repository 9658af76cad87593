// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "element_check.hpp"
#include "skewed.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>

#include <Eigen/Eigenvalues>

namespace assumed_strain_check {

using namespace stickslip;

const Hencky hencky{.young = 200e3, .poisson = 0.3};
const FiniteJ2<PowerHardening> power{
    .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};
const HypoelasticJ2<LinearHardening> hypoelastic{
    .young = 69e3, .poisson = 0.33, .hardening = {.yield = 30, .modulus = 260}};
const element_check::Skewed skewed{{hencky}};

/// An element at the end of a path, the memory of the displacements before being `old`.
template <class Element_, class Kinematics, class Material>
struct At {
  using Element = Element_;
  static constexpr int n = Element::dofs, m = Element::condensed_unknowns;
  using Single = verify::SingleElement<Element, Kinematics, Material>;
  using Path = std::vector<Vec<Real, n>>;

  Single element;
  Path path;
  typename Single::template Memory<Real> old = element.template preloaded<Real>(path);
  Vec<Real, n> u = path.back();

  auto answer() const { return element.template at<Real>(u, old); }
  Vec<Real, m> closed() const { return element.closed(u, old); }

  /// One evaluation as the library makes it, the condensed unknowns starting at `value`.
  struct Evaluation {
    FailureCause cause;
    typename Single::template Result<Real> result;
    CondensedUnknown<Real, n, m> condensed;
  };
  Evaluation evaluate(const Vec<Real, n>& at, const Vec<Real, m>& value, Relation relation, Want want) const {
    Evaluation e;
    e.condensed.value = value;
    e.cause =
        Element::evaluate(element.geometry(), element.material, at, old, 1, e.result, e.condensed, relation, want);
    return e;
  }
};
template <class Element, class Kinematics, class Material, class X, class Path>
At<Element, Kinematics, Material> at(const Material& material, const X& nodes, const Path& path) {
  return {{.material = material, .X = nodes}, path};
}

/// Values of the condensed unknowns somewhat off the closed ones.
template <int m>
Vec<Real, m> off(Vec<Real, m> value, Real amount) {
  for (int k = 0; k < m; ++k) value[k] += amount * (0.3 + k % 3 - 1);
  return value;
}

/// Newton's method on the condensed unknowns alone, the displacements standing still: errors, the largest component.
template <class A>
std::vector<Real> errors_of_newton(const A& a, Real amount) {
  const Vec<Real, A::m> exact = a.closed();
  Vec<Real, A::m> value = off<A::m>(exact, amount);
  std::vector<Real> errors{(value - exact).cwiseAbs().maxCoeff()};
  for (int k = 0; k < 7; ++k) {
    value += a.element.open(a.u, a.old, value).relation.residual;
    errors.push_back((value - exact).cwiseAbs().maxCoeff());
  }
  return errors;
}
template <class A>
void check_newton(const A& a) {
  const std::vector<Real> errors = errors_of_newton(a, 0.02);
  CAPTURE(errors[1]);
  CAPTURE(errors[2]);
  CAPTURE(errors[3]);
  CHECK(errors[0] > 0.01);
  int judged = 0;
  for (std::size_t k = 0; k + 1 < errors.size(); ++k)
    if (errors[k] > 1e-10) {
      ++judged;
      CHECK(errors[k + 1] < std::max(20 * errors[k] * errors[k], 1e-14));
    }
  CHECK(judged >= 2);
  CHECK(errors.back() < 1e-14);
}

/// The closed value has no memory of where its solution began, and what the open relation says of the way it goes with
/// the displacements is its derivative.
template <class A>
void check_closed(const A& a) {
  constexpr int n = A::n, m = A::m;
  const Vec<Real, m> exact = a.closed();
  const auto again = a.evaluate(a.u, off<m>(exact, 0.01), Relation::closed, Want::tangent);
  CHECK(again.cause == FailureCause::none);
  CHECK((again.condensed.value - exact).cwiseAbs().maxCoeff() < 1e-13);
  CHECK(verify::relative_error(again.result.tangent, a.answer().tangent) < 1e-12);
  const Mat<Real, m, n> slope = verify::differentiate<m, n>(
      a.u, 2e-5, [&](const Vec<Real, n>& u) { return Vec<Real, m>(a.element.closed(u, a.old)); });
  const Mat<Real, m, n> gradient = a.element.open(a.u, a.old, exact).relation.gradient.transpose();
  CHECK(verify::relative_error(gradient, slope) < 1e-8);
}

/// Without a tangent an evaluation gives the same forces and relations: it leaves columns of sums out, in which another
/// order of terms may be left.
template <class A>
void check_residual_alone(const A& a) {
  const Vec<Real, A::m> value = off<A::m>(a.closed(), 0.01);
  for (const Relation relation : {Relation::closed, Relation::open}) {
    const auto all = a.evaluate(a.u, value, relation, Want::tangent);
    auto forces = a.evaluate(a.u, value, relation, Want::residual);
    CHECK(verify::relative_error(forces.result.residual, all.result.residual) < 1e-13);
    CHECK((forces.condensed.value - all.condensed.value).cwiseAbs().maxCoeff() < 1e-14);
    CHECK((forces.condensed.residual - all.condensed.residual).cwiseAbs().maxCoeff() < 1e-14);
    CHECK(verify::relative_error(forces.condensed.gradient, all.condensed.gradient) < 1e-13);
    CHECK(verify::relative_error(forces.condensed.force, all.condensed.force) < 1e-11);
    CHECK(all.condensed.force.isZero(0) == (relation == Relation::closed));
  }
}

/// Another numbering of the nodes, `now[a]` being the old number of node a, permutes forces and tangent.
template <class A, std::size_t nodes>
void check_numbering(const A& a, const std::array<int, nodes>& now) {
  constexpr int dim = A::Element::dim, n = A::n;
  const auto renumbered = [&](const Vec<Real, n>& u) {
    Vec<Real, n> v;
    for (int k = 0; k < n; ++k) v[k] = u[now[std::size_t(k / dim)] * dim + k % dim];
    return v;
  };
  A b = a;
  for (int k = 0; k < int(nodes); ++k) b.element.X.row(k) = a.element.X.row(now[std::size_t(k)]);
  for (auto& u : b.path) u = renumbered(u);
  b.u = b.path.back();
  b.old = b.element.template preloaded<Real>(b.path);
  const auto before = a.answer(), after = b.answer();
  CHECK(verify::relative_error(after.residual, renumbered(before.residual)) < 1e-12);
  Mat<Real, n> tangent;
  for (int k = 0; k < n; ++k)
    tangent.row(k) =
        renumbered(Vec<Real, n>(before.tangent.row(now[std::size_t(k / dim)] * dim + k % dim))).transpose();
  CHECK(verify::relative_error(after.tangent, tangent) < 1e-12);
}

/// The forces are the gradient of the sum of W(F) over the points: the element has a potential.
template <class A>
void check_energy(const A& a) {
  constexpr int n = A::n;
  const auto F = a.element.template deformation<Dual<n>>(verify::seeded<n>(a.u));
  const auto geometry = a.element.geometry();
  Dual<n> energy(0);
  for (std::size_t p = 0; p < F.size(); ++p) energy += a.element.material.energy(F[p], {}) * geometry[p].weight;
  const Vec<Real, n> slope = energy.slope.matrix();
  CHECK(verify::relative_error(a.answer().residual, slope) < 1e-12);
}

/// What the material sees has the dilatations that the condensed unknowns are: projected once more, they stay.
template <class A>
void check_dilatations(const A& a) {
  constexpr int stretches = A::Element::stretches, dilatations = A::Element::dilatations;
  const Vec<Real, A::m> closed = a.closed();
  const auto geometry = a.element.geometry();
  const auto F = a.element.template deformation<Real>(a.u, a.old);
  Real volume = 0;
  for (std::size_t p = 0; p < F.size(); ++p) volume += geometry[p].weight;
  for (int k = 0; k < dilatations; ++k) {
    Real projected = 0, seen = 0;
    for (std::size_t p = 0; p < F.size(); ++p) {
      const Real share = geometry[p].weight / volume * geometry[p].dilatation[k];
      projected += share * std::log(determinant(F[p]));
      for (int l = 0; l < dilatations; ++l) seen += share * geometry[p].dilatation[l] * closed[stretches + l];
    }
    CHECK(std::abs(projected - closed[stretches + k]) < 1e-14);
    CHECK(std::abs(seen - closed[stretches + k]) < 1e-14);
  }
}

template <class A>
bool all_flow(const A& a) {
  const auto now = a.answer().states;
  for (std::size_t p = 0; p < now.size(); ++p)
    if (!(now[p].plastic_strain > a.old[p].plastic_strain)) return false;
  return true;
}

/// Displacements that turn the mean inside out, and others that do so with points only, are refused by name.
template <class A>
void check_inverted(const A& a, const Vec<Real, A::n>& turned, const Vec<Real, A::n>& torn) {
  using Kernel = AssumedStrainKernel<decltype(a.element.kinematics), typename A::Element::Cell, Real>;
  const auto geometry = a.element.geometry();
  CHECK_FALSE(Kernel(geometry, turned).sound());
  CHECK(Kernel(geometry, torn).sound());
  const Vec<Real, A::m> zero = Vec<Real, A::m>::Zero();
  for (const auto& u : {turned, torn})
    for (const Relation relation : {Relation::closed, Relation::open})
      CHECK(a.evaluate(u, zero, relation, Want::tangent).cause == FailureCause::element_inverted);
}

/// Number of eigenvalues of the unstressed element that are not round-off.
template <class A>
int rank_at_rest(const A& a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      a.element.template at<Real>(Vec<Real, A::n>::Zero(), {}).tangent, Eigen::EigenvaluesOnly);
  const Real largest = eigen.eigenvalues()[A::n - 1];
  CHECK(eigen.eigenvalues()[0] > -1e-12 * largest);
  return int((eigen.eigenvalues().array() > 1e-6 * largest).count());
}

/// What holds of every material.
template <class A>
void check(const A& a) {
  element_check::check_tangent(a.element, a.path);
  check_newton(a);
  check_closed(a);
  check_residual_alone(a);
  check_dilatations(a);
}

}  // namespace assumed_strain_check
