// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <doctest/doctest.h>

#include <map>

namespace typed {

using V3 = Vec<Real, 3>;

Mesh<2, 4> block(std::integral_constant<int, 2>) {
  return mesh::rectangle({.origin = {1, 0}, .cells = {2, 2}});
}
Mesh<3, 8> block(std::integral_constant<int, 3>) {
  return mesh::box({.origin = {1, 0, 0}, .cells = {2, 2, 1}});
}
rigid::Tool<2> flat(std::integral_constant<int, 2>) {
  return rigid::line({0, 1}, {-1, 0});
}
rigid::Tool<3> flat(std::integral_constant<int, 3>) {
  return rigid::plane({0, 1, 0}, {0, -1, 0});
}
rigid::Tool<2> wall(std::integral_constant<int, 2>) {
  return rigid::line({2, 0}, {0, 1});
}
rigid::Tool<3> wall(std::integral_constant<int, 3>) {
  return rigid::Extruded(rigid::line({2, 0}, {0, 1}), {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
}

Real along(Real t) {
  return 0.02 * std::max(0.0, t - 1);
}
Real down(Real t) {
  return -0.03 * std::min(t, 1.0);
}
rigid::Motion<2> press_and_drag(std::integral_constant<int, 2>) {
  return [](Real t) { return Vec<Real, 2>(along(t), down(t)); };
}
rigid::Motion<3> press_and_drag(std::integral_constant<int, 3>) {
  return [](Real t) { return V3(along(t), down(t), 0.3 * along(t)); };
}
std::function<Real(Real)> component(Index i) {
  if (i == 1) return down;
  return [share = i == 0 ? 1 : 0.3](Real t) { return share * along(t); };
}

void give(Hencky& m) {
  m = {.young = 1000, .poisson = 0.3};
}
void give(NeoHookean& m) {
  m = {.young = 1000, .poisson = 0.3};
}
void give(PerfectPlasticity& h) {
  h = {.yield = 6};
}
void give(LinearHardening& h) {
  h = {.yield = 5, .modulus = 20};
}
void give(SwiftHardening& h) {
  h = {.strength = 12, .offset = 1e-2, .exponent = 0.2};
}
void give(VoceHardening& h) {
  h = {.yield = 5, .saturation = 8, .rate = 20, .modulus = 5};
}
void give(Coulomb& f) {
  f = {.mu = 0.15};
}
void give(CappedCoulomb& f) {
  f = {.mu = 0.15, .tau_max = 2};
}
void give(Tresca& f) {
  f = {.tau = 1};
}
void give(SlipWeakeningCoulomb& f) {
  f = {.mu_static = 0.15, .mu_dynamic = 0.1, .length = 0.05};
}
void give(Stribeck& f) {
  f = {.mu_static = 0.15, .mu_dynamic = 0.1, .speed = 0.05};
}
void give(AnisotropicCoulomb& f) {
  f = {.mu_along = 0.1, .mu_across = 0.15, .direction = {1, 0, -0.5}};
}
void give(Penalty& e) {
  e = {.normal = 2e3, .tangential = 1e3, .per = PenaltyPer::area};
}
void give(AugmentedLagrangian&) {}

V3 in_space(const Vec<Real, 2>& v) {
  return {v[0], v[1], 0};
}
V3 in_space(const V3& v) {
  return v;
}
V3 total(const Field& field, int dim) {
  V3 sum = V3::Zero();
  for (Index c = 0; c < field.size(); ++c) sum[c % dim] += field[c];
  return sum;
}
Field between(const Field& from, const Field& to, Real weight) {
  return (1 - weight) * from + weight * to;
}
Real asymmetry(const SparseView& matrix) {
  if (matrix.symmetry == Symmetry::symmetric) return 0;
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(matrix.size, matrix.size);
  for (Index j = 0; j < matrix.size; ++j)
    for (Index k = matrix.column_start[j]; k < matrix.column_start[j + 1]; ++k)
      full(matrix.row[k], j) = matrix.values[k];
  return (full - full.transpose()).cwiseAbs().maxCoeff() / full.cwiseAbs().maxCoeff();
}

namespace {

void check_balance(const Facts& facts, const Answer& answer) {
  for (const Step& step : answer.steps) {
    const V3 needed = step.rubbing + step.wall + step.momentum;
    const Real scale = needed.norm() + step.supports.norm() + 1;
    // In axisymmetry the hoop stress bears radial force as well.
    for (int i = facts.hoop ? 1 : 0; i < facts.dim; ++i) CHECK(std::abs(step.supports[i] - needed[i]) < 1e-8 * scale);
    CHECK((step.momentum.norm() > 1e-3) == facts.inertia);
  }
}

void check_contact(const Facts& facts, const Answer& answer) {
  Real dissipated = 0;
  for (const Step& step : answer.steps) {
    const ContactSummary& contact = step.report.contact;
    const Real slope = std::hypot(step.rubbing[0], step.rubbing[2]);
    CHECK(step.rubbing[1] > 1);
    CHECK(contact.dissipated >= 0);
    CHECK(slope <= (contact.friction_capacity + step.report.lag * contact.friction_capacity) * (1 + 1e-9) +
                       1e-12 * step.rubbing[1]);
    CHECK((step.report.lag == 0 || !facts.follows));
    if (facts.augmented)
      CHECK(contact.max_penetration < 0.51e-4);  // in parts of the distance of the nodes, which is half a unit
    else
      CHECK(contact.max_penetration > 1e-4);
    CHECK((step.report.outer_iterations == 1 || facts.outer_iterations));
    dissipated += contact.dissipated;
  }
  const Step& end = answer.steps.back();
  CHECK((end.report.contact.sliding > 0) == facts.friction);
  CHECK((dissipated > 1e-3) == facts.friction);
  // The body holds the tool back.
  if (facts.friction) CHECK(-end.rubbing[0] > 0.01 * end.rubbing[1]);
  CHECK((end.wall[0] > 1) == facts.wall);
}

void check_symmetry(const Facts& facts, const Answer& answer) {
  CHECK(facts.system == (facts.follows ? Symmetry::general : facts.material));
  if (facts.system == Symmetry::symmetric)
    CHECK(answer.asymmetry < 1e-12);
  else if (facts.follows)
    CHECK(answer.asymmetry > 1e-4);
  // The tangent of a hypoelastic law is symmetric where a step does not deform the body (tests/tangent).
}

// Answers of the models that have run, by all choices but the solver.
std::map<std::array<std::size_t, axes - 1>, std::vector<Answer>>& answers() {
  static std::map<std::array<std::size_t, axes - 1>, std::vector<Answer>> all;
  return all;
}
void check_partners(const Row& row, const Answer& answer) {
  std::array<std::size_t, axes - 1> rest;
  const auto numbers = row.numbers();
  std::copy_n(numbers.begin(), rest.size(), rest.begin());
  auto& same = answers()[rest];
  if (!same.empty()) {
    const Answer& other = same.front();
    CHECK((answer.u - other.u).norm() < 1e-9 * other.u.norm());
    for (std::size_t n = 0; n < other.steps.size(); ++n) {
      CHECK((answer.steps[n].rubbing - other.steps[n].rubbing).norm() < 1e-9 * other.steps[n].rubbing.norm());
      CHECK(answer.steps[n].report.contact.sliding == other.steps[n].report.contact.sliding);
    }
  }
  same.push_back(answer);
}

}  // namespace

void check(const Row& row, const Facts& facts, const Answer& answer) {
  std::string name;
  for (const std::size_t n : row.numbers()) name += ' ' + std::to_string(n);
  INFO("model of choices" << name);
  REQUIRE_MESSAGE(answer.outcome, answer.outcome.message());
  CHECK(answer.rejected == 0);
  REQUIRE(answer.steps.size() == 3);
  check_balance(facts, answer);
  if (facts.contact) check_contact(facts, answer);
  check_symmetry(facts, answer);
  CHECK((answer.plastic_strain > 1e-3) == facts.plastic);
  CHECK(answer.u.norm() > 0.01);
  check_partners(row, answer);
}

}  // namespace typed
