// SPDX-License-Identifier: BSL-1.0
#include "sliding_block.hpp"

namespace friction {

using namespace scene;

TEST_CASE("under Coulomb's law a sliding block is dragged by mu N, to the tolerance of the balance") {
  int sliding = 0, sticking = 0;
  (void)sliding_block<Coulomb>({.mu = 0.3}, 100, 0.02, [&](const StepReport& step, const V& force) {
    const Real normal = -force[1], tangential = std::abs(force[0]);
    CHECK(step.contact.dissipated >= 0);
    CHECK(step.lag == 0);
    if (step.contact.sliding == 5) {
      ++sliding;
      CHECK(tangential == doctest::Approx(0.3 * normal).epsilon(1e-13));
    } else {
      ++sticking;
      CHECK(tangential < 0.3 * normal);
    }
  });
  CHECK(sliding > 20);
  CHECK(sticking > 0);
}

// Of the error of the friction force against Coulomb's at the same steps, from halving to halving of their size.
template <class F>
std::vector<Real> orders() {
  std::vector<Real> errors, orders;
  for (const Index steps : {20, 40, 80, 160}) {
    const V exact = sliding_block<Coulomb>({.mu = 0.3}, steps, 0.02);
    const V lagged = sliding_block<F>({.mu = 0.3}, steps, 0.02);
    errors.push_back(std::abs(lagged[0] - exact[0]) / std::abs(exact[0]));
    if (errors.size() > 1) orders.push_back(std::log2(errors[errors.size() - 2] / errors.back()));
  }
  CHECK(errors[0] > 1e-4);
  return orders;
}
TEST_CASE("Quasi-Coulomb tends to Coulomb at first order as the steps shrink") {
  for (const Real order : orders<QuasiCoulomb>()) CHECK(std::abs(order - 1) < 0.2);
}
TEST_CASE("Coulomb at the extrapolated pressure tends to Coulomb at second order") {
  for (const Real order : orders<ExtrapolatedCoulomb>()) CHECK(std::abs(order - 2) < 0.2);
}

TEST_CASE("Quasi-Coulomb reports the lag that it has") {
  std::vector<Real> lags;
  Real before = 0;
  (void)sliding_block<QuasiCoulomb>({.mu = 0.3}, 40, 0.02, [&](const StepReport& step, const V& force) {
    if (before > 0) CHECK(step.lag == doctest::Approx((-force[1] - before) / -force[1]).epsilon(0.2));
    before = -force[1];
    lags.push_back(step.lag);
  });
  // First contact: the bound is that of the step's own pressure, which friction lowers by a seventh here.
  CHECK(lags.front() < 1e-9);
  CHECK(lags[1] > 0.01);
  CHECK(lags.back() < 0.1);
  CHECK(lags.back() > 1e-3);
}

TEST_CASE("lagging laws are exact in the step of the first contact, in which there is one pressure only") {
  const V exact = sliding_block<Coulomb>({.mu = 0.3}, 1, 0.02);
  for (const V& lagged :
       {sliding_block<QuasiCoulomb>({.mu = 0.3}, 1, 0.02), sliding_block<ExtrapolatedCoulomb>({.mu = 0.3}, 1, 0.02)})
    CHECK((lagged - exact).norm() < 1e-9 * exact.norm());
}

template <class F>
Field end_of_drag(Real mu) {
  auto p = press_and_drag<Model<EigenDirect, F>>(mu);
  auto march = p->march({.end = 1, .steps = 10, .tolerance = 1e-10});
  CHECK(bool(march.finish()));
  CHECK(march.report().max_penetration > 1e-4);
  return p->displacement();
}
TEST_CASE("Coulomb and Quasi-Coulomb with mu = 0 are frictionless") {
  const Field smooth = end_of_drag<Frictionless>(0), exact = end_of_drag<Coulomb>(0),
              lagged = end_of_drag<QuasiCoulomb>(0);
  CHECK((exact - smooth).norm() < 1e-12 * smooth.norm());
  CHECK((lagged - smooth).norm() < 1e-12 * smooth.norm());
  CHECK((end_of_drag<QuasiCoulomb>(0.1) - smooth).norm() > 1e-3 * smooth.norm());
}

}  // namespace friction
