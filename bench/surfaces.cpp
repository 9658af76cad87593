// SPDX-License-Identifier: BSL-1.0
// Contact between surfaces against known solutions, and what it costs.
//
// bench_surfaces [hertz | ironing | cost]; all three without a word. Prints CSV.
//   hertz    two cylinders (a parabola on a flat, equal materials) pressed together, then drawn along by less than
//            friction bears (Cattaneo & Mindlin): half-widths and pressure by least squares of the analytic profiles,
//            over the exact ones
//   ironing  a curved die, ten times as stiff, pressed into a slab and drawn over it in 45 steps, either side slave
//   cost     a slider on a slab of more and more facets: points a second, shares of a step
#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/linear_solver/cholmod.hpp>
#include <stickslip/linear_solver/umfpack.hpp>
#include <stickslip/stickslip.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

using namespace stickslip;

template <class Friction_>
struct Blocks : QuasistaticDefaults {
  struct Block : BodyDefaults {};
  using Bodies = BodyTypes<Block>;
  using Surfaces = SurfaceContact<Friction_>;
  using LinearSolver = std::conditional_t<friction_symmetry<Friction_>() == Symmetry::symmetric, Cholmod, Umfpack>;
};

Penalty penalty(Real normal) {
  return {.normal = normal, .tangential = normal, .per = PenaltyPer::area};
}

// --- Hertz, Cattaneo and Mindlin

constexpr Real radius = 500, young = 1000, poisson = 0.3, reach = 24, mu = 0.3;

// Nodes from 0: of one size to `fine`, then growing to the reach.
std::vector<Real> graded(Real size, Real fine) {
  std::vector<Real> at{0};
  while (at.back() < reach) {
    if (at.back() >= fine - 1e-9) size *= 1.25;
    const Real next = at.back() + size;
    at.push_back(reach - next < 0.5 * size ? reach : next);
  }
  return at;
}
Mesh<2, 4> half_space(Real size, bool upper) {
  const auto y = graded(size, 0.8);
  auto x = graded(size, 1.6);
  const Index half = static_cast<Index>(x.size()) - 1, rows = static_cast<Index>(y.size()) - 1;
  auto mesh = mesh::rectangle({.size = {2 * Real(half), Real(rows)}, .cells = {2 * half, rows}});
  for (auto& node : mesh.nodes) {
    const auto column = std::lround(node[0]) - half, row = upper ? std::lround(node[1]) : rows - std::lround(node[1]);
    const Real at = std::copysign(x[static_cast<std::size_t>(std::abs(column))], Real(column)),
               away = y[static_cast<std::size_t>(row)];
    node = upper ? Vec<Real, 2>(at, away + at * at / (2 * radius) * (1 - away / reach)) : Vec<Real, 2>(at, -away);
  }
  return mesh;
}

// Fits `profile(x, width)` times a factor to the nodes' tractions: the best width between two, and the factor.
template <class Profile>
std::pair<Real, Real> fit(const std::vector<Real>& x, const std::vector<Real>& traction, Real from, Real to,
                          Profile profile) {
  const auto factor_and_error = [&](Real width) {
    Real tp = 0, pp = 0, tt = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const Real p = profile(x[k], width);
      tp += traction[k] * p;
      pp += p * p;
      tt += traction[k] * traction[k];
    }
    return std::pair{tp / pp, tt - tp * tp / pp};
  };
  Real best = from;
  for (Real width = from; width < to; width += 1e-4)
    if (factor_and_error(width).second < factor_and_error(best).second) best = width;
  return {best, factor_and_error(best).first};
}

template <class Friction>
void hertz(const char* law, Real size, bool flat_is_slave) {
  using M = Blocks<Friction>;
  SurfaceContacts<M> contacts(1);
  contacts[0] = {.side = flat_is_slave ? "low.top" : "up.bottom",
                 .against = flat_is_slave ? "up.bottom" : "low.top",
                 .friction = {.mu = mu},
                 .enforcement = penalty(1e5),
                 .name = "joint"};
  Problem<M> problem{
      {.bodies = {{.name = "low", .mesh = half_space(size, false), .material = {.young = young, .poisson = poisson}},
                  {.name = "up",
                   .mesh = half_space(1.13 * size, true),
                   .material = {.young = young, .poisson = poisson}}},
       .surfaces = contacts}};
  problem.hold("low.bottom", 0).hold("low.bottom", 1);
  problem.drive("up.top", 0, [](Real t) { return 0.0012 * std::max(t - 1, 0.0); });
  problem.drive("up.top", 1, [](Real t) { return -0.006 * std::min(t, 1.0); });
  const auto& joint = problem.contact("joint");
  const auto areas = problem.bodies().side_areas(joint.side());
  std::vector<Real> x, along, down;
  const auto look = [&] {
    x.clear(), along.clear(), down.clear();
    for (std::size_t k = 0; k < areas.size(); ++k) {
      const Index n = joint.nodes()[k];
      x.push_back(problem.bodies().positions()[static_cast<std::size_t>(n)][0] + problem.displacement(n)[0]);
      along.push_back(std::abs(joint.states()[k].force[0]) / areas[k]);
      down.push_back(std::abs(joint.states()[k].force[1]) / areas[k]);
    }
  };
  auto press = problem.march({.end = 1, .steps = 20, .tolerance = 1e-8});
  bool completed = bool(press.finish());
  look();
  const Real modulus = young / (2 * (1 - poisson * poisson)), load = std::abs(joint.force()[1]),
             width = std::sqrt(4 * load * radius / (pi * modulus)), peak = 2 * load / (pi * width);
  const auto ellipse = [](Real at, Real a) { return std::sqrt(std::max(0.0, 1 - at * at / (a * a))); };
  const auto [a, p0] = fit(x, down, 0.5 * width, 1.5 * width, ellipse);
  const Index pressing = press.report().iterations;
  auto draw = problem.march({.end = 2, .steps = 20, .tolerance = 1e-8});
  completed = bool(draw.finish()) && completed;
  look();
  const Real share = std::abs(joint.force()[0] / joint.force()[1]) / mu, exact = std::sqrt(1 - share);
  const auto [c, q0] = fit(x, along, 0.1 * a, 0.95 * a,
                           [&, a = a](Real at, Real stick) { return ellipse(at, a) - stick / a * ellipse(at, stick); });
  std::printf("hertz,%s,%s,%.1f,%s,%.4f,%.4f,%.4f,%.4f,%.4f,%d,%d,%d\n", law, flat_is_slave ? "flat" : "parabola",
              width / size, completed ? "completed" : "ended early", a / width, p0 / peak, share, c / a / exact,
              q0 / (mu * p0), pressing, draw.report().iterations,
              press.report().rejected_steps + draw.report().rejected_steps);
}

// --- ironing

template <class Friction>
void ironing(const char* law, bool die_is_slave, Real normal) {
  using M = Blocks<Friction>;
  auto slab = mesh::rectangle({.origin = {0, -3}, .size = {12, 3}, .cells = {24, 8}});
  auto die = mesh::rectangle({.size = {2.4, 0.8}, .cells = {10, 4}});
  for (auto& x : die.nodes) {
    const Real s = x[0] - 1.2, bottom = 3 - std::sqrt(9 - s * s);
    x = Vec<Real, 2>(3 + s, bottom * (1 - x[1] / 0.8) + x[1]);
  }
  SurfaceContacts<M> contacts(1);
  contacts[0] = {.side = die_is_slave ? "die.bottom" : "slab.top",
                 .against = die_is_slave ? "slab.top" : "die.bottom",
                 .friction = {.mu = 0.3},
                 .enforcement = penalty(normal),
                 .name = "joint"};
  Problem<M> problem{{.bodies = {{.name = "slab", .mesh = slab, .material = {.young = 1, .poisson = 0.3}},
                                 {.name = "die", .mesh = die, .material = {.young = 10, .poisson = 0.3}}},
                      .surfaces = contacts}};
  problem.hold("slab.bottom", 0).hold("slab.bottom", 1);
  problem.drive("die.top", 1, [](Real t) { return -0.4 * std::min(t, 1.0); });
  problem.drive("die.top", 0, [](Real t) { return 4 * std::max(t - 1, 0.0) / 3.5; });
  auto march = problem.march({.end = 4.5, .steps = 45, .tolerance = 1e-6});
  Real low = 1e9, high = 0;
  for (const StepReport& step : march)
    if (step.time > 1.5 && step.time < 4) {
      const Real force = std::abs(problem.contact_force("joint")[1]);
      low = std::min(low, force), high = std::max(high, force);
    }
  const auto f = problem.contact_force("joint");
  std::printf("ironing,%s,%s,%g,%s,%d,%d,%d,%.4f,%.4f,%.4f\n", law, die_is_slave ? "die" : "slab", normal,
              march.outcome() ? "completed" : "ended early", march.report().steps, march.report().rejected_steps,
              march.report().iterations, std::abs(f[0]), std::abs(f[1]), high / low - 1);
}

// --- cost

void cost(Index facets) {
  using M = Blocks<QuasiCoulomb>;
  const Real size = 1.0 / 40;
  auto slab =
      mesh::rectangle({.origin = {0, -4 * size}, .size = {size * Real(facets), 4 * size}, .cells = {facets, 4}});
  auto slider =
      mesh::rectangle({.origin = {size, 0}, .size = {size * Real(facets - 3), 4 * size}, .cells = {facets * 7 / 8, 4}});
  Problem<M> problem{{.bodies = {{.name = "slab", .mesh = slab, .material = {.young = 1e3, .poisson = 0.3}},
                                 {.name = "slider", .mesh = slider, .material = {.young = 1e3, .poisson = 0.3}}},
                      .surfaces = {{.side = "slider.bottom",
                                    .against = "slab.top",
                                    .friction = {.mu = 0.2},
                                    .enforcement = penalty(1e5),
                                    .name = "joint"}}}};
  problem.hold("slab.bottom", 0).hold("slab.bottom", 1);
  problem.drive("slider.top", 1, [](Real t) { return -1e-3 * std::min(t, 1.0); });
  problem.drive("slider.top", 0, [=](Real t) { return 0.5 * size * std::max(t - 1, 0.0); });
  auto march = problem.march({.end = 3, .steps = 15});
  const bool completed = bool(march.finish());
  std::size_t points = 0;
  problem.visit_contacts([&](const auto& pair) {
    if constexpr (requires { pair.points(); }) points = pair.points().point_count();
  });
  // A search alone, as a step begins with it, and evaluations of the residual alone.
  const Timings& t = march.report().timings;
  const Real steps = march.report().steps, evaluations = Real(march.report().work.evaluations);
  std::printf("cost,%d,%d,%zu,%s,%d,%d,%.3g,%.3g,%.3g,%.3g,%.3g\n", facets, problem.unknowns(), points,
              completed ? "completed" : "ended early", march.report().steps, march.report().iterations,
              1e3 * t.update / steps, 1e3 * t.factorization / Real(march.report().iterations),
              1e3 * t.contact / evaluations, Real(points) * evaluations / t.contact, 1e3 * t.assembly / evaluations);
}

int main(int argc, char** argv) {
  const auto wanted = [&](const char* what) { return argc < 2 || std::strcmp(argv[1], what) == 0; };
  if (wanted("hertz")) {
    std::puts(
        "case,law,slave,facets in the half-width,outcome,half-width,peak,Q / mu P,stick width,traction,iterations "
        "pressing,drawing,rejected");
    for (const Real size : {0.12, 0.06, 0.03})
      for (const bool flat : {true, false}) {
        hertz<QuasiCoulomb>("quasi-coulomb", size, flat);
        hertz<Coulomb>("coulomb", size, flat);
      }
  }
  if (wanted("ironing")) {
    std::puts(
        "case,law,slave,penalty,outcome,steps,rejected,iterations,force along,force down,its scatter while drawn");
    for (const bool die : {false, true})
      for (const Real normal : {10.0, 100.0, 1000.0}) {
        ironing<QuasiCoulomb>("quasi-coulomb", die, normal);
        ironing<Coulomb>("coulomb", die, normal);
      }
  }
  if (wanted("cost")) {
    std::puts(
        "case,facets,unknowns,points,outcome,steps,iterations,search a step [ms],factorisation [ms],contact an "
        "evaluation [ms],points a second,bodies an evaluation [ms]");
    for (const Index facets : {100, 1000, 10000}) cost(facets);
  }
}
