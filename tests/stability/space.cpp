// SPDX-License-Identifier: BSL-1.0
// Space: hexahedra, friction with two components, tools that turn about any axis.
#include "run_case.hpp"

#include <stickslip/geometry/extruded.hpp>
#include <stickslip/geometry/revolution.hpp>

namespace stability::space {
namespace {

const char* const all_laws = "4 of Coulomb x solvers, Hex8";
const char* const alone = "Frictionless, EigenLdlt, Hex8";

MarchOptions steps(Real end, Index count, Real tolerance = 1e-10) {
  return {.end = end, .steps = count, .tolerance = tolerance, .outer_tolerance = 1e-9, .max_outer = 60};
}
Real late(Real t) {
  return std::max(0.0, t - 1);
}
Real apart(const Field& a, const Field& b) {
  return (a - b).norm() / b.norm();
}
Real apart(const V& a, const V& b) {
  return (a - b).norm() / b.norm();
}
// Rotation about an axis.
M3 turn(const V& axis, Real angle) {
  const V a = axis.normalized();
  M3 w;
  w << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return M3::Identity() + std::sin(angle) * w + (1 - std::cos(angle)) * w * w;
}
rigid::Pose<3> turned(const M3& rotation, const V& centre, const V& shift = V::Zero()) {
  rigid::Pose<3> pose;
  pose.rotation = rotation;
  pose.translation = centre - rotation * centre + shift;
  return pose;
}
// The third component of a product of vectors.
Real across(const V& a, const V& b) {
  return a[0] * b[1] - a[1] * b[0];
}
// A side's components, all of them.
void hold(CaseSetup& s, const char* side) {
  for (const Index i : {0, 1, 2}) s.driven.push_back(held(side, i));
}
void drive(CaseSetup& s, const char* side, const std::function<V(Real)>& path) {
  for (const Index i : {0, 1, 2}) s.driven.push_back({side, i, [path, i](Real t) { return path(t)[i]; }});
}
V sum(const ConvergedState& m, const char* side) {
  return {m.reaction(side, 0), m.reaction(side, 1), m.reaction(side, 2)};
}

// A block of 4 x 4 x 2 on a plate, z = 0; its face at the front is pressed down by `press` until time 1 and moved.
CaseSetup block(Real mu, Real press, const std::function<V(Real)>& drag, std::vector<MarchOptions> marches,
                const std::array<Index, 3>& cells = {3, 3, 2}) {
  CaseSetup s{.body = mesh::box({.size = {4, 4, 2}, .cells = cells})};
  s.contacts = {{.side = "back",
                 .tool = rigid::plane({0, 0, 0}, {0, 0, 1}),
                 .mu = mu,
                 .normal = 1e5,
                 .tangential = 1e5,
                 .per = PenaltyPer::area}};
  drive(s, "front", [=](Real t) { return V(drag(t) + V(0, 0, -press * std::min(1.0, t))); });
  s.marches = std::move(marches);
  return s;
}

// --- friction

const HardCase range("space: friction", "mu from 0 to 2, dragged askew", all_laws,
                     "force = mu N against the way, both components; mu = 0: frictionless field; never more than mu N",
                     [](Case& c) {
                       const V along(std::cos(0.7), std::sin(0.7), 0);
                       for (const TestedModel& b : elastic())
                         for (const Real mu : {0.0, 0.05, 0.3, 1.0, 2.0}) {
                           // Directions forget where they came from over the length mu N / k of the block's spring.
                           const Real way = mu < 1 ? 4 : 1.5;
                           const CaseSetup s = block(mu, 0.05, [=](Real t) { return V(way * late(t) * along); },
                                                     {steps(1, 5), steps(2, 40)}, {2, 2, 1});
                           Real lag = 0;
                           const CaseResult p = completes(c, b, s, [&](const ConvergedState& m) { lag = m.step.lag; });
                           if (lag < 1e-9)
                             for (const auto& n : p.nodes)
                               c.require(n.force.head<2>().norm() <= (1 + 1e-8) * mu * n.pressure + 1e-12,
                                         b.name + ": no more than mu N");
                           const bool slides = std::all_of(p.nodes.begin(), p.nodes.end(),
                                                           [](const auto& n) { return n.sliding || !n.touching; });
                           c.require(slides || mu >= 1, b.name + ": it slides at " + Case::number(mu));
                           const V friction(p.forces[0][0], p.forces[0][1], 0);
                           const Real normal = std::abs(p.forces[0][2]);
                           if (slides) {
                             c.small(std::abs(friction.norm() / normal - mu), 1e-6 + mu * lag, b.name + ": mu N");
                             c.small((friction / normal - mu * along).norm(), (mu < 1 ? 1e-6 : 1e-4) + mu * lag,
                                     b.name + ": against the way");
                           }
                           if (mu == 0 && !b.augmented)
                             c.small(apart(p.u, completes(c, smooth(), s).u), 1e-9, b.name + ": frictionless field");
                         }
                     });

const HardCase at_once(
    "space: friction", "stick to full slip, and round a corner of the way, in two steps", all_laws,
    "field of 2 x 100 small steps, after 20 steps more", [](Case& c) {
      const auto drag = [](Real t) {
        const Real s = std::min(1.0, late(t)), r = std::clamp(t - 2, 0.0, 1.0);
        return V(1.5 * s, 1.5 * r + std::max(0.0, t - 3), 0);
      };
      for (const TestedModel& b : elastic()) {
        const auto run = [&](Index count) {
          return completes(
              c, b, block(0.2, 0.05, drag, {steps(1, 5), steps(2, count), steps(3, count), steps(4, 20)}, {2, 2, 1}));
        };
        const CaseResult p = run(1), q = run(100);
        c.small(apart(p.u, q.u), 1e-7, b.name + ": field");
        c.small(apart(p.forces[0], q.forces[0]), 1e-7, b.name + ": force");
        c.small((V(q.forces[0] / std::abs(q.forces[0][2])) - V(0, 0.2, -1)).norm(), 1e-6, b.name + ": mu N");
      }
    });

// A cube that stands on the node in the middle of its lower face: its stiffness there is the same in all directions of
// the plate, and none of it couples with the normal one. The plate is moved round a circle, `count` steps a turn.
CaseSetup on_a_tip(Real radius, Index turns, Index count, Real mu, Real mu_across) {
  CaseSetup s{.body = mesh::box({.size = {1, 1, 1}, .cells = {2, 2, 1}})};
  for (Index n = 0; n < s.body.node_count(); ++n)
    if ((s.body.nodes[std::size_t(n)] - V(0.5, 0.5, 0)).norm() < 1e-9) s.body.sides["tip"].nodes = {n};
  s.contacts = {{.side = "tip",
                 .tool = rigid::plane({0, 0, 0}, {0, 0, 1}),
                 .motion =
                     [radius](Real t) {
                       const Real angle = 2 * pi * late(t);
                       return V(radius * std::sin(angle), radius * (1 - std::cos(angle)), 0);
                     },
                 .mu = mu,
                 .normal = 1e4,
                 .tangential = 1e4,
                 .per = PenaltyPer::node,
                 .across = mu_across}};
  drive(s, "front", [](Real t) { return V(0, 0, -1e-5 * std::min(1.0, t)); });
  s.marches = {steps(1, 2), steps(1 + Real(turns), turns * count)};
  return s;
}
// Its stiffness along the plate, with that of sticking.
Real along_plate(Case& c, const TestedModel& b) {
  CaseSetup s = on_a_tip(1e-9, 1, 4, 0.3, 0.3);
  s.marches[1].end = 1.25;
  s.marches[1].steps = 1;
  const CaseResult p = completes(c, b, s);
  return p.forces[0].head<2>().norm() / (std::sqrt(2.0) * 1e-9);
}
// With the phase d = 2 pi / n of a step, its chord c = 2 r sin(d / 2) and the bound b on the stiffness k, theory.md
// (5.4) has the steady slide l = sqrt(c^2 - (b sin d / k)^2) - b (1 - cos d) / k.
const HardCase circle("space: friction", "a plate moved round a circle under a node: five turns", all_laws,
                      "slide, dissipation and direction of every step exactly; turns repeat themselves", [](Case& c) {
                        const Real radius = 3e-5, mu = 0.3;
                        const Index count = 40;
                        for (const TestedModel& b : elastic()) {
                          const Real k = along_plate(c, b), d = 2 * pi / count;
                          Field before;
                          Real friction = 0, normal = 0;
                          (void)completes(c, b, on_a_tip(radius, 5, count, mu, 0), [&](const ConvergedState& m) {
                            const Real dissipated = m.energies.friction - friction;
                            friction = m.energies.friction;
                            normal = std::abs(m.force()[2]);
                            if (m.step.time < 3 - 1e-9) return;
                            const Real bound = mu * normal, chord = 2 * radius * std::sin(0.5 * d);
                            const Real slide = std::sqrt(chord * chord - std::pow(bound * std::sin(d) / k, 2)) -
                                               bound * (1 - std::cos(d)) / k;
                            c.near(dissipated, bound * slide, 2e-5, b.name + ": dissipation");
                            // The force on the plate is against its way, behind by the angle that the spring takes.
                            const Real angle = 2 * pi * late(m.step.time) - 0.5 * d;
                            const V back(-std::cos(angle), -std::sin(angle), 0);
                            const V push = m.force() - V(0, 0, m.force()[2]);
                            c.near(push.norm(), bound, 1e-7, b.name + ": mu N");
                            c.near(push.dot(back), bound * std::cos(std::asin(bound * std::sin(d) / (k * chord))), 2e-5,
                                   b.name + ": direction");
                            if (std::abs(std::remainder(m.step.time, 1.0)) > 1e-9) return;
                            if (before.size() > 0) c.small(apart(m.u, before), 1e-9, b.name + ": turns repeat");
                            before = m.u;
                          });
                          c.require(normal > 0, b.name + ": it presses");
                        }
                      });
const HardCase ellipse(
    "space: friction", "the same on a plate that was ground in one direction, 0.1 along and 0.4 across",
    "AnisotropicCoulomb, EigenLu, Hex8",
    "force on the ellipse, slide along its normal and never against the force; mu across = along: Coulomb",
    [](Case& c) {
      const Real along = 0.1, upright = 0.4, radius = 1e-4;
      V force = V::Zero(), place = V::Zero();
      const CaseSetup s = on_a_tip(radius, 4, 40, along, upright);
      const Index tip = s.body.sides.at("tip").nodes[0];
      Real slid = 0;
      Index sliding = 0;
      (void)completes(c, anisotropic(), s, [&](const ConvergedState& m) {
        const V now = m.force(), at = m.u.segment<3>(3 * tip) - s.contacts[0].motion.at(m.step.time).translation;
        // What the spring of sticking does not take of the way is slid.
        V slide = at - place - (now - force) / 1e4;
        slide[2] = 0;
        force = now, place = at;
        if (m.step.time < 1 + 1e-9) return;
        const Real p = std::abs(now[2]);
        const V normal(now[0] / (along * along), now[1] / (upright * upright), 0);
        const Real size = std::hypot(now[0] / along, now[1] / upright) / p;
        c.require(size < 1 + 1e-8, "within the ellipse");
        c.require(m.step.contact.dissipated >= 0, "dissipation");
        if (!m.contacts[0]->states()[0].sliding) return;
        ++sliding;
        c.near(size, 1, 1e-8, "on the ellipse");
        c.small(std::abs(across(slide, normal)) / (slide.norm() * normal.norm()), 1e-7, "along the normal");
        c.require(slide.dot(now) > 0, "not against the force");
        c.near(m.step.contact.dissipated, slide.dot(now - V(0, 0, now[2])), 1e-7, "dissipation");
        slid += slide.norm();
      });
      c.require(sliding > 100 && slid > 10 * radius, "it slides");
      const CaseResult one = completes(c, anisotropic(), on_a_tip(radius, 1, 40, 0.3, 0.3)),
                       other = completes(c, coulomb(), on_a_tip(radius, 1, 40, 0.3, 0));
      c.small(apart(one.u, other.u), 1e-9, "Coulomb");
    });

const HardCase circle_block(
    "space: friction", "a plate moved round a circle of an element's length under a block: three turns",
    "Coulomb; QuasiCoulomb; Hex8", "dissipation = sum of mu N x the way but for the body's spring (r^2); turns repeat",
    [](Case& c) {
      const Real radius = 1, mu = 0.2;
      const Index count = 128;
      for (const TestedModel* b : {&coulomb(), &quasi()}) {
        CaseSetup s = block(mu, 0.05, [](Real) { return V(0, 0, 0); }, {steps(1, 5), steps(4, 3 * count)}, {3, 3, 1});
        s.contacts[0].motion = [radius](Real t) {
          const Real angle = 2 * pi * late(t);
          return V(radius * std::sin(angle), radius * (1 - std::cos(angle)), 0);
        };
        Field before;
        Real friction = 0, way = 0;
        (void)completes(c, *b, s, [&](const ConvergedState& m) {
          if (m.step.time > 2 + 1e-9) {
            way += mu * std::abs(m.force()[2]) * 2 * radius * std::sin(pi / count);
            const Real angle = 2 * pi * late(m.step.time) - pi / count;
            const V back(-std::cos(angle), -std::sin(angle), 0);
            c.near(m.force().dot(back), mu * std::abs(m.force()[2]), 2e-3, b->name + ": against the way");
          }
          if (m.step.time < 2 - 1e-9 || std::abs(std::remainder(m.step.time, 1.0)) > 1e-9) return;
          if (before.size() > 0) {
            c.small(apart(m.u, before), 1e-8, b->name + ": turns repeat");
            c.near(m.energies.friction - friction, way, 2e-3, b->name + ": mu N x way");
          }
          before = m.u;
          friction = m.energies.friction;
          way = 0;
        });
      }
    });

const HardCase together(
    "space: friction", "a sheared block and its plate turn together by a whole turn", all_laws,
    "forces turn along, nothing slides, and the field at the end is that of the beginning", [](Case& c) {
      const V centre(2, 2, 0);
      for (const TestedModel& b : elastic()) {
        CaseSetup s = block(0.5, 0.05, {}, {steps(1, 4), steps(2, 36)}, {2, 2, 1});
        const auto pose = [centre](Real t) { return turn({0, 0, 1}, 2 * pi * late(t)); };
        s.contacts[0].motion = [=](Real t) {
          const M3 Q = pose(t);
          return turned(Q, centre, Q * V(0.01 * std::min(1.0, t), 0, 0));
        };
        s.driven.clear();
        // Every node of the face has a path of its own.
        for (const Index n : s.body.side("front").nodes) {
          const std::string name = "node " + std::to_string(n);
          s.body.sides[name].nodes = {n};
          const V X = s.body.nodes[std::size_t(n)];
          drive(s, name.c_str(),
                [=](Real t) { return V(pose(t) * (X - centre) + centre - X - V(0, 0, 0.05 * std::min(1.0, t))); });
        }
        V force = V::Zero();
        Field start;
        Real slip = 0;
        const CaseResult p = completes(c, b, s, [&](const ConvergedState& m) {
          if (m.step.time < 1 - 1e-9) return;
          if (start.size() == 0) start = m.u, force = m.force(), slip = m.step.contact.max_slip;
          c.small(apart(m.force(), V(pose(m.step.time) * force)), b.lags ? 1e-6 : 1e-8, b.name + ": force turns along");
          c.small((m.step.contact.max_slip - slip) / 0.01, b.lags ? 1e-6 : 1e-8, b.name + ": sticks");
        });
        c.note(b.name + ": " + std::to_string(p.report.iterations) + " iterations");
        c.require(force.head<2>().norm() > 0.01 * std::abs(force[2]), b.name + ": it is sheared");
        c.small(apart(p.u, start), b.lags ? 1e-6 : 1e-8, b.name + ": field");
      }
    });

// A plate turned on the spot: every node slides on a circle of its own, but for the one on the axis.
const HardCase on_the_spot(
    "space: friction", "a plate that turns on the spot under a block, a node on its axis",
    "Coulomb; QuasiCoulomb; Hex8", "torque = sum of mu p r; the node on the axis feels nothing; turns repeat",
    [](Case& c) {
      const Real mu = 0.3;
      const Index count = 40;
      for (const TestedModel* b : {&coulomb(), &quasi()}) {
        CaseSetup s = block(mu, 0.05, [](Real) { return V(0, 0, 0); }, {steps(1, 5), steps(3, 2 * count)}, {4, 4, 1});
        s.contacts[0].motion = [](Real t) { return turned(turn({0, 0, 1}, 2 * pi * late(t)), {2, 2, 0}); };
        Field before;
        (void)completes(c, *b, s, [&](const ConvergedState& m) {
          if (m.step.time < 2 - 1e-9) return;
          const auto& record = *m.contacts[0];
          Real torque = 0, exact = 0, axis = 1;
          for (std::size_t k = 0; k < record.nodes().size(); ++k) {
            const Index n = record.nodes()[k];
            V x = s.body.nodes[std::size_t(n)] + m.u.segment<3>(3 * n) - V(2, 2, 0);
            x[2] = 0;
            const auto& node = record.states()[k];
            torque -= across(x, node.force);
            exact += mu * node.pressure * x.norm();
            if (x.norm() < 0.01) axis = node.force.head<2>().norm() / node.pressure;
          }
          // Half a step's angle before the tangent.
          c.near(torque, exact * std::cos(pi / count), 2e-3, b->name + ": torque");
          c.small(axis, 1e-6, b->name + ": on the axis");
          if (std::abs(std::remainder(m.step.time, 1.0)) > 1e-9) return;
          if (before.size() > 0) c.small(apart(m.u, before), 1e-6, b->name + ": turns repeat");
          before = m.u;
        });
      }
    });

// tests/physics/wedge.cpp in space: free to bulge to one side.
const HardCase wedge("space: friction", "up a wedge with mu up to four times its slope", all_laws,
                     "exact ratio of the forces, or the lag is named as the cause", [](Case& c) {
                       const Real slope = 0.115, force = 100;
                       for (const TestedModel& b : elastic())
                         for (const Real mu : {0.1, 0.2, 0.5}) {
                           CaseSetup s{.body = mesh::box({.size = {4, 1, 2}, .cells = {3, 1, 1}}), .young = 2e5};
                           s.contacts = {{.side = "back",
                                          .tool = rigid::plane({4, 0, 0}, {-slope, 0, 1}),
                                          .mu = mu,
                                          .normal = 1e5,
                                          .tangential = 1e4,
                                          .per = PenaltyPer::area}};
                           s.driven = {held("bottom", 1), {"front", 2, [](Real t) { return 0.5 * late(t); }}};
                           s.loads = {{"left", 0, [force](Real t) { return force * std::min(1.0, t); }}};
                           s.marches = {
                               {.end = 2, .steps = 40, .tolerance = 1e-9, .outer_tolerance = 1e-8, .max_outer = 60}};
                           V last = V::Zero(), side = V::Zero();
                           const CaseResult p = b.run_case(s, [&](const ConvergedState& m) {
                             last[2] = m.reaction("front", 2), side[1] = m.reaction("bottom", 1);
                           });
                           take(c, p);
                           c.small((last + side + V(force * std::min(1.0, p.time), 0, 0) - p.forces[0]).norm() / force,
                                   1e-6, b.name + ": balance");
                           if (b.lags && mu > slope)
                             c.require(p.outcome().failure.cause == FailureCause::lag_unstable,
                                       b.name + ": " + p.outcome().message());
                           else
                             c.near(-force / last[2], (slope + mu) / (1 - mu * slope), b.lags ? 0.01 : 1e-4,
                                    b.name + ": F / G at " + Case::number(mu));
                         }
                     });

// --- penalties

// A block squeezed without friction between planes of symmetry: Hencky's law under one stress, and the penalty, in
// series.
Real squeezed(Real young, Real area, Real height, Real press, Real penalty) {
  const auto force = [&](Real e) { return -young * e / std::exp(e) * area; };  // e: logarithmic strain
  Real low = -20, high = 0;
  for (int i = 0; i < 200; ++i) {
    const Real e = 0.5 * (low + high);
    (height * (1 - std::exp(e)) + force(e) / (penalty * area) > press ? low : high) = e;
  }
  return force(low);
}
const HardCase penalties(
    "space: penalties", "1e-2 to 1e6 times the body's stiffness", all_laws,
    "force of body and penalty in series, exactly; multipliers: without any penetration", [](Case& c) {
      for (const TestedModel& b : elastic())
        for (Real times = 1e-2; times < 2e6; times *= 10) {
          const Real penalty = times * 1000 / 2;
          CaseSetup s{.body = mesh::box({.size = {4, 3, 2}, .cells = {2, 2, 1}})};
          s.contacts = {{.side = "back",
                         .tool = rigid::plane({0, 0, 0}, {0, 0, 1}),
                         .normal = penalty,
                         .tangential = penalty,
                         .per = PenaltyPer::area}};
          s.driven = {held("left", 0), held("bottom", 1), {"front", 2, [](Real t) { return -0.2 * t; }}};
          s.marches = {steps(1, 4)};
          const CaseResult p = completes(c, b, s, {}, 1e-5);
          c.near(-p.forces[0][2], squeezed(1000, 12, 2, 0.2, b.augmented ? 1e30 : penalty), b.augmented ? 1e-7 : 1e-8,
                 b.name + " at " + Case::number(times));
        }
    });

// A ball pressed into a block's upper face and drawn over it askew.
CaseSetup ironed(Real mu, Real normal, Real tangential, std::vector<MarchOptions> marches,
                 const std::array<Index, 3>& cells = {4, 4, 2}) {
  CaseSetup s{.body = mesh::box({.size = {4, 4, 2}, .cells = cells})};
  s.contacts = {{.side = "front",
                 .tool = rigid::sphere({1.6, 1.5, 5}, 3),
                 .motion =
                     [](Real t) {
                       const Real far = std::max(0.0, t - 0.5);
                       return V(0.8 * far, far, -0.8 * std::min(t, 0.5));
                     },
                 .mu = mu,
                 .normal = 1000 * normal,
                 .tangential = 1000 * tangential,
                 .per = PenaltyPer::area}};
  hold(s, "back");
  s.marches = std::move(marches);
  return s;
}
const HardCase penalties_ball(
    "space: penalties", "a ball drawn over a block, 1 to 1e6 times", "Coulomb; multipliers; Hex8",
    "error of the force falls as 1 / penalty; multipliers independent of theirs", [](Case& c) {
      const auto run = [&](const TestedModel& b, Real times) {
        return completes(
            c, b,
            ironed(0.2, times, 10,
                   {{.end = 1, .steps = 8, .smallest = 1e-4, .tolerance = 1e-9, .outer_tolerance = 1e-7}}, {3, 3, 2}),
            {}, 1e-2);
      };
      const V best = run(augmented(), 10).forces[0];
      Real before = 0;
      for (Real times = 1; times < 2e6; times *= 10) {
        const CaseResult p = run(coulomb(), times);
        const Real error = std::abs(p.forces[0][2] / best[2] - 1);
        if (before > 1e-4) c.require(error < 0.2 * before, "first order at " + Case::number(times));
        c.note(Case::number(times) + ": " + Case::number(error));
        before = error;
      }
      for (const Real times : {1.0, 1e3})
        c.small(apart(run(augmented(), times).forces[0], best), 1e-4, "multipliers from " + Case::number(times));
    });

// --- materials and shapes

// A box shortened or lengthened along z, free to bulge.
CaseSetup pulled(Mesh<3, 8> body, Real poisson, Real stretch, Index count) {
  CaseSetup s{.body = std::move(body), .poisson = poisson};
  Real height = 0;
  for (const V& x : s.body.nodes) height = std::max(height, x[2]);
  s.driven = {held("left", 0), held("bottom", 1), held("back", 2), {"front", 2, [=](Real t) {
                                                                      return height * (std::pow(stretch, t) - 1);
                                                                    }}};
  s.marches = {steps(1, count)};
  return s;
}
void exact_force(Case& c, const CaseSetup& s, Real stretch, Real area, Real tolerance) {
  Real force = 0;
  (void)completes(c, smooth(), s, [&](const ConvergedState& m) { force = m.reaction("front", 2); });
  c.near(force, 1000 * std::log(stretch) / stretch * area, tolerance, "force at " + Case::number(stretch));
}
// Eight cells whose common node lies at (s, s, s); the middle one is 1.
Mesh<3, 8> skewed(Real s) {
  auto body = mesh::box({.size = {2, 2, 2}, .cells = {2, 2, 2}});
  for (V& x : body.nodes)
    if ((x - V(1, 1, 1)).norm() < 1e-9) x = V(s, s, s);
  return body;
}
const HardCase incompressible("space: materials",
                              "nu = 0.4999, 0.49999, 0.4999999: squeezed to a fifth, pulled to thrice", alone,
                              "exact force, whatever nu, on skewed cells", [](Case& c) {
                                for (const Real nu : {0.4999, 0.49999, 0.4999999})
                                  for (const Real stretch : {0.2, 3.0})
                                    exact_force(c, pulled(skewed(0.8), nu, stretch, 10), stretch, 4, 1e-8);
                              });
const HardCase indented("space: materials", "nu = 0.4999 and 0.49999 under a rough ball", "Coulomb; QuasiCoulomb; Hex8",
                        "forces as they are for 0.499, by the difference of nu", [](Case& c) {
                          for (const TestedModel* b : {&coulomb(), &quasi()}) {
                            const auto force = [&](Real nu) {
                              CaseSetup s = ironed(0.3, 100, 10, {steps(0.4, 4)}, {4, 4, 2});
                              s.poisson = nu;
                              const CaseResult p = completes(c, *b, s);
                              c.require(p.report.iterations < 80, b->name + ": " + std::to_string(p.report.iterations));
                              return p.forces[0][2];
                            };
                            const Real low = force(0.499), middle = force(0.4999), high = force(0.49999);
                            c.near((high - middle) / (middle - low), 0.1, 0.2, b->name + ": linear in 1 - 2 nu");
                            c.small(std::abs(high / low - 1), 0.02, b->name + ": no locking");
                          }
                        });
const HardCase skew("space: materials", "cells next to turning inside out; squeezed to a hundredth, and through", alone,
                    "exact force; inverted from the start: input error; beyond: refused at the element", [](Case& c) {
                      for (const Real s : {0.6, 0.55, 1.4, 1.45}) {
                        exact_force(c, pulled(skewed(s), 0.3, 0.7, 5), 0.7, 4, 1e-8);
                        exact_force(c, pulled(skewed(s), 0.3, 1.5, 5), 1.5, 4, 1e-8);
                      }
                      exact_force(c, pulled(skewed(1), 0.3, 0.01, 40), 0.01, 4, 1e-7);
                      c.complains([] { (void)smooth().run_case(pulled(skewed(0), 0.3, 0.9, 1), {}); },
                                  "cell 0 has no positive volume");
                      refused_when_inverted(c, smooth(), pulled(skewed(1), 0.3, 0.9, 1));
                    });
const HardCase shapes(
    "space: scales", "aspect ratios of 100 in every direction, one element", alone, "exact force", [](Case& c) {
      for (const V& size : {V(100, 1, 1), V(1, 100, 1), V(1, 1, 100), V(100, 100, 1), V(1, 100, 100)})
        for (const std::array<Index, 3>& cells : {std::array<Index, 3>{1, 1, 1}, std::array<Index, 3>{2, 3, 1}})
          exact_force(c, pulled(mesh::box({.size = size, .cells = cells}), 0.3, 0.8, 3), 0.8, size[0] * size[1], 1e-8);
    });
const HardCase lone("space: scales", "one element on one contact node", all_laws,
                    "force of the node = of the support = stiffness x depth", [](Case& c) {
                      for (const TestedModel& b : elastic()) {
                        CaseSetup s{.body = mesh::box({})};
                        s.body.sides["foot"].nodes = {s.body.side("back").nodes[0]};
                        s.contacts = {{.side = "foot",
                                       .tool = rigid::plane({0, 0, 0}, {0, 0, 1}),
                                       .mu = 0.3,
                                       .normal = 1e4,
                                       .tangential = 1e4,
                                       .per = PenaltyPer::node}};
                        drive(s, "front", [](Real t) { return V(0, 0, -0.1 * t); });
                        s.marches = {steps(1, 5)};
                        V support = V::Zero();
                        const CaseResult p =
                            completes(c, b, s, [&](const ConvergedState& m) { support = sum(m, "front"); });
                        c.small(apart(support, p.forces[0]), 1e-9, b.name + ": balance");
                        c.require(std::abs(p.forces[0][2]) > 10, b.name + ": it presses");
                        if (!b.augmented) c.near(-p.forces[0][2], -p.nodes[0].gap * 1e4, 1e-9, b.name + ": penalty");
                      }
                    });
const HardCase units(
    "space: scales", "um, m and GPa; offsets of 1e6; turned in space", all_laws, "one answer in all of them",
    [](Case& c) {
      for (const TestedModel& b : elastic()) {
        const auto result = [&](Real l, Real stress, const V& offset, const M3& Q) {
          const auto place = [=](const V& x) { return V(offset + l * (Q * x)); };
          CaseSetup s{.body = mesh::box({.size = {4, 4, 2}, .cells = {2, 2, 1}}), .young = 1000 * stress};
          for (V& x : s.body.nodes) x = place(x);
          s.contacts = {{.side = "back",
                         .tool = rigid::Revolution(rigid::path({0, -9 * l}, {1, 0}).straight(l).left(9 * l, 0.6),
                                                   place({1, 1, 9}), Q * V(0, 0, 1)),
                         .motion = [=](Real t) { return V(l * (Q * V(0.4 * t, -0.2 * t, 0))); },
                         .mu = 0.2,
                         .normal = 1e4 * stress / l,
                         .tangential = 1e3 * stress / l,
                         .per = PenaltyPer::area}};
          drive(s, "front", [=](Real t) { return V(l * (Q * V(0.1 * t, 0, -0.2 * t))); });
          const bool far = offset.norm() > 0;
          s.marches = {steps(1, 6, far ? 1e-7 : 1e-10)};
          if (far) s.marches[0].outer_tolerance = 1e-6;
          CaseResult p = completes(c, b, s, {}, far ? 1e-4 : 1e-6);
          p.forces[0] = Q.transpose() * p.forces[0] / (l * l * stress);
          for (Index n = 0; n < p.u.size() / 3; ++n)
            p.u.segment<3>(3 * n) = (Q.transpose() * p.u.segment<3>(3 * n) / l).eval();
          return p;
        };
        const M3 upright = M3::Identity();
        const CaseResult mm = result(1, 1, V::Zero(), upright);
        c.require(mm.report.max_slip > 0.1, b.name + ": it slides");
        for (const auto& [l, stress] : {std::pair{1e-3, 1e6}, std::pair{1e3, 1e-3}, std::pair{1.0, 1e9}}) {
          const CaseResult other = result(l, stress, V::Zero(), upright);
          c.small(apart(other.u, mm.u), 1e-8, b.name + ": field in other units");
        }
        for (const Real angle : {0.6, 2.2}) {
          const CaseResult other = result(1, 1, V::Zero(), turn({1, -2, 0.5}, angle));
          c.small(apart(other.u, mm.u), 1e-8, b.name + ": field of a turned scene");
          c.small(apart(other.forces[0], mm.forces[0]), 1e-8, b.name + ": force of a turned scene");
        }
        c.small(apart(result(1, 1, {1e6, -1e6, 1e6}, upright).forces[0], mm.forces[0]), 1e-5, b.name + ": far away");
      }
    });

// --- steps

const HardCase large("space: steps", "100 times too large", alone, "1 and 100 steps give one field", [](Case& c) {
  const auto run = [&](Index count) { return completes(c, smooth(), ironed(0, 100, 1, {steps(1, count)}, {4, 4, 2})); };
  c.small(apart(run(1).u, run(100).u), 1e-8, "one step");
});
const HardCase large_and_small(
    "space: steps", "100 times too large, 100 times too small", alone, "1, 100 and 10 000 steps give one field",
    [](Case& c) {
      const auto run = [&](Index count) {
        return completes(c, smooth(), ironed(0, 100, 1, {steps(1, count)}, {3, 3, 1}));
      };
      const CaseResult fine = run(100);
      c.small(apart(run(1).u, fine.u), 1e-8, "one step");
      c.small(apart(run(10000).u, fine.u), 1e-8, "10 000 steps");
    },
    Form::full);
const HardCase cut("space: steps", "fail, cut, go on", all_laws,
                   "field of the same small steps asked for directly (1e-8)", [](Case& c) {
                     for (const TestedModel& b : elastic()) {
                       std::vector<Real> times;
                       MarchOptions coarse = steps(1, 2);
                       coarse.max_iterations = b.augmented ? 6 : 5;  // so that large steps fail
                       coarse.smallest = 1e-4;
                       const CaseResult p = completes(c, b, ironed(0.3, 100, 100, {coarse}, {3, 3, 1}),
                                                      [&](const ConvergedState& m) { times.push_back(m.step.time); });
                       c.require(p.report.rejected_steps > 0, b.name + ": something was cut");
                       MarchOptions direct = steps(1, 1);
                       direct.stops = times;
                       const CaseResult q = completes(c, b, ironed(0.3, 100, 100, {direct}, {3, 3, 1}));
                       c.require(q.report.rejected_steps == 0 && q.report.steps == p.report.steps,
                                 b.name + ": the same steps");
                       c.small(apart(p.u, q.u), 1e-8, b.name + ": field");
                     }
                   });

// The place of the node is followed round the tool (theory.md, section 4.7).
const HardCase spins(
    "space: steps", "a ball and a cylinder that spin under load, 3 degrees to four turns a step", all_laws,
    "friction = mu N, slid distance = way, in 12 steps; half way back within the last: cut", [](Case& c) {
      const M3 axis = turn({0, 0, 1}, 0.4);
      const V along = axis * V(1, 0, 0);
      const std::vector<rigid::Tool<3>> tools{rigid::sphere({0, 0, 0}, 0.5),
                                              rigid::Extruded(rigid::disc({0, 0}, 0.5), {0, 0, 0}, along, {0, 0, 1})};
      for (const TestedModel& b : elastic())
        for (const auto& tool : tools)
          for (const Real degrees : {3.0, 15.0, 60.0, 180.0, 360.0, 1440.0}) {
            const Real angle = degrees * pi / 180, mu = 0.3;
            CaseSetup s = on_a_tip(0, 1, 12, mu, mu);
            s.contacts[0].tool = tool;
            s.contacts[0].motion = [=](Real t) {
              return turned(turn(axis * V(0, 1, 0), 12 * angle * late(t)), {0, 0, 0}, {0.5, 0.5, -0.5});
            };
            const CaseResult p = completes(c, b, s, {}, 1);
            const std::string at = b.name + " at " + Case::number(degrees);
            const V friction(p.forces[0][0], p.forces[0][1], 0);
            c.small(apart(friction, V(mu * p.forces[0][2] * along)), 1e-4, at);
            c.near(p.report.max_slip, 12 * angle * 0.5, 1e-3, at + ": slid distance");
            c.require(p.report.steps == 14, at + ": no step was cut");
            if (degrees < 100) continue;
            s.contacts[0].motion = [=](Real t) {
              const Real turns = 12 * late(t) * angle, most = 11.7 * angle;
              return turned(turn(axis * V(0, 1, 0), most - std::abs(turns - most)), {0, 0, 0}, {0.5, 0.5, -0.5});
            };
            s.marches[1].steps = 0;
            s.marches[1].initial = s.marches[1].largest = 1.0 / 12;
            const CaseResult back = completes(c, b, s, {}, 1);
            c.small(apart(V(back.forces[0][0], back.forces[0][1], 0), V(-friction)), 1e-3, at + ": back");
            c.near(back.report.max_slip, 12 * angle * 0.5, 2e-2, at + ": slid distance and back");
            c.require(back.report.rejected_steps > 0, at + ": back and cut");
          }
    });
const HardCase drills(
    "space: steps", "a plate that turns on the spot by whole turns a step, and in default steps",
    "Coulomb; QuasiCoulomb; Hex8",
    "torque = sum of mu p r, slid distance = way, to 2 %: steps of a twentieth of a turn or less", [](Case& c) {
      const Real mu = 0.3;
      for (const TestedModel* b : {&coulomb(), &quasi()})
        for (const Index count : {0, 2}) {
          CaseSetup s =
              block(mu, 0.05, [](Real) { return V(0, 0, 0); }, {steps(1, 5), {.end = 2, .steps = count}}, {4, 4, 1});
          s.contacts[0].motion = [](Real t) { return turned(turn({0, 0, 1}, 4 * pi * late(t)), {2, 2, 0}); };
          Real torque = 0, exact = 0;
          const CaseResult p = completes(c, *b, s, [&](const ConvergedState& m) {
            torque = exact = 0;
            const auto& record = *m.contacts[0];
            for (std::size_t k = 0; k < record.nodes().size(); ++k) {
              const Index n = record.nodes()[k];
              V x = s.body.nodes[std::size_t(n)] + m.u.segment<3>(3 * n) - V(2, 2, 0);
              x[2] = 0;
              torque -= across(x, record.states()[k].force);
              exact += mu * record.states()[k].pressure * x.norm();
            }
            if (m.step.time > 1.2) c.near(torque, exact, 2e-2 + (b->lags ? m.step.lag : 0), b->name + ": torque");
          });
          c.near(p.report.max_slip, 4 * pi * std::sqrt(8.0), 2e-2, b->name + ": slid distance of a corner");
          c.require(p.report.steps >= 2 * 16 && p.report.steps < 2 * 160,
                    b->name + ": " + std::to_string(p.report.steps) + " steps");
        }
    });
// A ball that only goes on, over a node that stands: the normal turns under it.
const HardCase rolls_over("space: steps", "a ball drawn over a node by up to its radius a step", all_laws,
                          "friction = mu N along the tool, to 2 %", [](Case& c) {
                            for (const TestedModel& b : elastic())
                              for (const Index count : {1, 2, 4, 40}) {
                                const Real mu = 0.3;
                                CaseSetup s = on_a_tip(0, 1, count, mu, mu);
                                s.contacts[0].tool = rigid::sphere({0, 0, 0}, 0.5);
                                s.contacts[0].tangential = 1e5;
                                // From 0.6 rad before its top to 0.6 behind it.
                                s.contacts[0].motion = [](Real t) {
                                  const Real angle = -0.6 + 1.2 * late(t);
                                  return V(0.5 - 0.5 * std::sin(angle), 0.5, -0.5 * std::cos(angle));
                                };
                                const CaseResult p = completes(c, b, s, {}, 1);
                                const Real angle = 0.6;
                                const V n(std::sin(angle), 0, std::cos(angle)), t(std::cos(angle), 0, -std::sin(angle));
                                const Real normal = p.forces[0].dot(n);
                                // The pressure falls as it is dragged, which a lagging bound sees later.
                                if (!b.lags)
                                  c.near(std::abs(p.forces[0].dot(t)), mu * std::abs(normal), 2e-2,
                                         b.name + " in " + std::to_string(count));
                                c.near(p.report.max_slip, 1.2 * 0.5, 3e-2,
                                       b.name + " in " + std::to_string(count) + ": slid");
                              }
                          });
const HardCase first_order(
    "space: steps", "a rough ball drawn askew over a block in 10 to 80 steps", "Coulomb; QuasiCoulomb; Hex8",
    "error of the force against 320 steps falls at least as the step", [](Case& c) {
      for (const TestedModel* b : {&coulomb(), &quasi()}) {
        const auto force = [&](Index count) {
          return completes(c, *b, ironed(0.3, 100, 100, {steps(0.5, 10), steps(1, count)}, {3, 3, 1}), {}, 1).forces[0];
        };
        const V best = force(320);
        Real before = 1;
        for (const Index count : {10, 20, 40, 80}) {
          const Real error = apart(force(count), best);
          c.require(error < 0.7 * before,
                    b->name + ": " + std::to_string(count) + " steps err by " + Case::number(error));
          before = error;
        }
        c.small(before, 5e-3, b->name + ": 80 steps");
      }
    });

// --- tools

// A block on a table whose edge runs askew under it, pressed down and drawn over the edge.
CaseSetup over_edge(const rigid::Profile& table, Real askew, Real mu, Index count, Real far = 1.8) {
  CaseSetup s =
      block(mu, 0.1, [far](Real t) { return V(far * late(t), 0, 0); }, {steps(1, 5), steps(2, count)}, {4, 4, 1});
  const M3 Q = turn({0, 0, 1}, askew);
  s.contacts[0].tool = rigid::Extruded(table, {0, 0, 0}, Q * V(1, 0, 0), {0, 0, 1});
  s.contacts[0].tangential = 1e4;
  return s;
}
rigid::Profile open_end(Real at) {
  return rigid::path({-19, 0}, {1, 0}).straight(19 + at);
}
rigid::Profile sharp(Real at) {
  return rigid::path({-19, 0}, {1, 0}).straight(19 + at).corner(-0.5 * pi).straight(9);
}
rigid::Profile fillet(Real at, Real radius) {
  return rigid::path({-19, 0}, {1, 0}).straight(19 + at).right(radius, 0.5 * pi).straight(9);
}
const HardCase edges("space: tools", "nodes that leave a table askew: sharp corner, fillet of half an element",
                     all_laws, "supports and tool in balance; without friction the field does not know the steps",
                     [](Case& c) {
                       for (const auto& table : {sharp(4.1), fillet(4.1, 0.5)})
                         for (const TestedModel& b : elastic()) {
                           V support = V::Zero();
                           const CaseResult p = completes(
                               c, b, over_edge(table, 0.5, 0.2, 40),
                               [&](const ConvergedState& m) { support = sum(m, "front"); }, 1e-3);
                           c.small(apart(support, p.forces[0]), 1e-6, b.name + ": balance");
                           const auto touching =
                               std::count_if(p.nodes.begin(), p.nodes.end(), [](const auto& n) { return n.touching; });
                           c.require(touching > 0 && touching < 20, b.name + ": some have left");
                         }
                       const CaseResult few = completes(c, smooth(), over_edge(fillet(4.1, 0.5), 0.5, 0, 50), {}, 1),
                                        many = completes(c, smooth(), over_edge(fillet(4.1, 0.5), 0.5, 0, 400), {}, 1);
                       c.small(apart(few.u, many.u), 1e-7, "field");
                     });
// What has no flank: a node that leaves it bulges back under it, and is put on top again.
const HardCase ends("space: tools", "the same at an open end", all_laws,
                    "refused where a node would have to be on it and off it; last state in balance", [](Case& c) {
                      for (const TestedModel& b : elastic()) {
                        CaseSetup s = over_edge(open_end(4.1), 0.5, 0.2, 40);
                        s.marches[1].smallest = 1e-6;
                        V support = V::Zero();
                        const CaseResult p = b.run_case(s, [&](const ConvergedState& m) { support = sum(m, "front"); });
                        take(c, p, 1e-3);
                        c.refused_for(p.outcome().failure.cause,
                                      {FailureCause::not_converged, FailureCause::stalled, FailureCause::tunnelled},
                                      b.name + ": " + p.outcome().message());
                        c.small(apart(support, p.forces[0]), 1e-6, b.name + ": balance");
                      }
                    });
// A layer held along its thickness, and the section: the same models of the plane.
const HardCase layer(
    "space: tools", "a layer of hexahedra drawn over a sharp corner, half an element a step", all_laws,
    "force and field of plane strain", [](Case& c) {
      const Real thickness = 0.7;
      for (const TestedModel& b : elastic()) {
        CaseSetup s{.body = mesh::box({.size = {4, 2, thickness}, .cells = {8, 4, 1}})};
        stability::CaseSetup flat{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}})};
        const auto table = sharp(3.3);
        s.contacts = {{.side = "bottom",
                       .tool = rigid::Extruded(table, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                       .mu = 0.2,
                       .normal = 1e5,
                       .tangential = 1e4,
                       .per = PenaltyPer::area}};
        flat.contacts = {
            {.side = "bottom", .tool = table, .mu = 0.2, .normal = 1e5, .tangential = 1e4, .per = PenaltyPer::area}};
        flat.driven = {{"top", 1, [](Real t) { return -0.1 * std::min(1.0, t); }},
                       {"top", 0, [](Real t) { return 2 * late(t); }}};
        flat.marches = {steps(1, 4), steps(2, 8)};
        s.driven = flat.driven;
        s.driven.push_back(held("back", 2));
        s.driven.push_back(held("front", 2));
        s.marches = flat.marches;
        const CaseResult p = completes(c, b, s, {}, 1e-2);
        const auto& plane = stability::elastic();
        const auto twin =
            std::find_if(plane.begin(), plane.end(), [&](const auto& other) { return other.name == b.name; });
        c.require(twin != plane.end(), b.name + ": is there in the plane");
        if (twin == plane.end()) continue;
        const auto q = twin->run_case(flat, {});
        c.require(bool(q.outcome()), "in the plane: " + q.outcome().message());
        c.small((p.forces[0].head<2>() / thickness - q.forces[0]).norm() / q.forces[0].norm(), 1e-7,
                b.name + ": force");
        c.small(std::abs(p.u.norm() - std::sqrt(2.0) * q.u.norm()) / q.u.norm(), 1e-7, b.name + ": field");
      }
    });
const HardCase centre(
    "space: tools", "a node exactly at the centre of a small ball, on the axis of a thin bar", all_laws,
    "it is pushed out, to the radius", [](Case& c) {
      for (const rigid::Tool<3>& tool : {rigid::Tool<3>(rigid::sphere({2, 2, 0}, 0.05)),
                                         rigid::Tool<3>(rigid::cylinder({2, 2, 0}, {1, 0, 1}, 0.05))})
        for (const TestedModel& b : elastic()) {
          CaseSetup s{.body = mesh::box({.size = {4, 4, 2}, .cells = {2, 2, 1}})};
          s.contacts = {
              {.side = "back", .tool = tool, .mu = 0.2, .normal = 1e6, .tangential = 1e3, .per = PenaltyPer::node}};
          hold(s, "front");
          s.marches = {steps(1, 5)};
          const CaseResult p = completes(c, b, s, {}, 1);
          Index touching = 0;
          for (const auto& n : p.nodes)
            if (n.touching)
              ++touching, c.small(std::abs(n.gap), 1e-3 * 0.05 + (b.augmented ? 0 : 2e-4), b.name + ": surface");
          c.require(touching == 1 && p.u.allFinite() && p.u.norm() > 0.04, b.name + ": one node, moved");
        }
    });
const HardCase touch("space: tools", "a ball that touches at the start, or is 1e-3 or half an element deep",
                     "Frictionless; multipliers; Hex8", "field of an approach from outside", [](Case& c) {
                       for (const TestedModel* b : {&smooth(), &augmented()}) {
                         const auto from = [&](Real start) {
                           CaseSetup s = ironed(0, 100, 1, {steps(1, 5)}, {3, 3, 2});
                           // Over the middle, where nothing tells one direction from another.
                           s.contacts[0].tool = rigid::sphere({2, 2, 5}, 3);
                           s.contacts[0].motion = [start](Real t) { return V(0, 0, -start * (1 - t) - 0.8 * t); };
                           return completes(c, *b, s, {}, 1);
                         };
                         const CaseResult outside = from(-0.3);
                         for (const Real start : {0.0, 1e-3, 0.5})
                           c.small(apart(from(start).u, outside.u), 1e-7, b->name + " from " + Case::number(start));
                       }
                     });

// --- tunnelling

// A block of 4 x 4 x 2 on its base, and a tool above it.
CaseSetup under(const rigid::Tool<3>& tool, const rigid::Motion<3>& motion, std::vector<MarchOptions> marches,
                Real penalty = 1e5, Index cells = 5) {
  CaseSetup s{.body = mesh::box({.size = {4, 4, 2}, .cells = {cells, cells, 2}})};
  s.contacts = {{.side = "front", .tool = tool, .motion = motion, .normal = penalty, .per = PenaltyPer::area}};
  hold(s, "back");
  s.marches = std::move(marches);
  return s;
}
void same(Case& c, const rigid::Tool<3>& tool, const rigid::Motion<3>& motion, Index few, Index many) {
  const CaseResult quick = completes(c, smooth(), under(tool, motion, {steps(1, few)}), {}, 1),
                   slow = completes(c, smooth(), under(tool, motion, {steps(1, many)}), {}, 1);
  c.require(slow.forces[0].norm() > 30, "the tool presses");
  c.small(apart(quick.forces[0], slow.forces[0]), 1e-7, "force of small steps");
  c.small(apart(quick.u, slow.u), 1e-7, "field of small steps");
}
// A plate as thick as an element, endless along its sweep: its other face is soon the nearer one.
rigid::Extruded plate(Real thickness, const V& sweep) {
  const Real half = 0.5 * thickness;
  const V first = V(-sweep[1], sweep[0], 0).normalized();
  return {rigid::path({-6, -half}, {-1, 0}).right(half, pi).straight(12).right(half, pi).straight(12).close(),
          {0, 0, 0},
          first,
          {0, 0, 1}};
}
const HardCase approach("space: tunnelling", "a ball from 100 element lengths away, aslant, in one step", alone,
                        "force and field of 200 small steps", [](Case& c) {
                          same(
                              c, rigid::sphere({22, -18, 86.3}, 4),
                              [](Real t) { return V(-20 * t, 20 * t, -80.8 * t); }, 1, 200);
                        });
const HardCase plates("space: tunnelling", "a plate as thick as an element, from 80 element lengths away", alone,
                      "force and field of 250 small steps, for 1, 2, 3 and 7 steps", [](Case& c) {
                        for (const Index few : {1, 2, 3, 7})
                          same(
                              c, plate(0.8, {1, 0.4, 0}), [](Real t) { return V(2, 2, 62.4 - 60.5 * t); }, few, 250);
                      });
const HardCase paddle("space: tunnelling", "a paddle that turns by a quarter onto the body in one step", alone,
                      "force and field of 100 small steps", [](Case& c) {
                        same(
                            c, plate(0.8, {0, 1, 0}),
                            [](Real t) {
                              return turned(turn({0, 1, 0}, -0.5 * pi * (1 - t)), {-10, 0, 0}, {-4, 0, 2.2});
                            },
                            1, 100);
                      });
const HardCase through("space: tunnelling", "a ball that would fly on 100 element lengths behind the body", alone,
                       "refused while it presses; its force is that of the supports", [](Case& c) {
                         for (const Index count : {1, 5}) {
                           V support = V::Zero();
                           const CaseResult p = smooth().run_case(
                               under(
                                   rigid::sphere({2, 2, 26}, 4), [](Real t) { return V(0, 0, -100 * t); },
                                   {{.end = 1, .steps = count, .tolerance = 1e-9}}, 1e6, 4),
                               [&](const ConvergedState& m) { support = sum(m, "back"); });
                           take(c, p, 1);
                           c.refused_for(p.outcome().failure.cause,
                                         {FailureCause::tunnelled, FailureCause::element_inverted,
                                          FailureCause::stalled, FailureCause::not_converged},
                                         p.outcome().message());
                           c.require(p.time > 0.2 && p.time < 0.23, "it ends while it presses");
                           c.require(p.forces[0][2] > 1e3, "it presses");
                           c.small(apart(support, p.forces[0]), 1e-8, "force of the supports");
                         }
                       });
const HardCase sweep("space: tunnelling", "a roller askew, and a ball, that sweep over the whole body within a step",
                     alone, "it is felt on the way; afterwards the body is at rest", [](Case& c) {
                       for (const rigid::Tool<3>& tool : {rigid::Tool<3>(rigid::cylinder({0, 2, 0}, {0.3, 1, 0}, 1)),
                                                          rigid::Tool<3>(rigid::sphere({0, 2, 0}, 1))}) {
                         Real largest = 0;
                         const CaseResult p = completes(
                             c, smooth(),
                             under(tool, [](Real t) { return V(-48 + 100 * t, 0, 2.8); }, {{.end = 1, .steps = 1}}),
                             [&](const ConvergedState& m) { largest = std::max(largest, m.force().norm()); }, 1e9);
                         c.require(largest > 100, "it is felt: " + Case::number(largest));
                         c.small(p.u.norm(), 1e-8, "at rest");
                       }
                     });

// --- failures

const HardCase unsupported(
    "space: failures", "rigid-body motions that nothing resists: six, and each kind alone", alone,
    "named as such, nothing has happened", [](Case& c) {
      const auto load = [](Real t) { return 10 * t; };
      const auto refused = [&](const std::string& what, CaseSetup s) {
        s.marches = {{.end = 1, .steps = 2, .smallest = 0.1}};
        const CaseResult p = smooth().run_case(s, {});
        take(c, p, 1e9);
        c.refused_for(p.outcome().failure.cause, {FailureCause::unsupported}, what + ": " + p.outcome().message());
        c.require(p.u.isZero(0) && p.time == 0, what + ": nothing has happened");
      };
      CaseSetup s{.body = mesh::box({.size = {2, 1, 1.5}, .cells = {2, 2, 2}})};
      for (Index n = 0; n < s.body.node_count(); ++n) {
        const V& X = s.body.nodes[std::size_t(n)];
        if (X.norm() < 1e-9) s.body.sides["pin"].nodes = {n};
        if ((X - V(0, 0, 1.5)).norm() < 1e-9) s.body.sides["upper pin"].nodes = {n};
        if (X.head<2>().norm() < 1e-9) s.body.sides["hinge"].nodes.push_back(n);
      }
      const auto with = [&](std::vector<SideValue> driven, std::vector<SideValue> loads) {
        CaseSetup t = s;
        t.driven = std::move(driven);
        t.loads = std::move(loads);
        return t;
      };
      const std::vector<SideValue> pinned = {held("pin", 0), held("pin", 1), held("pin", 2)};
      for (const Index i : {0, 1, 2}) {
        refused("all six", with({}, {{"right", i, load}}));
        refused("a side held one way", with({held("left", i)}, {{"right", (i + 1) % 3, load}}));
        refused("pinned", with(pinned, {{"right", i, load}}));
      }
      auto hinged = pinned;
      hinged.push_back(held("upper pin", 0));
      hinged.push_back(held("upper pin", 1));
      refused("hinged", with(hinged, {{"right", 1, load}}));
      // Loads that would be in balance do not hold it either.
      refused("pulled at both ends", with({}, {{"right", 0, load}, {"left", 0, [=](Real t) { return -load(t); }}}));
      // On a smooth floor: aside, and about its normal.
      CaseSetup floor = with({{"front", 2, [](Real t) { return -0.1 * t; }}}, {{"left", 1, load}});
      floor.contacts = {
          {.side = "back", .tool = rigid::plane({0, 0, 0}, {0, 0, 1}), .normal = 1e4, .per = PenaltyPer::area}};
      refused("on a smooth floor", floor);
      floor.loads.push_back({"right", 1, [=](Real t) { return -load(t); }});
      refused("about the floor's normal", floor);
      // A ball in a cup, free to turn: also when it is held at its centre, and about one axis.
      CaseSetup ball{.body = mesh::box({.origin = {-1, -1, -1}, .size = {2, 2, 2}, .cells = {2, 2, 2}})};
      for (Index n = 0; n < ball.body.node_count(); ++n) {
        V& X = ball.body.nodes[std::size_t(n)];
        if (X.norm() > 0.5)
          X = X / X.norm();
        else
          ball.body.sides["centre"].nodes = {n};
      }
      mesh::join(ball.body, "skin", {"left", "right", "bottom", "top", "back", "front"});
      ball.contacts = {
          {.side = "skin", .tool = rigid::cavity({0, 0, 0}, 1 - 1e-13), .normal = 1e4, .per = PenaltyPer::area}};
      ball.loads = {{"left", 1, load}, {"right", 1, [=](Real t) { return -load(t); }}};
      refused("a ball in a cup", ball);
      for (const Index i : {0, 1, 2}) ball.driven.push_back(held("centre", i));
      refused("a ball in a cup, pinned", ball);
      for (Index n = 0; n < ball.body.node_count(); ++n)
        if ((ball.body.nodes[std::size_t(n)] - V(0, 0, 1)).norm() < 1e-9) ball.body.sides["pole"].nodes = {n};
      for (const Index i : {0, 1}) ball.driven.push_back(held("pole", i));
      refused("a ball in a cup, on an axis", ball);
    });
const HardCase supported(
    "space: failures", "the same with one support more", alone, "converges; exact reactions", [](Case& c) {
      CaseSetup s{.body = mesh::box({.size = {2, 1, 1.5}, .cells = {2, 2, 2}})};
      for (Index n = 0; n < s.body.node_count(); ++n) {
        const V& X = s.body.nodes[std::size_t(n)];
        if (X.norm() < 1e-9) s.body.sides["pin"].nodes = {n};
        if ((X - V(0, 0, 1.5)).norm() < 1e-9) s.body.sides["upper"].nodes = {n};
        if ((X - V(2, 0, 0)).norm() < 1e-9) s.body.sides["far"].nodes = {n};
      }
      s.driven = {held("pin", 0), held("pin", 1), held("pin", 2), held("upper", 0), held("upper", 1), held("far", 1)};
      s.loads = {{"right", 1, [](Real t) { return 0.01 * t; }}};
      s.marches = {steps(1, 2)};
      V support = V::Zero();
      (void)completes(c, smooth(), s, [&](const ConvergedState& m) {
        support = sum(m, "pin") + V(m.reaction("upper", 0), m.reaction("upper", 1), 0) + V(0, m.reaction("far", 1), 0);
        // About the axis of the hinge the far corner bears the load alone.
        c.near(m.reaction("far", 1), -0.01 * m.step.time, 1e-3, "lever");
      });
      c.small((support + V(0, 0.01, 0)).norm() / 0.01, 1e-8, "reactions");
    });

// A function of time that makes a rotation with an error in it: a factor too much, two axes of three, a mirror.
const HardCase stretched("space: failures", "tools whose rotation stretches, mirrors, flattens, or is no number",
                         "Coulomb; QuasiCoulomb; Hex8",
                         "input error at the start; on the way named, with the last state", [](Case& c) {
                           M3 mirror = M3::Identity(), flat = mirror, nothing = mirror;
                           mirror(0, 0) = -1;
                           flat(1, 1) = 0;
                           nothing(2, 2) = std::numeric_limits<Real>::quiet_NaN();
                           const M3 wrong[] = {nothing, 1.001 * M3::Identity(), mirror, flat};
                           for (const TestedModel* b : {&coulomb(), &quasi()})
                             for (const M3& Q : wrong) {
                               const auto after = [&](Real begin) {
                                 CaseSetup s = ironed(0.3, 100, 10, {}, {2, 2, 1});
                                 s.contacts[0].motion = [=](Real t) {
                                   return turned(t >= begin ? Q : M3::Identity(), {1.6, 1.5, 5}, {0, 0, -0.4 * t});
                                 };
                                 s.marches = {{.end = 0.5, .steps = 5, .tolerance = 1e-10},
                                              {.end = 1, .steps = 5, .smallest = 0.03, .tolerance = 1e-10}};
                                 return s;
                               };
                               const bool number = !std::isnan(Q(2, 2));
                               c.complains([&] { (void)b->run_case(after(0), {}); },
                                           number ? "stretches or mirrors" : "not finite at the start");
                               const CaseResult p = b->run_case(after(0.501), {});
                               take(c, p);
                               c.refused_for(p.outcome().failure.cause,
                                             {number ? FailureCause::not_rigid : FailureCause::not_finite},
                                             b->name + ": " + p.outcome().message());
                               CaseSetup half = after(2);
                               half.marches.pop_back();
                               c.small(apart(p.u, completes(c, *b, half).u), 0, b->name + ": the last state");
                             }
                         });

// --- motion

// A block slides down a slope that is turned about the vertical: acceleration g (sin a - mu cos a).
void slope(Case& c, const TestedModel& b, Real times, Real about) {
  const Real mu = 0.3, a = std::atan(times * mu), g = 10, mass = 2;  // 2 x 1 x 1, density 1
  const M3 Q = turn({0, 0, 1}, about) * turn({0, 1, 0}, a);          // the block's x goes down the slope
  const V along = Q * V(1, 0, 0), out = Q * V(0, 0, 1);
  CaseSetup s{.body = mesh::box({.size = {2, 1, 1}, .cells = {2, 1, 1}}), .young = 1e4};
  for (V& x : s.body.nodes) x = (Q * x).eval();
  s.contacts = {{.side = "back",
                 .tool = rigid::plane({0, 0, 0}, out),
                 .mu = mu,
                 .normal = 1e4,
                 .tangential = 1e4,
                 .per = PenaltyPer::area}};
  s.loads = {{"back", 2, [=](Real t) {
                const Real on = std::min(1.0, t);
                return -mass * g * on * on * (3 - 2 * on);
              }}};
  s.radius = 0;
  s.marches = {steps(20, 400, 1e-9)};
  V x1 = V::Zero(), x2 = x1, x3 = x1;
  Real t1 = 0, t2 = 0, t3 = 0;
  (void)completes(c, b, s, [&](const ConvergedState& m) {
    V x = V::Zero();
    for (Index n = 0; n < m.u.size() / 3; ++n) x += m.u.segment<3>(3 * n) / Real(m.u.size() / 3);
    const Real t = m.step.time;
    if (t1 == 0 && t >= 4) x1 = x, t1 = t;
    if (t2 == 0 && t >= 12) x2 = x, t2 = t;
    if (t >= 20 - 1e-9) x3 = x, t3 = t;
  });
  const V acceleration = ((x3 - x2) / (t3 - t2) - (x2 - x1) / (t2 - t1)) / (0.5 * (t3 - t1));
  const Real exact = g * (std::sin(a) - mu * std::cos(a));
  if (times > 1)
    c.small(apart(acceleration, V(exact * along)), 5e-3, b.name + ": acceleration at " + Case::number(times));
  else
    c.small((x3 - x2).norm(), 1e-7, b.name + ": sticks");
}
const HardCase slides("space: motion", "a block on a slope turned about the vertical, tan a = mu - 1 %, mu + 1 %, 2 mu",
                      "dynamics: Coulomb; QuasiCoulomb; Hex8",
                      "sticks for ever (1e-7); slides down it with g (sin a - mu cos a) to 0.5 %", [](Case& c) {
                        for (const TestedModel& b : moving())
                          for (const Real times : {0.99, 1.01, 2.0})
                            for (const Real about : {0.0, 0.7}) slope(c, b, times, about);
                      });

// A cube that falls on its corner, and goes aside.
void drops(Case& c, Index count, Real mu) {
  for (const TestedModel& b : moving()) {
    CaseSetup s{.body = mesh::box({.origin = {-0.5, -0.5, -0.5}, .cells = {2, 2, 2}}), .young = 100};
    mesh::join(s.body, "skin", {"left", "right", "bottom", "top", "back", "front"});
    // The diagonal upright.
    const M3 Q = turn({1, -1, 0}, std::acos(1 / std::sqrt(3.0)));
    std::vector<Real> share(std::size_t(s.body.node_count()), 0);
    for (const auto& cell : s.body.cells)
      for (const Index n : cell) share[std::size_t(n)] += 1.0 / 64;
    Real lowest = 0;
    for (V& x : s.body.nodes) x = (Q * x).eval(), lowest = std::min(lowest, x[2]);
    s.contacts = {{.side = "skin",
                   .tool = rigid::plane({0, 0, lowest - 0.01}, {0, 0, 1}),
                   .mu = mu,
                   .normal = 500,
                   .tangential = 500,
                   .per = PenaltyPer::node}};
    // A load on opposite faces is one through the centre.
    for (const char* side : {"left", "right"}) s.loads.push_back({side, 2, [](Real) { return -0.5; }});
    s.velocity = [](const V&) { return V(0.2, 0.1, -0.3); };
    s.marches = {steps(Real(count) * 0.01, count, 1e-9)};
    Real gained = 0, amount = 0, aside = 0;
    Index hits = 0;
    bool touched = false;
    (void)completes(c, b, s, [&](const ConvergedState& m) {
      gained = std::max(gained, -m.energies.algorithmic);
      amount = std::max(amount, m.energies.external);
      hits += !touched && m.step.contact.touching > 0 ? 1 : 0;
      touched = m.step.contact.touching > 0;
      V x = V::Zero();
      for (Index n = 0; n < m.u.size() / 3; ++n) x += share[std::size_t(n)] * m.u.segment<3>(3 * n);
      aside = std::max(aside, (x.head<2>() / m.step.time - Vec<Real, 2>(0.2, 0.1)).norm());
    });
    c.require(hits > 2, b.name + ": it rebounds");
    c.note(b.name + ": " + std::to_string(hits) + " hits");
    c.require(gained < 1e-3 * amount, b.name + ": energy out of nothing, " + Case::number(gained / amount));
    if (mu == 0) c.small(aside, 1e-8, b.name + ": momentum along the floor");
  }
}
const HardCase dropped("space: motion", "a cube dropped on its corner: rebound, tumbling and chatter",
                       "dynamics: Coulomb; QuasiCoulomb; Hex8",
                       "600 steps: energy balance closes, no energy out of nothing; smooth floor: momentum along it",
                       [](Case& c) {
                         drops(c, 600, 0);
                         drops(c, 600, 0.3);
                       });
const HardCase dropped_long(
    "space: motion", "the same, long", "dynamics: Coulomb; QuasiCoulomb; Hex8",
    "20 000 steps: energy balance closes, no energy out of nothing", [](Case& c) { drops(c, 20000, 0.3); }, Form::full);

}  // namespace
}  // namespace stability::space
