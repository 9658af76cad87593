// SPDX-License-Identifier: BSL-1.0
// The estimates of a step's errors against the errors themselves, on the paper's extrusion (theory.md, section 6.6).
#include <stickslip/advise.hpp>
#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/stickslip.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace stickslip;

namespace {

template <class Friction_, class Solver = Banded>
struct Extrusion : QuasistaticDefaults {
  using Kinematics = Axisymmetric;
  using Material = FiniteJ2<LinearHardening>;
  using Friction = Friction_;
  using LinearSolver = Solver;
};

constexpr Real radius = 50.8, length = 254, travel = 178;

rigid::Profile die(bool container) {
  const Real angle = 5 * pi / 180, fillet = 10, cut = fillet * std::tan(0.5 * angle);
  if (!container) return rigid::line({radius, length}, {-std::sin(angle), std::cos(angle)});
  return rigid::path({radius, length - cut - 100}, {0, 1}).straight(100).left(fillet, angle).straight(100).endless();
}

struct Run {
  std::vector<Real> x{0}, f{0};  // travel [mm] and force [N]
  RunReport report{};
  RunSummary summary{};
  bool completed = false;
};

struct Asked {
  bool container = false;
  Index steps = 0;
  Real stiffer = 1;  // penalty over the paper's
  Real tolerance = 1e-4;
  Real lag_tolerance = 0, step_tolerance = 0;
};

template <class Friction, class Solver = Banded>
Run extrude(const Asked& asked) {
  using M = Extrusion<Friction, Solver>;
  Problem<M> billet{{
      .body = mesh::rectangle({.size = {radius, length}, .cells = {4, 20}}),
      .material = {.young = 68956, .poisson = 0.32, .hardening = {.yield = 31.0, .modulus = 261.2}},
      .contacts = {{.side = "right",
                    .tool = die(asked.container),
                    .friction = {.mu = 0.1},
                    .enforcement = {.normal = 1e7 * asked.stiffer, .tangential = 1e6}}},
  }};
  billet.hold("left", 0).drive("bottom", 1, [](Real t) { return travel * t; });
  MarchOptions options;
  options.steps = asked.steps;
  options.initial = 0.1 / travel;
  options.largest = 1.6 / travel;
  options.tolerance = asked.tolerance;
  options.lag_tolerance = asked.lag_tolerance;
  options.step_tolerance = asked.step_tolerance;
  Run run;
  auto march = billet.march(options);
  for ([[maybe_unused]] const StepReport& step : march) {
    run.x.push_back(travel * billet.time());
    run.f.push_back(billet.reaction("bottom", 1));
  }
  run.report = march.report();
  run.summary = RunSummary::of(march);
  run.completed = bool(march.outcome());
  return run;
}

Real force_at(const Run& run, Real x) {
  const auto after = std::upper_bound(run.x.begin(), run.x.end(), x) - run.x.begin();
  const auto i = std::size_t(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ptrdiff_t(run.x.size()) - 2));
  return run.f[i] + (run.f[i + 1] - run.f[i]) * (x - run.x[i]) / (run.x[i + 1] - run.x[i]);
}

// Mean difference of the forces at the ends of the steps over the mean force.
Real difference(const Run& run, const Run& reference) {
  Real off = 0, whole = 0;
  for (std::size_t i = 1; i < run.x.size(); ++i) {
    const Real h = run.x[i] - run.x[i - 1], f = force_at(reference, run.x[i]);
    off += h * std::abs(run.f[i] - f);
    whole += h * std::abs(f);
  }
  return off / whole;
}

void check_effectivity(const std::string& what, Real estimate, Real error) {
  MESSAGE(what << ": estimate " << estimate << ", error " << error << ", ratio " << estimate / error);
  CHECK(estimate > 0.3 * error);
  CHECK(estimate < 3 * error);
}

}  // namespace

TEST_CASE("the estimates by lag, step size and penetration bound the error of the extrusion's force") {
  for (const bool container : {false, true}) {
    CAPTURE(container);
    const Run reference = extrude<Coulomb>({.container = container, .steps = 2000, .tolerance = 1e-5});
    REQUIRE(reference.completed);
    for (const Index steps : {0, 180, 360}) {
      CAPTURE(steps);
      const Run exact = extrude<Coulomb>({.container = container, .steps = steps});
      REQUIRE(exact.completed);
      CHECK(exact.report.errors.lag == 0);
      CHECK(exact.report.errors.space == 0);  // was not asked for
      check_effectivity("step", exact.report.errors.time, difference(exact, reference));
      const Run lagged = extrude<QuasiCoulomb>({.container = container, .steps = steps});
      REQUIRE(lagged.completed);
      check_effectivity("lag", lagged.report.errors.lag, difference(lagged, reference));
    }
    for (const Real stiffer : {0.3, 3.0}) {
      CAPTURE(stiffer);
      const Run soft = extrude<Coulomb>({.container = container, .steps = 250, .stiffer = stiffer});
      const Run hard = extrude<Coulomb>({.container = container, .steps = 250, .stiffer = 50 * stiffer});
      REQUIRE(soft.completed);
      REQUIRE(hard.completed);
      check_effectivity("penetration", soft.report.errors.penetration, difference(soft, hard));
    }
  }
}

TEST_CASE("automatic steps keep the tolerances of lag and step error") {
  Real before = 1;
  for (const Real tolerance : {0.02, 0.01, 0.005}) {
    const Run run = extrude<QuasiCoulomb>({.lag_tolerance = tolerance});
    REQUIRE(run.completed);
    MESSAGE("lag tolerance " << tolerance << ": " << run.report.steps << " steps, estimate " << run.report.errors.lag);
    CHECK(run.report.errors.lag < 1.2 * tolerance);
    CHECK(run.report.errors.lag < before);
    before = run.report.errors.lag;
  }
  const Run coarse = extrude<Coulomb>({.tolerance = 1e-5}),
            fine = extrude<Coulomb>({.tolerance = 1e-5, .step_tolerance = 1e-3});
  REQUIRE(fine.completed);
  MESSAGE("step tolerance 0.001: " << fine.report.steps << " steps, estimate " << fine.report.errors.time << " after "
                                   << coarse.report.errors.time);
  CHECK(fine.report.errors.time < 0.5 * coarse.report.errors.time);
}

TEST_CASE("a run with the recommended steps and solver reaches the wished accuracy") {
  for (const bool container : {false, true}) {
    CAPTURE(container);
    const Run reference = extrude<Coulomb>({.container = container, .steps = 2000, .tolerance = 1e-5});
    const Run coarse = extrude<QuasiCoulomb>({.container = container});
    for (const Real wished : {0.02, 0.005}) {
      CAPTURE(wished);
      const Advice advice = advise(coarse.summary, wished);
      MESSAGE(advice.words);
      CHECK(advice.friction == "current");  // the lag would take many more steps; which factor depends on the machine
      CHECK(advice.steps > 0);
      const Run run = extrude<Coulomb, Corrected<BandedCholesky>>({.container = container, .steps = advice.steps});
      REQUIRE(run.completed);
      CHECK(difference(run, reference) < wished);
    }
  }
  CHECK_THROWS_AS(advise(RunSummary{}, 0.01), std::invalid_argument);
  const Run run = extrude<QuasiCoulomb>({});
  CHECK_THROWS_AS(advise(run.summary, 0), std::invalid_argument);
  CHECK_THROWS_AS(advise(run.summary, 1), std::invalid_argument);
  CHECK(run.summary.bound == RunSummary::Bound::lagged);
  CHECK(extrude<Coulomb>({.steps = 60}).summary.bound == RunSummary::Bound::current);
}

TEST_CASE("the estimated mesh error of the stress is that of a comparison with a finer mesh") {
  using M = Extrusion<Frictionless>;
  using Stress = Tensor<Real, Axisymmetric::TensorPattern>;
  constexpr Index fine_cells = 4;  // in a coarse one, by direction
  const auto stressed = [](Index refine, Real& estimate) {
    auto billet = std::make_unique<Problem<M>>(typename Problem<M>::Parameters{
        .body = mesh::rectangle({.size = {radius, length}, .cells = {4 * refine, 20 * refine}}),
        .material = {.young = 68956, .poisson = 0.32, .hardening = {.yield = 31.0, .modulus = 261.2}},
        .contacts = {{.side = "right", .tool = die(true), .enforcement = {.normal = 1e7, .per = PenaltyPer::area}}}});
    billet->hold("left", 0).drive("bottom", 1, [](Real t) { return 0.4 * travel * t; });
    MarchOptions options;
    options.steps = 60;
    options.mesh_error_interval = 59;
    auto march = billet->march(options);
    for (const StepReport& step : march) estimate = step.errors.space;
    REQUIRE(bool(march.outcome()));
    return billet;
  };
  const auto at_point = [](const auto& body, const Stress& F, const auto& state) {
    Stress s = kirchhoff(body.material().respond(F, state, 0.0).P, F);
    s.v /= determinant(F);
    return s;
  };
  for (const Index refine : {1, 2}) {
    Real estimate = 0, unused = 0;
    const auto coarse = stressed(refine, estimate), fine = stressed(fine_cells * refine, unused);
    // The coarse stresses at their Gauss points, continued bilinearly over the cell.
    std::vector<std::array<Stress, 4>> gauss(coarse->body().mesh().cells.size());
    coarse->body().visit_points(coarse->displacement(), [&](Index e, int p, const Stress& F, const auto& state, Real) {
      gauss[std::size_t(e)][std::size_t(p)] = at_point(coarse->body(), F, state);
    });
    const auto& mesh = coarse->body().mesh();
    const auto& fine_mesh = fine->body().mesh();
    const auto rule = Quad4::quadrature();
    const auto parent = [&](const Vec<Real, 2>& X) {
      for (Index e = 0; e < mesh.cell_count(); ++e) {
        const auto& cell = mesh.cells[std::size_t(e)];
        const auto &low = mesh.nodes[std::size_t(cell[0])], &high = mesh.nodes[std::size_t(cell[2])];
        if ((X.array() > low.array()).all() && (X.array() < high.array()).all()) return e;
      }
      return Index(-1);
    };
    Real off = 0, whole = 0;
    fine->body().visit_points(
        fine->displacement(), [&](Index e, int p, const Stress& F, const auto& state, Real weight) {
          const auto& nodes = fine_mesh.cells[std::size_t(e)];
          Vec<Real, 2> X = Vec<Real, 2>::Zero();
          const auto N = Quad4::shape(rule[std::size_t(p)].xi);
          for (int a = 0; a < 4; ++a) X += N[a] * fine_mesh.nodes[std::size_t(nodes[std::size_t(a)])];
          const Index c = parent(X);
          if (c < 0) throw std::logic_error("a fine point lies in no coarse cell");
          const auto& cell = mesh.cells[std::size_t(c)];
          const Vec<Real, 2> low = mesh.nodes[std::size_t(cell[0])], high = mesh.nodes[std::size_t(cell[2])];
          const Vec<Real, 2> xi = (2 * (X - low).array() / (high - low).array() - 1).matrix();
          const auto share = Quad4::shape(std::sqrt(3.0) * xi);
          const Stress exact = at_point(fine->body(), F, state);
          Stress s = exact;
          for (int a = 0; a < 4; ++a) s.v -= share[a] * gauss[std::size_t(c)][std::size_t(a)].v;
          off += weight * s.v.squaredNorm();
          whole += weight * exact.v.squaredNorm();
        });
    check_effectivity("space", estimate, std::sqrt(off / whole));
  }
}
