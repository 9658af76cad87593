// SPDX-License-Identifier: BSL-1.0
// Friction, penalties, steps, corners and scales on an elastic block.
#include "run_case.hpp"

namespace {

using namespace stability;

const char* const all_laws = "6 of Coulomb x solvers";

// A block of 4 x 2 on a flat tool, its top pressed down by `press` until time 1 and moved along x by `drag`.
CaseSetup block(Real mu, Real press, const std::function<Real(Real)>& drag, std::vector<MarchOptions> marches) {
  CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 1000};
  s.contacts = {{.side = "bottom", .tool = rigid::line({0, 0}, {1, 0}), .mu = mu, .normal = 1e5, .tangential = 1e5}};
  s.driven = {{"top", 1, [press](Real t) { return -press * std::min(1.0, t); }}, {"top", 0, drag}};
  s.marches = std::move(marches);
  return s;
}
MarchOptions steps(Real end, Index count) {
  return {.end = end, .steps = count, .tolerance = 1e-10, .outer_tolerance = 1e-9, .max_outer = 60};
}
Real late(Real t) {
  return std::max(0.0, t - 1);
}
Real apart(const Field& a, const Field& b) {
  return (a - b).norm() / b.norm();
}

// Coulomb's friction force over the normal one.
Real ratio(const V& force) {
  return std::abs(force[0] / force[1]);
}

// --- friction

const HardCase range(
    "friction", "mu from 0 to 2", all_laws,
    "slides at mu N (a lagging law within its lag); mu = 0: frictionless field; never more than mu N", [](Case& c) {
      for (const TestedModel& b : elastic())
        for (const Real mu : {0.0, 0.05, 0.3, 1.0, 2.0}) {
          const CaseSetup s = block(mu, 0.05, [](Real t) { return 1.5 * late(t); }, {steps(1, 10), steps(2, 40)});
          Real lag = 0;
          const CaseResult p = b.run_case(s, [&](const ConvergedState& m) { lag = m.step.lag; });
          take(c, p);
          // From mu = 1 on a lagging law may find that it feeds back, where the block's edge comes and goes.
          if (b.lags && mu >= 1 && p.outcome().failure.cause == FailureCause::lag_unstable) continue;
          for (const Outcome& outcome : p.outcomes) c.require(bool(outcome), b.name + ": " + outcome.message());
          if (lag < 1e-9)
            for (const auto& n : p.nodes)
              c.require(std::abs(n.force[0]) <= (1 + 1e-8) * mu * std::abs(n.force[1]) + 1e-12,
                        b.name + ": no more than mu N");
          const bool slides =
              std::all_of(p.nodes.begin(), p.nodes.end(), [](const auto& n) { return n.sliding || !n.touching; });
          c.require(slides || mu >= 1, b.name + ": it slides");
          if (slides) c.small(std::abs(ratio(p.forces[0]) - mu), 1e-9 + mu * lag, b.name + ": mu N");
          if (mu == 0 && !b.augmented) {
            const CaseResult q = completes(c, smooth(), s);
            c.small(apart(p.u, q.u), 1e-9, b.name + ": frictionless field");
          }
        }
    });

const HardCase at_once(
    "friction", "stick to full slip over 3 element lengths in one step", all_laws,
    "field of 200 small steps, after 20 steps more", [](Case& c) {
      for (const TestedModel& b : elastic()) {
        const auto drag = [](Real t) { return 1.5 * std::min(1.0, late(t)) + 0.05 * std::max(0.0, t - 2); };
        const CaseResult p = completes(c, b, block(0.2, 0.05, drag, {steps(1, 5), steps(2, 1), steps(3, 20)}));
        const CaseResult q = completes(c, b, block(0.2, 0.05, drag, {steps(1, 5), steps(2, 200), steps(3, 20)}));
        c.small(apart(p.u, q.u), 1e-7, b.name + ": field");
        c.small((p.forces[0] - q.forces[0]).norm() / q.forces[0].norm(), 1e-7, b.name + ": force");
        c.small(std::abs(ratio(q.forces[0]) - 0.2), 1e-6, b.name + ": mu N");
      }
    });

// One stiff element pressed by a hair and moved to and fro.
CaseSetup loop(Real amplitude, Index cycles, Index quarter) {
  CaseSetup s{.body = mesh::rectangle({.size = {1, 1}}), .young = 1000, .poisson = 0};
  s.contacts = {{.side = "bottom", .tool = rigid::line({0, 0}, {1, 0}), .mu = 0.3, .normal = 1e4, .tangential = 1e4}};
  // Along the diagonal the element would lean on one node: the motion is that of all its nodes but for the sticking.
  s.driven = {{"top", 1, [](Real t) { return -1e-5 * std::min(1.0, t); }},
              {"top", 0, [amplitude](Real t) {
                 const Real x = std::fmod(late(t), 4.0);
                 return amplitude * (x < 1 ? x : x < 3 ? 2 - x : x - 4);
               }}};
  s.marches = {steps(1, 4), steps(1 + Real(4 * cycles), 4 * quarter * cycles)};
  return s;
}
const HardCase hysteresis("friction", "stick-slip reversals", all_laws,
                          "loops close; work over a loop = dissipation = 4 mu N (A - mu N / k)", [](Case& c) {
                            const Real amplitude = 2e-5;
                            for (const TestedModel& b : elastic()) {
                              Field before;
                              Real work = 0, friction = 0, area = 0, stiffness = 0, last_x = 0, last_f = 0, normal = 0;
                              int loops = 0;
                              const CaseResult p =
                                  completes(c, b, loop(amplitude, 6, 40), [&](const ConvergedState& m) {
                                    const Real x = m.u[m.u.size() - 2], f = m.force()[0], t = m.step.time;
                                    // The slope right after a reversal is that of sticking.
                                    if (t > 6 && stiffness == 0) stiffness = std::abs((f - last_f) / (x - last_x));
                                    last_x = x, last_f = f, normal = std::abs(m.force()[1]);
                                    if (t < 5 || std::abs(std::remainder(t - 1, 4.0)) > 1e-9) return;
                                    if (before.size() > 0 && t > 12) {
                                      ++loops;
                                      c.small(apart(m.u, before), 1e-9, b.name + ": closes");
                                      area = m.energies.friction - friction;
                                      // The trapezoidal work of a step within which a node begins to slide is off by
                                      // its square.
                                      c.near(m.energies.external - work, area, 1e-4, b.name + ": work = dissipation");
                                    }
                                    before = m.u;
                                    work = m.energies.external;
                                    friction = m.energies.friction;
                                  });
                              c.require(loops >= 3, b.name + ": loops");
                              const Real bound = 0.3 * normal;
                              c.near(area, 4 * bound * (amplitude - bound / stiffness), 1e-3,
                                     b.name + ": area of the loop");
                            }
                          });

const HardCase on_bound("friction", "a node exactly on the slip bound", all_laws,
                        "force and field continuous across it; mu N = k A there", [](Case& c) {
                          for (const TestedModel& b : elastic()) {
                            const auto pushed = [&](Real far, Index& sliding) {
                              CaseSetup s = loop(far, 1, 1);
                              s.marches = {steps(1, 4), steps(2, 1)};
                              const CaseResult p = completes(c, b, s);
                              sliding = 0;
                              for (const auto& n : p.nodes) sliding += n.sliding ? 1 : 0;
                              return p;
                            };
                            Real low = 1e-7, high = 1e-4;
                            Index sliding = 0, slides_high = 0;
                            for (int i = 0; i < 60 && high - low > 1e-16 * high; ++i) {
                              const Real middle = 0.5 * (low + high);
                              (void)pushed(middle, sliding);
                              (sliding > 0 ? high : low) = middle;
                            }
                            const CaseResult below = pushed(low, sliding), above = pushed(high, slides_high);
                            c.require(sliding == 0 && slides_high > 0, b.name + ": it was found");
                            c.small(apart(above.u, below.u), 1e-9, b.name + ": field");
                            c.small((above.forces[0] - below.forces[0]).norm() / below.forces[0].norm(), 1e-9,
                                    b.name + ": force");
                          }
                        });

// The block of tests/physics/wedge.cpp: a horizontal force drives it up, F / G = (tan a + mu) / (1 - mu tan a).
const HardCase wedge(
    "friction", "up a wedge with mu up to four times its slope", all_laws,
    "exact ratio of the forces, or the lag is named as the cause", [](Case& c) {
      const Real slope = 0.115, force = 100;
      for (const TestedModel& b : elastic())
        for (const Real mu : {0.1, 0.2, 0.5}) {
          CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}), .young = 2e5};
          s.contacts = {{.side = "bottom",
                         .tool = rigid::line({0, 0}, {1, slope}),
                         .motion = [](Real) { return V(4, 0); },
                         .mu = mu,
                         .normal = 1e5,
                         .tangential = 1e4,
                         .per = PenaltyPer::area}};
          s.driven = {{"top", 1, [](Real t) { return 0.5 * late(t); }}};
          s.loads = {{"left", 0, [force](Real t) { return force * std::min(1.0, t); }}};
          s.marches = {{.end = 2, .steps = 40, .tolerance = 1e-9, .outer_tolerance = 1e-8, .max_outer = 60}};
          Real carried = 0;
          const CaseResult p = b.run_case(s, [&](const ConvergedState& m) { carried = -m.reaction("top", 1); });
          take(c, p);
          if (b.lags && mu > slope)
            c.require(p.outcome().failure.cause == FailureCause::lag_unstable, b.name + ": " + p.outcome().message());
          else
            c.near(force / carried, (slope + mu) / (1 - mu * slope), b.lags ? 0.01 : 1e-6, b.name + ": F / G");
        }
    });

// --- penalties

// A block squeezed without friction: Hencky's law in plane strain and the penalty in series.
Real squeezed(Real young, Real poisson, Real width, Real height, Real press, Real penalty) {
  const Real modulus = young / (1 - poisson * poisson);
  const auto force = [&](Real e) { return -modulus * e / std::exp(e) * width; };  // e: logarithmic strain
  Real low = -20, high = 0;
  for (int i = 0; i < 200; ++i) {
    const Real e = 0.5 * (low + high);
    (height * (1 - std::exp(e)) + force(e) / (penalty * width) > press ? low : high) = e;
  }
  return force(low);
}
CaseSetup squeeze(Real young, Real poisson, std::array<Index, 2> cells, V size, Real press, Real penalty) {
  CaseSetup s{.body = mesh::rectangle({.size = size, .cells = cells}), .young = young, .poisson = poisson};
  s.contacts = {{.side = "bottom",
                 .tool = rigid::line({0, 0}, {1, 0}),
                 .normal = penalty,
                 .tangential = penalty,
                 .per = PenaltyPer::area}};
  s.driven = {{"top", 1, [press](Real t) { return -press * t; }}, {"left", 0, nullptr}};
  s.marches = {steps(1, 5)};
  return s;
}
const HardCase penalties(
    "penalties", "1e-2 to 1e12 times the body's stiffness", all_laws,
    "force of body and penalty in series, exactly; multipliers: without any penetration", [](Case& c) {
      const Real rigid_force = squeezed(1000, 0.3, 4, 2, 0.2, 1e30);
      for (const TestedModel& b : elastic())
        for (Real times = 1e-2; times < 2e12; times *= times < 5e5 ? 10 : 100) {
          const Real penalty = times * 1000 / 2;
          const CaseResult p = completes(c, b, squeeze(1000, 0.3, {4, 2}, {4, 2}, 0.2, penalty), {}, 1e-5);
          const Real exact = b.augmented ? rigid_force : squeezed(1000, 0.3, 4, 2, 0.2, penalty);
          c.near(std::abs(p.forces[0][1]), exact, b.augmented ? 1e-7 : 1e-8, b.name + " at " + Case::number(times));
          if (&b == &coulomb())
            c.note(Case::number(times) + ": force short of rigid by " + Case::number(1 - exact / rigid_force));
        }
    });
// A block pressed on a disc and dragged along; penalties in parts of the body's stiffness.
CaseResult on_disc(Case& c, const TestedModel& b, Real normal, Real tangential) {
  CaseSetup s{.body = mesh::rectangle({.size = {10, 5}, .cells = {16, 8}}), .young = 1000};
  s.contacts = {{.side = "bottom",
                 .tool = rigid::disc({5, -20}, 20),
                 .motion = [](Real t) { return V(0.5 * std::max(0.0, t - 0.3), 0); },
                 .mu = 0.2,
                 .normal = 1000 * normal,
                 .tangential = 1000 * tangential}};
  s.driven = {held("top", 0), {"top", 1, [](Real t) { return -0.5 * t; }}};
  s.marches = {{.end = 1, .steps = 20, .smallest = 1e-4, .tolerance = 1e-9, .outer_tolerance = 1e-6}};
  return completes(c, b, s, {}, 1e-5);
}
const HardCase penalties_disc("penalties", "a block dragged over a disc, 1 to 1e6 times",
                              "Coulomb; QuasiCoulomb; multipliers",
                              "error of the force falls as 1 / penalty; multipliers independent of theirs",
                              [](Case& c) {
                                const V best = on_disc(c, augmented(), 10, 1).forces[0];
                                Real before = 0;
                                for (Real times = 1; times < 2e6; times *= 10) {
                                  const CaseResult exact = on_disc(c, coulomb(), times, 1),
                                                   lagged = on_disc(c, quasi(), times, 1);
                                  const Real error = std::abs(exact.forces[0][1] / best[1] - 1);
                                  if (before > 1e-4)
                                    c.require(error < 0.2 * before, "first order at " + Case::number(times));
                                  c.small(std::abs(lagged.forces[0][1] / exact.forces[0][1] - 1), 0.005,
                                          "the laws agree at " + Case::number(times));
                                  c.note(Case::number(times) + ": " + Case::number(error));
                                  before = error;
                                }
                                for (const Real times : {1e-2, 1.0, 1e3})
                                  c.small((on_disc(c, augmented(), times, 1).forces[0] - best).norm() / best.norm(),
                                          1e-4, "multipliers from " + Case::number(times));
                              });
const HardCase stiff_sticking("penalties", "sticking 10 to 1e6 times as stiff as the body", "Coulomb; QuasiCoulomb",
                              "force of sticking as stiff as the body (full slip forgets it); under 110 iterations",
                              [](Case& c) {
                                for (const TestedModel* b : {&coulomb(), &quasi()}) {
                                  const V soft = on_disc(c, *b, 10, 1).forces[0];
                                  for (Real times = 10; times < 2e6; times *= 10) {
                                    const CaseResult p = on_disc(c, *b, 10, times);
                                    c.small((p.forces[0] - soft).norm() / soft.norm(), 1e-6, b->name);
                                    c.require(p.report.iterations < 110,
                                              b->name + ": " + std::to_string(p.report.iterations) + " iterations");
                                  }
                                }
                              });

// --- steps

// A disc pressed into the block's top and moved along.
CaseSetup indent(Real mu, std::vector<MarchOptions> marches) {
  CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 1000};
  s.contacts = {{.side = "top",
                 .tool = rigid::disc({1.5, 5}, 3),
                 .motion = [](Real t) { return V(std::max(0.0, t - 0.5), -0.8 * std::min(t, 0.5)); },
                 .mu = mu,
                 .normal = 1e5,
                 .tangential = 1e5}};
  s.driven = {held("bottom", 0), held("bottom", 1)};
  s.marches = std::move(marches);
  return s;
}
const HardCase large_and_small(
    "steps", "100 times too large, 1000 times too small", "Frictionless, EigenLdlt",
    "1, 100 and 100 000 steps give one field",
    [](Case& c) {
      const CaseResult fine = completes(c, smooth(), indent(0, {steps(1, 100)}));
      c.small(apart(completes(c, smooth(), indent(0, {steps(1, 1)})).u, fine.u), 1e-8, "one step");
      c.small(apart(completes(c, smooth(), indent(0, {steps(1, 100000)})).u, fine.u), 1e-8, "100 000 steps");
    },
    Form::full);
const HardCase large("steps", "100 times too large, 10 times too small", "Frictionless, EigenLdlt",
                     "1, 100 and 1000 steps give one field", [](Case& c) {
                       const CaseResult fine = completes(c, smooth(), indent(0, {steps(1, 100)}));
                       c.small(apart(completes(c, smooth(), indent(0, {steps(1, 1)})).u, fine.u), 1e-8, "one step");
                       c.small(apart(completes(c, smooth(), indent(0, {steps(1, 1000)})).u, fine.u), 1e-8,
                               "1000 steps");
                     });
const HardCase cut("steps", "fail, cut, go on", all_laws, "field of the same small steps asked for directly (1e-8)",
                   [](Case& c) {
                     for (const TestedModel& b : elastic()) {
                       std::vector<Real> times;
                       MarchOptions coarse = steps(1, 2);
                       coarse.max_iterations = b.augmented                  ? 6
                                               : b.name[0] == 'S'           ? 12
                                               : b.lags || b.name[0] == 'L' ? 6
                                                                            : 5;  // so that large steps fail
                       coarse.smallest = 1e-4;
                       const CaseResult p = completes(c, b, indent(0.3, {coarse}),
                                                      [&](const ConvergedState& m) { times.push_back(m.step.time); });
                       // Multipliers come through when a step is tried again.
                       c.require(p.report.rejected_steps > 0 || b.augmented, b.name + ": something was cut");
                       MarchOptions direct = steps(1, 1);
                       direct.stops = times;
                       const CaseResult q = completes(c, b, indent(0.3, {direct}));
                       c.require(q.report.rejected_steps == 0 && q.report.steps == p.report.steps,
                                 b.name + ": the same steps");
                       c.small(apart(p.u, q.u), 1e-8, b.name + ": field");
                     }
                   });
void no_drift(Case& c, Index cycles) {
  const TestedModel* const models[] = {&coulomb(), &quasi()};
  for (const TestedModel* b : models)
    for (const Real amplitude : {1e-6, 2e-5}) {  // sticks; slides
      Field first;
      Real largest = 0;
      (void)completes(c, *b, loop(amplitude, cycles, 5), [&](const ConvergedState& m) {
        if (m.step.time < 5 || std::abs(std::remainder(m.step.time - 1, 4.0)) > 1e-6) return;
        if (first.size() == 0 && m.step.time > 8) first = m.u;
        if (first.size() > 0) largest = std::max(largest, apart(m.u, first));
      });
      c.small(largest, 1e-8, b->name + ": drift");
    }
}
const HardCase drift("steps", "10 000 steps to and fro", "Coulomb; QuasiCoulomb",
                     "no drift (1e-8), sticking or sliding; energy balance closes", [](Case& c) { no_drift(c, 500); });
const HardCase long_drift(
    "steps", "100 000 steps to and fro", "Coulomb; QuasiCoulomb", "no drift (1e-8), sticking or sliding; energy balance closes",
    [](Case& c) { no_drift(c, 5000); }, Form::full);

}  // namespace
