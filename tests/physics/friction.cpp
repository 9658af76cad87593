// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_direct.hpp>

#include <doctest/doctest.h>

namespace {

using namespace scene;

// A block on a flat tool that slides along, pressed more and more. Force on the tool at the end.
template <class F>
V sliding_block(Real mu, Index steps, Real growth, std::function<void(const StepReport&, const V&)> look = {}) {
  using M = Model<EigenDirect, F>;
  Contact<M> contact{.side = "bottom",
                     .tool = rigid::line({0, 0}, {1, 0}),
                     .motion = [](Real t) { return V(2 * t, 0); },
                     .enforcement = {.normal = 1e5, .tangential = 2e4}};
  if constexpr (F::active) contact.friction = {.mu = mu};
  Problem<M> p({.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}),
                .material = material<Hencky>(),
                .contacts = {contact}});
  p.hold("top", 0).drive("top", 1, [growth](Real t) { return -0.02 - growth * t * (1 + 0.5 * t); });
  auto march = p.march({.end = 1, .steps = steps, .tolerance = 1e-10});
  for (const auto& step : march)
    if (look) look(step, p.contact_force("bottom"));
  CHECK(bool(march.outcome()));
  return p.contact_force("bottom");
}

TEST_CASE("Coulomb: a sliding block is dragged by mu N, to the tolerance of the balance") {
  int sliding = 0, sticking = 0;
  (void)sliding_block<Coulomb>(0.3, 100, 0.02, [&](const StepReport& step, const V& force) {
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

TEST_CASE("Quasi-Coulomb tends to Coulomb at first order as the steps shrink") {
  std::vector<Real> errors;
  for (const Index steps : {20, 40, 80, 160}) {
    const V exact = sliding_block<Coulomb>(0.3, steps, 0.02), lagged = sliding_block<QuasiCoulomb>(0.3, steps, 0.02);
    errors.push_back(std::abs(lagged[0] - exact[0]) / std::abs(exact[0]));
  }
  CHECK(errors[0] > 1e-3);
  for (std::size_t i = 1; i < errors.size(); ++i) {
    const Real order = std::log2(errors[i - 1] / errors[i]);
    CHECK(order > 0.8);
    CHECK(order < 1.2);
  }
}

TEST_CASE("Quasi-Coulomb reports the lag that it has") {
  std::vector<Real> lags;
  Real before = 0;
  (void)sliding_block<QuasiCoulomb>(0.3, 40, 0.02, [&](const StepReport& step, const V& force) {
    if (before > 0) CHECK(step.lag == doctest::Approx((-force[1] - before) / -force[1]).epsilon(0.2));
    before = -force[1];
    lags.push_back(step.lag);
  });
  CHECK(lags.front() == doctest::Approx(1));  // first contact: all of the bound is unseen
  CHECK(lags.back() < 0.1);
  CHECK(lags.back() > 1e-3);
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

}  // namespace
