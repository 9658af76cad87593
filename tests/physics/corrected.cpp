// SPDX-License-Identifier: BSL-1.0
// The exact tangent of Coulomb friction on a symmetric factor.
#include "scene.hpp"

#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>

#include <doctest/doctest.h>
#include <Eigen/LU>

#include <random>

namespace corrected {

using namespace scene;

using Exact = Model<EigenLu, Coulomb>;
using OnFactor = Model<Corrected<EigenLdlt>, Coulomb>;
static_assert(system_symmetry<OnFactor> == Symmetry::general);
static_assert(matrix_storage<OnFactor> == Symmetry::symmetric);
static_assert(stores_couplings<OnFactor> && !stores_couplings<Exact>);
// A symmetric system has nothing to correct, and keeps nothing for it.
static_assert(!stores_couplings<Model<Corrected<EigenLdlt>, QuasiCoulomb>>);
// Only friction's couplings are corrected.
static_assert(!valid_model<Model<Corrected<EigenLdlt>, Coulomb, HypoelasticJ2<LinearHardening>>>);

TEST_CASE("a corrected solver solves a symmetric matrix plus dyads as a factor of the sum does") {
  std::mt19937 random(5);
  std::normal_distribution<Real> normal(0, 1);
  constexpr Index n = 60;
  for (const Real shift : {4.0, 0.7}) {  // positive definite, and not
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) K(i, i) = shift + 0.1 * (i % 7);
    for (Index i = 0; i + 1 < n; ++i) K(i + 1, i) = K(i, i + 1) = -1;
    std::vector<Index> start{0}, row;
    std::vector<Real> values;
    for (Index j = 0; j < n; ++j) {
      for (Index i = j; i < std::min(n, j + 2); ++i) {
        row.push_back(i);
        values.push_back(K(i, j));
      }
      start.push_back(Index(row.size()));
    }
    // Six nodes of two components, one of them constrained.
    std::vector<Index> first_entry{0}, equation;
    std::vector<Real> left, right;
    for (Index k = 0; k < 6; ++k) {
      const Index first = 9 * k + 2;
      const bool held = k == 3;
      equation.insert(equation.end(), {first, held ? -1 : first + 1});
      first_entry.push_back(Index(equation.size()));
      Vec<Real, 2> l, r;
      for (int i = 0; i < 2; ++i) {
        left.push_back(l[i] = normal(random));
        right.push_back(r[i] = normal(random));
      }
      const Mat<Real, 2> block = l * r.transpose();
      K(first, first) += block(0, 0);
      if (!held) {
        K(first + 1, first) += block(1, 0);
        K(first, first + 1) += block(0, 1);
        K(first + 1, first + 1) += block(1, 1);
      }
    }
    SparseView view{n, start.data(), row.data(), values.data(), Symmetry::symmetric};
    view.corrections = {6, first_entry.data(), equation.data(), left.data(), right.data()};
    Corrected<EigenLdlt> solver;
    solver.analyze(view);
    CHECK(solver.factorize(view) == (shift > 2 ? Factorization::done : Factorization::indefinite));
    Field b(n), x(n);
    for (Index i = 0; i < n; ++i) b[i] = normal(random);
    CHECK(solver.solve(b.data(), x.data()));
    CHECK((K * x - b).norm() <= 1.01 * Corrected<EigenLdlt>::tolerance * b.norm());
    const Field exact = K.fullPivLu().solve(b);
    CHECK((x - exact).norm() < 1e-4 * exact.norm());
    CHECK(solver.inner_iterations() <= 7);  // the rank of the dyads, and one
    b.setZero();
    CHECK(solver.solve(b.data(), x.data()));
    CHECK(x.norm() == 0);
    view.corrections = {};
    CHECK(solver.factorize(view) != Factorization::failed);
    const Index before = solver.inner_iterations();
    b.setOnes();
    CHECK(solver.solve(b.data(), x.data()));
    CHECK(solver.inner_iterations() == before);
  }
}

TEST_CASE(
    "a corrected run has the forces and the iterations of the full tangent, also with plastic flow and strong "
    "friction") {
  const auto compare = [](auto exact, auto corrected, Real mu) {
    const auto run = [mu]<class M>(M) {
      auto p = press_and_drag<M>(mu, 0.2, 1);
      auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-10});
      const stickslip::Outcome& outcome = march.finish();
      REQUIRE_MESSAGE(outcome, outcome.message());
      return std::tuple{p->displacement(), march.report()};
    };
    const auto [u, report] = run(exact);
    const auto [v, other] = run(corrected);
    CHECK((u - v).norm() < 1e-9 * u.norm());
    CHECK(std::abs(report.iterations - other.iterations) <= 0.02 * report.iterations + 1);
    CHECK(other.rejected_steps == report.rejected_steps);
  };
  compare(Exact{}, OnFactor{}, 0.2);
  compare(Exact{}, OnFactor{}, 0.8);
  using Plastic = FiniteJ2<LinearHardening>;
  compare(Model<EigenLu, Coulomb, Plastic>{}, Model<Corrected<EigenLdlt>, Coulomb, Plastic>{}, 0.3);
}

template <class S>
struct Thrown : Model<S, Coulomb> {
  using TimeIntegration = GeneralizedAlpha;
};

TEST_CASE("a corrected run with inertia, which scales the couplings, is that of the full tangent") {
  const auto run = []<class M>(M) {
    Problem<M> block{{.body = mesh::rectangle({.size = {10, 5}, .cells = {8, 4}}),
                      .material = material<Hencky>(),
                      .density = 2.7e-9,
                      .contacts = {{.side = "bottom",
                                    .tool = rigid::line({0, 0}, {1, 0}),
                                    .friction = {.mu = 0.4},
                                    .enforcement = {.normal = 1e5, .tangential = 2e4}}}}};
    block.start_velocity({2e4, -2e4});
    auto march = block.march({.end = 2e-5, .steps = 20, .tolerance = 1e-10});
    const stickslip::Outcome& outcome = march.finish();
    REQUIRE_MESSAGE(outcome, outcome.message());
    return std::pair{block.displacement(), march.report().iterations};
  };
  const auto [u, iterations] = run(Thrown<EigenLu>{});
  const auto [v, others] = run(Thrown<Corrected<EigenLdlt>>{});
  CHECK((u - v).norm() < 1e-9 * u.norm());
  CHECK(std::abs(iterations - others) <= 1);
}

}  // namespace corrected
