// SPDX-License-Identifier: BSL-1.0
// Bodies that friction alone holds, and first contacts at high friction.
#include "run_case.hpp"

namespace {

using namespace stability;

const char* const all_laws = "6 of Coulomb x solvers";

MarchOptions steps(Real end, Index count) {
  return {.end = end, .steps = count, .tolerance = 1e-10, .outer_tolerance = 1e-9, .max_outer = 60};
}

// A block of 4 x 2 on a flat tool, pressed by N and pushed by T: nothing else holds it.
CaseSetup held_block(Real mu, Real N, Real T, Real gap) {
  CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 69004};
  s.contacts = {{.side = "bottom",
                 .tool = rigid::line({0, -gap}, {1, 0}),
                 .mu = mu,
                 .normal = 1e6,
                 .tangential = 1e6,
                 .name = "plane"}};
  s.loads = {{"top", 1, [N](Real t) { return -N * t; }}, {"bottom", 0, [T](Real t) { return T * t; }}};
  s.marches = {steps(1, 10)};
  return s;
}

const HardCase alone("friction", "a block that friction alone holds, T = 0.99 mu N, mu to 10", all_laws,
                     "sticks in ten steps; forces = loads; at mu = 10 a lagging bound bears half of that", [](Case& c) {
                       struct Load {
                         Real mu, N, T, gap;
                       };
                       for (const Load& l : {Load{0.3, 12000, 0.99 * 3600, 0}, Load{0.4, 600, 120, 0},
                                             Load{0.4, 600, 120, -1e-6}, Load{10, 600, 0.99 * 6000, 0}})
                         for (const TestedModel& b : elastic()) {
                           const bool lags = b.name.find("Lag") != b.name.npos || b.lags;
                           const Real T = lags && l.mu > 1 ? 0.5 * l.T : l.T;
                           const CaseResult p = completes(c, b, held_block(l.mu, l.N, T, l.gap));
                           c.require(p.report.steps == 10 && p.report.rejected_steps == 0, b.name + ": without a cut");
                           c.near(p.forces[0][0], T, 1e-8, b.name + ": T");
                           c.near(p.forces[0][1], -l.N, 1e-8, b.name + ": N");
                           c.require(std::any_of(p.nodes.begin(), p.nodes.end(),
                                                 [](const auto& n) { return n.touching && !n.sliding; }),
                                     b.name + ": it sticks");
                         }
                     });

const HardCase lost("friction", "the same, T = 1.01 mu N", all_laws, "refused by the name of the contact that slides",
                    [](Case& c) {
                      for (const TestedModel& b : elastic()) {
                        CaseSetup s = held_block(0.3, 12000, 1.01 * 3600, 0);
                        s.marches[0].smallest = 0.03;
                        const CaseResult p = b.run_case(s, {});
                        c.counts(p.report.steps, p.report.iterations, p.report.rejected_steps);
                        c.refused_for(p.outcome().failure.cause, {FailureCause::slides},
                                      b.name + ": " + p.outcome().message());
                        c.require(p.outcome().message().find("contact \"plane\"") != std::string::npos,
                                  b.name + ": " + p.outcome().message());
                        c.require(p.u.isZero(0), b.name + ": nothing has happened");
                      }
                    });

// A block pressed onto a tool from a gap, its top held along x.
const HardCase high("friction", "first contact at mu = 2.5 to 10: a plane, a blunt and a steep cone, a groove",
                    all_laws, "completes; laws without a lag agree; never more than mu N", [](Case& c) {
                      const auto cone = [](Real fall, Real radius) {
                        return rigid::rounded({{-3, -0.1 - fall}, {2, -0.1}, {7, -0.1 - fall}}, radius);
                      };
                      const auto groove = rigid::path({-3, 2.9}, V(1, -1).normalized())
                                              .straight(std::sqrt(50.0))
                                              .corner(pi / 2)
                                              .straight(std::sqrt(50.0));
                      struct Press {
                        const char* name;
                        rigid::Profile tool;
                        Real depth;
                      };
                      for (const Press& t :
                           {Press{"plane", rigid::line({0, -0.1}, {1, 0}), 0.4}, Press{"cone", cone(1.5, 1), 0.6},
                            Press{"steep cone", cone(5, 0.5), 0.4}, Press{"groove", groove, 0.2}})
                        for (const Real mu : {2.5, 3.0, 4.0, 5.0, 8.0, 10.0}) {
                          CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 1000};
                          s.contacts = {{.side = "bottom", .tool = t.tool, .mu = mu, .normal = 1e5, .tangential = 1e4}};
                          s.driven = {{"top", 1, [&t](Real time) { return -t.depth * time; }}, held("top", 0)};
                          s.marches = {steps(1, 10)};
                          V exact = V::Zero();
                          for (const TestedModel& b : elastic()) {
                            const std::string name = b.name + ", " + t.name + ", " + Case::number(mu) + ": ";
                            const CaseResult p = completes(c, b, s);
                            if (b.augmented || b.lags) continue;
                            for (const auto& n : p.nodes)
                              c.require(!n.touching || n.force.norm() <= (1 + 1e-7) * std::hypot(1, mu) * n.pressure,
                                        name + "no more than mu N");
                            if (exact.isZero(0)) exact = p.forces[0];
                            c.small((p.forces[0] - exact).norm() / exact.norm(), 1e-6, name + "one answer");
                          }
                        }
                    });

}  // namespace
