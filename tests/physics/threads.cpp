// SPDX-License-Identifier: BSL-1.0
// Problems that run side by side in threads share nothing: every one comes to the bits that it has alone.
#include "scene.hpp"

#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/linear_solver/corrected.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>

#include <doctest/doctest.h>

#include <atomic>
#include <cstring>
#include <thread>
#include <vector>

namespace {

using namespace scene;

// All numbers that a run leaves.
template <class M>
std::vector<Real> run(Real mu) {
  auto problem = press_and_drag<M>(mu, 0.4, 1, {8, 4});
  std::vector<Real> left;
  auto march = problem->march({.end = 1, .steps = 12, .tolerance = 1e-9});
  for (const StepReport& step : march) {
    const V force = problem->contact_force("tool");
    left.insert(left.end(), {step.time, step.residual, step.contact.dissipated, step.errors.time, force[0], force[1]});
  }
  left.push_back(march.outcome() ? 1 : 0);
  const Field& u = problem->displacement();
  left.insert(left.end(), u.data(), u.data() + u.size());
  return left;
}

struct Job {
  std::vector<Real> (*run)(Real);
  Real mu;
};

std::vector<std::vector<Real>> all(const std::vector<Job>& jobs, int threads) {
  std::vector<std::vector<Real>> results(jobs.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&] {
      for (std::size_t k; (k = next++) < jobs.size();) results[k] = jobs[k].run(jobs[k].mu);
    });
  for (std::thread& worker : workers) worker.join();
  return results;
}

TEST_CASE("concurrent runs in one, two and four threads give the same bits") {
  using Metal = FiniteJ2<LinearHardening>;
  std::vector<Job> jobs;
  for (const Real mu : {0.1, 0.2, 0.3}) {
    jobs.push_back({run<Model<EigenLdlt, QuasiCoulomb, Metal>>, mu});
    jobs.push_back({run<Model<Corrected<BandedCholesky>, Coulomb, Metal>>, mu});
    jobs.push_back({run<Model<Banded, WithPressure<Coulomb, Symmetrised>>>, mu});
  }
  const auto alone = all(jobs, 1);
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    CHECK(alone[k].size() > 12 * 6);
    for (std::size_t other = 0; other < k; ++other) CHECK(alone[k] != alone[other]);
  }
  for (const int threads : {1, 2, 4, 4}) {
    const auto together = all(jobs, threads);
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      CAPTURE(threads);
      CAPTURE(k);
      REQUIRE(together[k].size() == alone[k].size());
      CHECK(std::memcmp(together[k].data(), alone[k].data(), alone[k].size() * sizeof(Real)) == 0);
    }
  }
}

}  // namespace
