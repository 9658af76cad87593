// SPDX-License-Identifier: BSL-1.0
#include <stickslip/base/outcome.hpp>
#include <stickslip/solve/step_control.hpp>

#include <doctest/doctest.h>

#include <functional>

namespace {

using namespace stickslip;

// Runs a control to its end; `iterations` of a step that ends at a time, 0 to reject it. Returns the times met.
std::vector<Real> run(const MarchOptions& options, Real begin, const std::function<Index(Real, Real)>& iterations) {
  StepControl control(options, begin);
  std::vector<Real> times{begin};
  for (int guard = 0; guard < 1000 && !control.finished(); ++guard) {
    const Real next = control.next();
    CHECK(next > control.time());
    const Index n = iterations(control.time(), next);
    if (n == 0) {
      control.reject(next);
      if (control.too_small()) break;
    } else {
      control.accept(next, n);
      times.push_back(next);
    }
  }
  return times;
}
Real shortest(const std::vector<Real>& times) {
  Real h = 1e300;
  for (std::size_t i = 1; i < times.size(); ++i) h = std::min(h, times[i] - times[i - 1]);
  return h;
}
bool holds(const std::vector<Real>& times, Real t) {
  return std::find(times.begin(), times.end(), t) != times.end();
}

TEST_CASE("equal steps meet their grid exactly") {
  for (const Index n : {1, 3, 7, 10, 100}) {
    const auto times = run({.end = 1.7, .steps = n}, 0.2, [](Real, Real) { return 3; });
    CHECK(times.size() == std::size_t(n + 1));
    for (Index k = 0; k < n; ++k) CHECK(times[std::size_t(k)] == 0.2 + (1.7 - 0.2) * k / n);
    CHECK(times.back() == 1.7);
  }
}
TEST_CASE("equal steps return to their grid after a rejection") {
  int calls = 0;
  const auto times = run({.end = 1, .steps = 4}, 0, [&](Real, Real) { return ++calls == 2 ? 0 : 3; });
  const std::vector<Real> expected{0, 0.25, 0.35, 0.45, 0.5, 0.75, 1};
  CHECK(times.size() == expected.size());
  for (std::size_t i = 0; i < std::min(times.size(), expected.size()); ++i)
    CHECK(times[i] == doctest::Approx(expected[i]).epsilon(1e-14));
  CHECK(holds(times, 0.5));
}
TEST_CASE("equal steps meet stops between their grid points") {
  const auto times = run({.end = 1, .steps = 4, .stops = {0.6, 0.5}}, 0, [](Real, Real) { return 3; });
  CHECK(times == std::vector<Real>{0, 0.25, 0.5, 0.6, 0.75, 1});
}
TEST_CASE("automatic steps meet every stop and the end exactly, without tiny remainders") {
  for (const Real initial : {0.01, 0.0371, 0.2})
    for (const Index n : {2, 3, 4, 6}) {
      const std::vector<Real> stops{0.7, 0.1234567, 0.5, 1.0};  // in no order, one of them the end
      // Small steps take n iterations, or 3 where large ones take more than wanted.
      const auto times = run({.end = 1, .initial = initial, .largest = 0.2, .stops = stops}, 0,
                             [&](Real from, Real to) { return n <= 4 || to - from > 0.03 ? n : 3; });
      for (const Real stop : stops) CHECK(holds(times, stop));
      CHECK(times.back() == 1);
      CHECK(shortest(times) > 0.2 * std::min(initial, 0.03));
    }
}
TEST_CASE("automatic steps grow after few iterations, shrink after many, and keep the limits") {
  const auto quick = run({.end = 1, .initial = 0.01, .largest = 0.1}, 0, [](Real, Real) { return 2; });
  CHECK(quick[1] == 0.01);
  CHECK(quick[2] - quick[1] == doctest::Approx(0.01 * std::sqrt(2.0)));
  for (std::size_t i = 1; i < quick.size(); ++i) CHECK(quick[i] - quick[i - 1] <= 0.1 * (1 + 1e-12));
  CHECK(quick.size() < 25);
  const auto slow = run({.end = 1, .initial = 0.1}, 0, [](Real, Real t) { return t < 0.15 ? 16 : 4; });
  CHECK(slow[2] - slow[1] == doctest::Approx(0.05));
  const auto level = run({.end = 1, .initial = 0.125}, 0, [](Real, Real) { return 4; });
  CHECK(level.size() == 9);
}
TEST_CASE("the first automatic step is a hundredth of the run unless given") {
  CHECK(StepControl({.end = 3}, 1).next() == doctest::Approx(1.02));
  CHECK(StepControl({.end = 3, .initial = 0.5}, 1).next() == doctest::Approx(1.5));
  CHECK(StepControl({.end = 3, .initial = 0.5, .largest = 0.1}, 1).next() == doctest::Approx(1.1));
}
TEST_CASE("a rejected step is cut, and the size recovers") {
  bool rejected = false;
  std::vector<Real> tried;
  const auto times = run({.end = 3, .initial = 0.1}, 0, [&](Real from, Real to) {
    tried.push_back(to - from);
    if (!rejected && from > 0.25) {
      rejected = true;
      return 0;
    }
    return 3;
  });
  std::size_t at = 0;
  while (tried[at + 1] > 0.5 * tried[at]) ++at;
  CHECK(tried[at + 1] == doctest::Approx(0.4 * tried[at]));
  CHECK(tried[at + 2] > tried[at + 1]);
  CHECK(*std::max_element(tried.begin() + std::ptrdiff_t(at) + 1, tried.end()) > 0.9 * tried[at]);  // full size again
  CHECK(times.back() == 3);
}
TEST_CASE("a step that never converges is given up below the smallest size") {
  Real smallest = 1;
  const auto times = run({.end = 1, .initial = 0.1, .smallest = 1e-4}, 0, [&](Real from, Real to) {
    smallest = std::min(smallest, to - from);
    return from >= 0.3 ? 0 : 4;
  });
  CHECK(times.back() < 1);
  CHECK(smallest >= 1e-4);
  CHECK(smallest < 1e-3);
}
TEST_CASE("equal steps return to their grid in a number of steps proportional to the logarithm of the cut") {
  // A first contact at 0.3001, which only steps below `depth` get over; in 4 equal steps.
  for (const Real depth : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const Real event = 0.3001;
    const auto times = run({.end = 1, .steps = 4}, 0, [&](Real from, Real to) {
      return from < event && to >= event && to - from > depth ? 0 : 5;
    });
    for (const Real t : {0.25, 0.5, 0.75, 1.0}) CHECK(holds(times, t));
    CHECK(double(times.size()) < 20 + 10 * std::log(0.25 / depth));
    std::size_t at = 0;
    while (times[at] < event) ++at;
    // Behind it the size grows at every step but the first, by half.
    for (std::size_t k = at + 1; times[k + 1] < 0.45; ++k)
      CHECK(times[k + 1] - times[k] == doctest::Approx(1.5 * (times[k] - times[k - 1])).epsilon(1e-6));
    CHECK(times[times.size() - 2] == 0.75);
  }
}
TEST_CASE("where equal steps stay too long, few enlarged ones are rejected") {
  int vain = 0;
  const auto times = run({.end = 1, .steps = 2}, 0, [&](Real from, Real to) {
    if (to - from < 5e-3) return 5;
    ++vain;
    return 0;
  });
  CHECK(times.back() == 1);
  CHECK(times.size() < 450);
  CHECK(vain < 150);
}
TEST_CASE("steps below the resolution of the time are refused or given up") {
  const auto refused = [](const MarchOptions& options, Real now, const char* part) {
    CHECK_THROWS_WITH_AS(options.validate(now), doctest::Contains(part), std::invalid_argument);
  };
  const Real late = 1e6;
  refused({.end = late + 1, .initial = 1e-12}, late, "a first step of 1e-12 is below what a time of 1e+06 resolves");
  refused({.end = late + 1, .largest = 1e-12}, late, "a largest step of 1e-12");
  refused({.end = 1, .initial = 1e-30}, 0, "a first step of 1e-30");
  refused({.end = std::nextafter(late, 2 * late)}, late, "a first step");
  refused({.end = late + 1e-9, .steps = 100}, late, "equal steps of ");
  MarchOptions{.end = late + 1, .initial = 1e-6}.validate(late);
  MarchOptions{.end = 1e-20, .steps = 10}.validate(0);  // it is a matter of digits, not of size
  // Cut without end, a step is given up before it ends where it began, whatever `smallest` asks for.
  for (const Index steps : {0, 5}) {
    StepControl control({.end = late + 1, .steps = steps, .smallest = 1e-30}, late);
    while (!control.too_small()) {
      CHECK(control.next() > late);
      control.reject(control.next());
    }
  }
  // Nor do steps that converge shrink to it.
  StepControl shrinking({.end = late + 1, .initial = 0.1, .smallest = 1e-4}, late);
  for (int k = 0; k < 200; ++k) {
    const Real from = shrinking.time(), to = shrinking.next();
    CHECK(to > from);
    shrinking.accept(to, 4, 0, 100);
    CHECK_FALSE(shrinking.too_small());
  }
  // A run that ends at time zero, and one that begins below it.
  const auto before = run({.end = 0, .steps = 4, .stops = {-0.3}}, -1, [](Real, Real) { return 4; });
  CHECK(before == std::vector<Real>{-1, -0.75, -0.5, -0.3, -0.25, 0});
}
TEST_CASE("a step shortened by a stop does not shrink the steps after it") {
  const auto times = run({.end = 10, .initial = 1, .stops = {2.6}}, 0, [](Real, Real) { return 4; });
  CHECK(holds(times, 2.6));
  Real after = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
    if (times[i - 1] == 2.6) after = times[i] - times[i - 1];
  CHECK(after == doctest::Approx(1));
}

TEST_CASE("an outcome's message has cause, location, step, time and attempts") {
  CHECK(Outcome{}.message() == "completed");
  CHECK(bool(Outcome{}));
  const Outcome bad{.failure = {FailureCause::element_inverted, {Location::Kind::element, 17}},
                    .step = 4,
                    .time = 0.25,
                    .tried_step = 0.001,
                    .attempts = 6};
  CHECK_FALSE(bool(bad));
  const std::string text = bad.message();
  for (const char* part : {"step 4", "0.25", "inside out", "element 17", "6 times", "0.001"})
    CHECK(text.find(part) != std::string::npos);
  const Outcome small{
      .failure = {FailureCause::stalled, {}}, .step = 1, .time = 1.25e-7, .tried_step = 3e-15, .attempts = 2};
  for (const char* part : {"after time 1.25e-07 ", "increment of 3e-15"})
    CHECK(small.message().find(part) != std::string::npos);
  const auto placed = [](Location::Kind kind) {
    return Outcome{.failure = {FailureCause::not_finite, {kind, 5}}}.message();
  };
  CHECK(placed(Location::Kind::node).find("(node 5)") != std::string::npos);
  CHECK(placed(Location::Kind::contact_node).find("(contact node 5)") != std::string::npos);
  CHECK(placed(Location::Kind::nowhere).find("(") == std::string::npos);
  std::vector<std::string> texts;
  for (const FailureCause c : {FailureCause::element_inverted, FailureCause::not_finite, FailureCause::not_rigid,
                               FailureCause::material_failed, FailureCause::singular_matrix,
                               FailureCause::not_converged, FailureCause::stalled}) {
    const std::string one = describe(c);
    CHECK(one != "nothing");
    CHECK(one != "an unknown cause");
    CHECK(std::find(texts.begin(), texts.end(), one) == texts.end());
    texts.push_back(one);
  }
}

}  // namespace
