// SPDX-License-Identifier: BSL-1.0
// Materials, corners, scales, instabilities and motion.
#include "run_case.hpp"

namespace {

using namespace stability;

MarchOptions steps(Real end, Index count, Real tolerance = 1e-10) {
  return {.end = end, .steps = count, .tolerance = tolerance, .outer_tolerance = 1e-9};
}
Real apart(const Field& a, const Field& b) {
  return (a - b).norm() / b.norm();
}
// The root of a falling function.
Real root(Real low, Real high, const std::function<Real(Real)>& f) {
  for (int i = 0; i < 200; ++i) (f(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
  return low;
}

// --- materials

// A block of 4 x 2 shortened or lengthened without friction, in plane strain.
CaseSetup pulled(Real poisson, Real stretch, Index count, std::array<Index, 2> cells = {4, 2}, V size = {4, 2}) {
  CaseSetup s{.body = mesh::rectangle({.size = size, .cells = cells}), .young = 1000, .poisson = poisson};
  s.driven = {held("left", 0), held("bottom", 1), {"top", 1, [stretch, size](Real t) {
                                                     return size[1] * (std::exp(t * std::log(stretch)) - 1);
                                                   }}};
  s.marches = {steps(1, count)};
  return s;
}
const HardCase incompressible("materials", "nu = 0.4999, 0.49999, 0.4999999: squeezed to a fifth, pulled to thrice",
                              "Frictionless, EigenLdlt", "exact force, whatever nu", [](Case& c) {
                                for (const Real nu : {0.4999, 0.49999, 0.4999999})
                                  for (const Real stretch : {0.2, 3.0}) {
                                    Real force = 0;
                                    const CaseResult p =
                                        completes(c, smooth(), pulled(nu, stretch, 10),
                                                  [&](const ConvergedState& m) { force = m.reaction("top", 1); });
                                    c.near(force, 1000 / (1 - nu * nu) * std::log(stretch) / stretch * 4, 1e-8,
                                           "force");
                                  }
                              });
const HardCase indented(
    "materials", "nu = 0.4999 and 0.49999 under a rough disc", "6 of Coulomb x solvers",
    "forces as they are for 0.499, by the difference of nu", [](Case& c) {
      for (const TestedModel& b : elastic()) {
        const auto force = [&](Real nu) {
          CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {12, 6}}), .young = 1000, .poisson = nu};
          s.contacts = {{.side = "top",
                         .tool = rigid::disc({2, 5}, 3),
                         .motion = [](Real t) { return V(0, -0.3 * t); },
                         .mu = 0.3,
                         .normal = 1e5,
                         .tangential = 1e4}};
          s.driven = {held("bottom", 0), held("bottom", 1)};
          s.marches = {steps(1, 10)};
          const CaseResult p = completes(c, b, s);
          c.require(p.report.iterations < 200, b.name + ": in " + std::to_string(p.report.iterations) + " iterations");
          return p.forces[0][1];
        };
        const Real low = force(0.499), middle = force(0.4999), high = force(0.49999);
        // The force is smooth in the compressibility, 1 - 2 nu: it falls by ten.
        c.near((high - middle) / (middle - low), 0.1, 0.2, b.name + ": linear in 1 - 2 nu");
        c.small(std::abs(high / low - 1), 0.02, b.name + ": no locking");
      }
    });
const HardCase inversion("materials", "squeezed to a hundredth, and through", "Frictionless, EigenLdlt",
                         "exact force at 0.01; beyond: refused at the element", [](Case& c) {
                           Real force = 0;
                           (void)completes(c, smooth(), pulled(0.3, 0.01, 40),
                                           [&](const ConvergedState& m) { force = m.reaction("top", 1); });
                           c.near(force, 1000 / 0.91 * std::log(0.01) / 0.01 * 4, 1e-7, "force");
                           refused_when_inverted(c, smooth(), pulled(0.3, 0.5, 1));
                         });

// Plane strain without hardening: the stress is 2 / sqrt(3) of the flow stress once elastic strains have settled.
const HardCase perfect("materials", "zero hardening", "J2, QuasiCoulomb, EigenLdlt", "limit load 2 / sqrt(3) sigma",
                       [](Case& c) {
                         for (const Real stretch : {0.5, 1.5}) {
                           CaseSetup s = pulled(0.3, stretch, 40);
                           s.yield = 3;
                           Real force = 0;
                           (void)completes(c, metal(), s,
                                           [&](const ConvergedState& m) { force = m.reaction("top", 1); });
                           c.near(std::abs(force), 2 / std::sqrt(3.0) * 3 / stretch * 4, 1e-6, "limit load");
                         }
                       });

// A bar of the sheet's metal along the axis: Kirchhoff's stress is the flow stress.
CaseSetup bar(Real strain, Index count) {
  CaseSetup s{.body = mesh::rectangle({.size = {1, 2}, .cells = {2, 2}}), .young = 69004, .poisson = 0.3};
  s.yield = 589;
  s.exponent = 0.216;
  s.driven = {
      held("left", 0), held("bottom", 1), {"top", 1, [strain](Real t) { return 2 * (std::exp(strain * t) - 1); }}};
  s.marches = {steps(1, count)};
  return s;
}
Real bar_force(Real strain) {
  const Real e = std::abs(strain);
  const Real p =
      root(0, e, [&](Real plastic) { return 69004 * (e - plastic) - 589 * std::pow(1e-4 + plastic, 0.216); });
  const Real flow = 69004 * (e - p);
  return pi * std::exp(-strain) * (strain > 0 ? flow : -flow);
}
const HardCase vertical("materials", "the power law's vertical start, and plastic strains above 3",
                        "axisymmetric J2, Coulomb; QuasiCoulomb",
                        "exact force from strains of 2e-3 to 3.5, in few and many steps", [](Case& c) {
                          for (const TestedModel& b : sheets())
                            for (const Real strain : {2e-3, -2e-3, 3e-2, 0.5, -0.5, 3.5, -3.2})
                              for (const Index count : {8, 80}) {
                                Real force = 0;
                                const CaseResult p = completes(
                                    c, b, bar(strain, count),
                                    [&](const ConvergedState& m) { force = m.reaction("top", 1); }, 1e-5);
                                c.near(force, bar_force(strain), 1e-6, "force at " + Case::number(strain));
                                if (std::abs(strain) > 3) c.require(p.plastic > 3, "plastic strain");
                              }
                        });

// The OSU punch (examples/osu_punch.cpp), refined.
CaseResult punch(Case& c, const TestedModel& b, Index refine, Real mu, Real& at_30) {
  CaseSetup s{.body = mesh::rectangle({.size = {59.18, 1}, .cells = {14 * refine, 2 * refine}}),
              .young = 69004,
              .poisson = 0.3};
  s.yield = 589;
  s.exponent = 0.216;
  s.contacts = {{.side = "top",
                 .tool = rigid::path({50.8, 51.8}, {0, -1}).right(50.8, pi),
                 .motion = [](Real t) { return V(0, -t); },
                 .mu = mu,
                 .name = "punch"},
                {.side = "bottom",
                 .tool = rigid::path({52.83, -100}, {0, 1}).straight(93.65).right(6.35, pi / 2).straight(40),
                 .mu = mu,
                 .name = "die"}};
  s.driven = {held("left", 0), held("right", 0), held("right", 1)};
  s.marches = {{.end = 40, .initial = 0.1, .largest = 0.8, .tolerance = 1e-7, .stops = {30}}};
  Real rim = 0;
  CaseResult p = completes(
      c, b, s,
      [&](const ConvergedState& m) {
        rim = m.reaction("right", 1);
        if (m.step.time == 30) at_30 = m.force()[1];
      },
      1e-3);
  c.near(p.forces[0][1] + p.forces[1][1], rim, 1e-5, b.name + ": the tools' forces are the rim's");
  return p;
}
void necking(Case& c, Index refine) {
  Real exact = 0, lagged = 0;
  for (const TestedModel& b : sheets()) {
    const CaseResult p = punch(c, b, refine, 0.3, b.lags ? lagged : exact);
    c.note(std::to_string(p.report.iterations) + " iterations, " + std::to_string(int(p.forces[0][1] / 1e3)) +
           " kN, plastic strain " + Case::number(p.plastic));
  }
  // Behind the neck, past some 32 mm, a step more or less of friction decides where it goes on.
  c.near(lagged, exact, 0.01, "the laws' forces at 30 mm");
}
const HardCase osu("materials", "the OSU punch at mu = 0.30, 14 x 2", "axisymmetric J2, Coulomb; QuasiCoulomb",
                   "40 mm; forces balance, energy balance closes, laws agree at 30 mm", [](Case& c) { necking(c, 1); });
const HardCase osu_fine(
    "materials", "the OSU punch at mu = 0.30, 56 x 8: it necks", "axisymmetric J2, Coulomb; QuasiCoulomb",
    "40 mm; forces balance, energy balance closes, laws agree at 30 mm", [](Case& c) { necking(c, 4); }, Form::full);
const HardCase osu_far(
    "tunnelling", "the OSU punch in steps of 250 mm", "axisymmetric J2, Coulomb; QuasiCoulomb",
    "at the end the punch is still in the sheet, its force that of die and rim", [](Case& c) {
      for (const TestedModel& b : sheets()) {
        CaseSetup s{.body = mesh::rectangle({.size = {59.18, 1}, .cells = {14, 2}}), .young = 69004, .poisson = 0.3};
        s.yield = 589;
        s.exponent = 0.216;
        s.contacts = {{.side = "top",
                       .tool = rigid::path({50.8, 51.8}, {0, -1}).right(50.8, pi),
                       .motion = [](Real t) { return V(0, -500 * t); },
                       .mu = 0.15,
                       .name = "punch"}};
        s.driven = {held("left", 0), held("right", 0), held("right", 1)};
        s.marches = {{.end = 1, .steps = 2, .smallest = 1e-4}};
        Real rim = 0;
        const CaseResult p = b.run_case(s, [&](const ConvergedState& m) { rim = m.reaction("right", 1); });
        take(c, p, 1e-1);
        c.require(p.forces[0][1] > 1e3, b.name + ": it presses");
        c.near(p.forces[0][1], rim, 1e-4, b.name + ": the rim's force");
        c.note(p.outcome().message());
      }
    });

// --- tools

// A block on a table, pressed down and drawn over the table's edge.
CaseSetup over_edge(const rigid::Profile& table, Real mu, Index count, Real far = 2.2) {
  CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 1000};
  s.contacts = {{.side = "bottom", .tool = table, .mu = mu, .normal = 1e5, .tangential = 1e4}};
  s.driven = {{"top", 1, [](Real t) { return -0.1 * std::min(1.0, t); }},
              {"top", 0, [far](Real t) { return far * std::max(0.0, t - 1); }}};
  s.marches = {steps(1, 5), steps(2, count)};
  return s;
}
const HardCase edges(
    "tools", "nodes that leave a table: open end, sharp corner, fillet of half an element", "6 of Coulomb x solvers",
    "support and tool in balance; without friction the field does not know the steps", [](Case& c) {
      const rigid::Profile tables[] = {rigid::path({-9, 0}, {1, 0}).straight(12.3),
                                       rigid::path({-9, 0}, {1, 0}).straight(12.05).right(0.25, 0.5 * pi).straight(5),
                                       rigid::path({-9, 0}, {1, 0}).straight(12.3).corner(-0.5 * pi).straight(5)};
      for (const auto& table : tables)
        for (const TestedModel& b : elastic()) {
          Real top = 0, side = 0;
          const CaseResult p = completes(
              c, b, over_edge(table, 0.2, 40),
              [&](const ConvergedState& m) { top = m.reaction("top", 1), side = m.reaction("top", 0); }, 1e-3);
          c.near(top, p.forces[0][1], 1e-6, b.name + ": balance");
          c.near(side, p.forces[0][0], 1e-6, b.name + ": balance along");
          Index touching = 0;
          for (const auto& n : p.nodes) touching += n.touching ? 1 : 0;
          c.require(touching > 0 && touching < 6, b.name + ": some have left");
        }
      const CaseResult few = completes(c, smooth(), over_edge(tables[1], 0, 50), {}, 1),
                       many = completes(c, smooth(), over_edge(tables[1], 0, 400), {}, 1);
      c.small(apart(few.u, many.u), 1e-7, "field");
    });
const HardCase small_fillet(
    "tools", "nodes pulled over a fillet of a fifth of an element", "6 of Coulomb x solvers",
    "refused where a node snaps off, or past it; last state in balance", [](Case& c) {
      for (const TestedModel& b : elastic()) {
        CaseSetup s = over_edge(rigid::path({-9, 0}, {1, 0}).straight(12.2).right(0.1, 0.5 * pi).straight(5), 0.2, 40);
        s.marches[1].smallest = 1e-6;
        Real top = 0;
        const CaseResult p = b.run_case(s, [&](const ConvergedState& m) { top = m.reaction("top", 1); });
        take(c, p, 1e-3);
        if (!p.outcome() || b.name[0] != 'S')  // whose iteration finds the balance beyond
          c.refused_for(p.outcome().failure.cause,
                        {FailureCause::not_converged, FailureCause::stalled, FailureCause::tunnelled},
                        b.name + ": " + p.outcome().message());
        c.near(top, p.forces[0][1], 1e-6, b.name + ": balance");
      }
    });
const HardCase joints("tools", "a table of 100 pieces whose joints lie under the nodes", "6 of Coulomb x solvers",
                      "field of a table of one piece", [](Case& c) {
                        auto pieces = rigid::path({-10, 0}, {1, 0});
                        for (int i = 0; i < 200; ++i) pieces.straight(0.125);
                        for (const TestedModel& b : elastic()) {
                          const CaseResult many = completes(c, b, over_edge(pieces, 0.2, 20, 1.0)),
                                           one = completes(c, b, over_edge(rigid::line({0, 0}, {1, 0}), 0.2, 20, 1.0));
                          c.small(apart(many.u, one.u), 1e-9, b.name + ": field");
                        }
                      });
const HardCase centre(
    "tools", "a node exactly at the centre of a small disc", "6 of Coulomb x solvers",
    "it is pushed out, to the radius", [](Case& c) {
      for (const TestedModel& b : elastic()) {
        CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 1000};
        s.contacts = {
            {.side = "bottom", .tool = rigid::disc({2, 0}, 0.05), .mu = 0.2, .normal = 1e6, .tangential = 1e3}};
        s.driven = {held("top", 0), held("top", 1)};
        s.marches = {steps(1, 5)};
        const CaseResult p = completes(c, b, s, {}, 1);
        Index touching = 0;
        for (const auto& n : p.nodes)
          if (n.touching)
            ++touching, c.small(std::abs(n.gap), 1e-3 * 0.05 + (b.augmented ? 0 : 2e-4), b.name + ": on its surface");
        c.require(touching == 1 && p.u.allFinite() && p.u.norm() > 0.04, b.name + ": one node, moved");
      }
    });
const HardCase touch(
    "tools", "first contact with no gap, and with one 1e-3 of an element deep", "Frictionless, EigenLdlt; multipliers",
    "field of an approach from outside", [](Case& c) {
      for (const TestedModel* b : {&smooth(), &augmented()}) {
        const auto from = [&](Real gap) {
          CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}), .young = 1000};
          s.contacts = {{.side = "bottom", .tool = rigid::line({0, -gap}, {1, 0}), .normal = 1e5, .tangential = 1e4}};
          s.driven = {{"left", 0, nullptr}, {"top", 1, [gap](Real t) { return -gap - 0.1 * t; }}};
          s.marches = {steps(1, 4)};
          return completes(c, *b, s, {}, 1);
        };
        const CaseResult outside = from(0.3), none = from(0), inside = from(-5e-4);
        c.near(none.forces[0][1], outside.forces[0][1], 1e-8, b->name + ": no gap");
        c.near(inside.forces[0][1], outside.forces[0][1], 1e-8, b->name + ": inside");
      }
    });

// --- scales

const HardCase units(
    "scales", "mm, m and um; Pa to GPa; offsets of 1e6", "6 of Coulomb x solvers", "one answer in all units",
    [](Case& c) {
      for (const TestedModel& b : elastic()) {
        const auto result = [&](Real l, Real stress, Real offset) {
          const V shift(offset, -offset);
          CaseSetup s{.body = mesh::rectangle({.origin = shift, .size = V(4 * l, 2 * l), .cells = {8, 4}}),
                      .young = 1000 * stress};
          s.contacts = {{.side = "bottom",
                         .tool = rigid::disc(shift + V(1 * l, -6 * l), 6 * l),
                         .motion = [l](Real t) { return V(0.4 * l * t, 0); },
                         .mu = 0.2,
                         .normal = 1e4 * stress,
                         .tangential = 1e3 * stress}};
          s.driven = {held("top", 0), {"top", 1, [l](Real t) { return -0.2 * l * t; }}};
          s.marches = {steps(1, 10, offset != 0 ? 1e-7 : 1e-10)};
          if (offset != 0) s.marches[0].outer_tolerance = 1e-6;
          CaseResult p = completes(c, b, s, {}, offset != 0 ? 1e-4 : 1e-6);
          p.forces[0] /= l * stress;
          p.u /= l;
          return p;
        };
        const CaseResult mm = result(1, 1, 0);
        for (const auto& [l, stress] : {std::pair{1e-3, 1e6}, std::pair{1e3, 1e-3}, std::pair{1.0, 1e9}}) {
          const CaseResult other = result(l, stress, 0);
          c.small(apart(other.u, mm.u), 1e-8, b.name + ": field in other units");
          c.require(other.report.iterations == mm.report.iterations, b.name + ": the same work");
        }
        const CaseResult far = result(1, 1, 1e6);
        c.small((far.forces[0] - mm.forces[0]).norm() / mm.forces[0].norm(), 1e-5, b.name + ": far away");
      }
    });
const HardCase shapes(
    "scales", "aspect ratios of 100 and 0.01, one element", "Frictionless, EigenLdlt", "exact force", [](Case& c) {
      for (const V& size : {V(100, 1), V(1, 100), V(4, 2)})
        for (const std::array<Index, 2>& cells : {std::array<Index, 2>{1, 1}, std::array<Index, 2>{3, 5}}) {
          Real force = 0;
          (void)completes(c, smooth(), pulled(0.3, 0.8, 4, cells, size),
                          [&](const ConvergedState& m) { force = m.reaction("top", 1); });
          c.near(force, 1000 / 0.91 * std::log(0.8) / 0.8 * size[0], 1e-8, "force");
        }
    });
const HardCase lone(
    "scales", "one element on one contact node", "6 of Coulomb x solvers",
    "force of the node = of the support = stiffness x depth", [](Case& c) {
      for (const TestedModel& b : elastic()) {
        CaseSetup s{.body = mesh::rectangle({}), .young = 1000};
        s.body.sides["foot"].nodes = {s.body.side("bottom").nodes[0]};
        s.contacts = {
            {.side = "foot", .tool = rigid::line({0, 0}, {1, 0}), .mu = 0.3, .normal = 1e4, .tangential = 1e4}};
        s.driven = {held("top", 0), {"top", 1, [](Real t) { return -0.1 * t; }}};
        s.marches = {steps(1, 5)};
        Real top = 0;
        const CaseResult p = completes(c, b, s, [&](const ConvergedState& m) { top = m.reaction("top", 1); });
        c.near(top, p.forces[0][1], 1e-9, b.name + ": balance");
        c.require(std::abs(p.forces[0][1]) > 10, b.name + ": it presses");
        if (!b.augmented) c.near(std::abs(p.forces[0][1]), -p.nodes[0].gap * 1e4, 1e-9, b.name + ": penalty");
      }
    });

// --- instabilities

// A column of 1 x 20 between guided ends, clamped; `aside` is a force at its middle.
CaseSetup column(const std::function<Real(Real)>& press, const std::function<Real(Real)>& aside) {
  CaseSetup s{.body = mesh::rectangle({.size = {1, 20}, .cells = {4, 80}}), .young = 1000, .poisson = 0};
  s.body.sides["middle"].nodes = {s.body.side("right").nodes[40]};
  s.body.sides["middle"].facets = {s.body.side("right").facets[39], s.body.side("right").facets[40]};
  s.driven = {held("bottom", 0), held("bottom", 1), held("top", 0), {"top", 1, press}};
  s.loads = {{"middle", 0, aside}};
  return s;
}
const HardCase buckling(
    "instabilities", "a column buckles onto a wall", "Frictionless; 6 of Coulomb x solvers",
    "Euler's load by the column's own bending stiffness; at the wall: energy balance closes, laws agree at mu = 0", [](Case& c) {
      // F = 192 EI w / L^3 gives EI, P = 4 pi^2 EI / L^2.
      CaseSetup bent = column([](Real) { return 0.0; }, [](Real t) { return 0.01 * t; });
      bent.marches = {steps(1, 1)};
      const CaseResult q = completes(c, smooth(), bent);
      const Real w = q.u[2 * bent.body.side("middle").nodes[0]];
      const Real euler = 4 * pi * pi * 20 * 0.01 / (192 * w);
      const auto run_case = [&](const TestedModel& b, Real mu, Real press, Real& before_wall, Real& at_wall) {
        CaseSetup s = column([press](Real t) { return -press * t; }, [](Real) { return 1e-2; });
        s.contacts = {
            {.side = "right", .tool = rigid::line({3, 0}, {0, 1}), .mu = mu, .normal = 1e4, .tangential = 1e3}};
        s.marches = {{.end = 1, .initial = 0.005, .largest = 0.02, .tolerance = 1e-9, .outer_tolerance = 1e-8}};
        CaseResult p = completes(c, b, s, [&](const ConvergedState& m) {
          if (m.step.contact.touching == 0) before_wall = std::abs(m.reaction("top", 1));
          at_wall = std::abs(m.force()[0]);
        });
        return p;
      };
      Real load = 0, wall = 0;
      const CaseResult p = run_case(smooth(), 0, 2, load, wall);
      // Behind the branch point the load goes on rising by the square of the slope, 0.2 at the wall, and shear lowers
      // it.
      c.near(load, euler, 0.06, "Euler's load");
      c.require(wall > 1, "it leans on the wall");
      c.note("indefinite factorisations: " + std::to_string(p.report.work.indefinite_factorizations));
      for (const TestedModel& b : elastic()) {
        Real other = 0, at_wall = 0;
        const CaseResult r = run_case(b, b.augmented ? 0 : 0.3, 1.1, other, at_wall);
        c.near(other, load, 0.02, b.name + ": buckling load");
        c.require(at_wall > 1, b.name + ": it leans on the wall");
      }
    });

const HardCase rough_wall(
    "instabilities", "the same pressed twice as far along a rough wall", "Coulomb; QuasiCoulomb",
    "refused where the column snaps along it; last state in balance", [](Case& c) {
      for (const TestedModel* b : {&coulomb(), &quasi()}) {
        CaseSetup s = column([](Real t) { return -2 * t; }, [](Real) { return 1e-2; });
        s.contacts = {
            {.side = "right", .tool = rigid::line({3, 0}, {0, 1}), .mu = 0.3, .normal = 1e4, .tangential = 1e3}};
        s.marches = {{.end = 1, .initial = 0.005, .largest = 0.02, .smallest = 1e-6, .tolerance = 1e-9}};
        Real across = 0, load = 0;
        const CaseResult p = b->run_case(s, [&](const ConvergedState& m) {
          across = m.reaction("top", 0) + m.reaction("bottom", 0);
          load = 1e-2;
        });
        take(c, p);
        c.refused_for(p.outcome().failure.cause, {FailureCause::not_converged, FailureCause::stalled},
                      b->name + ": " + p.outcome().message());
        c.require(p.time > 0.5, b->name + ": past the wall");
        c.near(across + load, p.forces[0][0], 1e-5, b->name + ": balance across");
      }
    });

// A shallow arch, clamped at its feet, pushed down at its crown by a disc.
const HardCase snap(
    "instabilities", "a shallow arch snaps through under a disc", "Frictionless; 6 of Coulomb x solvers",
    "force rises and falls; without friction all work is stored energy; energy balance closes", [](Case& c) {
      const auto arch = [](Real mu) {
        CaseSetup s{.body = mesh::rectangle({.size = {20, 0.25}, .cells = {80, 2}}), .young = 1e4, .poisson = 0};
        for (auto& x : s.body.nodes) x[1] += 1.5 * std::sin(pi * x[0] / 20);
        s.contacts = {{.side = "top",
                       .tool = rigid::disc({10, 2.76}, 1),
                       .motion = [](Real t) { return V(0, -2.6 * t); },
                       .mu = mu,
                       .normal = 1e4,
                       .tangential = 1e3}};
        s.driven = {held("left", 0), held("left", 1), held("right", 0), held("right", 1)};
        s.marches = {{.end = 1, .initial = 0.01, .largest = 0.02, .tolerance = 1e-9, .outer_tolerance = 1e-8}};
        return s;
      };
      std::vector<const TestedModel*> all{&smooth()};
      for (const TestedModel& b : elastic()) all.push_back(&b);
      for (const TestedModel* b : all) {
        Real peak = 0, fall = 0, external = 0, stored = 0;
        const bool rough = b != &smooth();
        (void)completes(c, *b, arch(rough ? 0.3 : 0), [&](const ConvergedState& m) {
          const Real now = m.force()[1];
          peak = std::max(peak, now);
          fall = std::max(fall, 1 - now / peak);
          external = m.energies.external;
          stored = m.energies.elastic + m.energies.penalty;
        });
        c.require(peak > 0.1 && fall > 0.3, b->name + ": it falls by " + Case::number(fall));
        if (!rough) c.near(stored, external, 2e-3, "stored energy");
      }
    });

// The tube of examples/shock_absorber.cpp.
const HardCase folding(
    "instabilities", "the folding tube at mu = 0.30", "axisymmetric J2 dynamics, QuasiCoulomb, EigenLdlt",
    "30 mm; energy balance closes; work = plastic, friction, elastic and kinetic",
    [](Case& c) {
      CaseSetup s{.body = mesh::rectangle({.origin = {23.77, 0}, .size = {1.63, 63.5}, .cells = {3, 100}}),
                  .young = 67000,
                  .poisson = 0.33};
      mesh::join(s.body, "surface", {"left", "bottom", "right"});
      s.yield = 15;
      s.hardening = 44.7;
      s.density = 2.7e-9;
      s.radius = 0;
      auto die = rigid::path({23.77, 80}, {0, -1});
      die.straight(80).left(3.97, 0.5 * pi).straight(80);
      s.contacts = {{.side = "surface", .tool = die, .mu = 0.3, .normal = 1e7, .tangential = 1e6, .name = "die"}};
      s.driven = {{"top", 1, [](Real t) { return -40e3 * t; }}};
      s.velocity = [](const V&) { return V(0, -40e3); };
      s.marches = {
          {.end = 30 / 40e3, .initial = 0.02 / 40e3, .largest = 0.5 / 40e3, .target_iterations = 6, .tolerance = 1e-4}};
      const CaseResult p = completes(c, tube(), s, {}, 1e-3);
      c.note("indefinite factorisations: " + std::to_string(p.report.work.indefinite_factorizations) +
             ", plastic strain " + Case::number(p.plastic));
    },
    Form::full);

// --- motion

// A block slides down a slope under its weight: acceleration g (sin a - mu cos a).
void slope(Case& c, const TestedModel& b, Real times) {
  const Real mu = 0.3, a = std::atan(times * mu), g = 10, mass = 2;  // 2 x 1, density 1
  const V along(std::cos(a), -std::sin(a)), out(std::sin(a), std::cos(a));
  CaseSetup s{.body = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}), .young = 1e4};
  for (V& x : s.body.nodes) x = x[0] * along + x[1] * out;
  s.contacts = {{.side = "bottom", .tool = rigid::line({0, 0}, along), .mu = mu, .normal = 1e4, .tangential = 1e4}};
  s.loads = {{"bottom", 1,
              [=](Real t) { return -mass * g * std::min(1.0, t) * std::min(1.0, t) * (3 - 2 * std::min(1.0, t)); }}};
  s.radius = 0;
  s.marches = {steps(20, 400, 1e-9)};
  Real x1 = 0, x2 = 0, x3 = 0, t2 = 0, t3 = 0, t1 = 0;
  (void)completes(c, b, s, [&](const ConvergedState& m) {
    Real x = 0;
    for (Index n = 0; n < m.u.size() / 2; ++n) x += m.u.segment<2>(2 * n).dot(along) / Real(m.u.size() / 2);
    const Real t = m.step.time;
    if (t1 == 0 && t >= 4) x1 = x, t1 = t;
    if (t2 == 0 && t >= 12) x2 = x, t2 = t;
    if (t >= 20 - 1e-9) x3 = x, t3 = t;
  });
  const Real acceleration = ((x3 - x2) / (t3 - t2) - (x2 - x1) / (t2 - t1)) / (0.5 * (t3 - t1));
  const Real exact = g * (std::sin(a) - mu * std::cos(a));
  if (times > 1) {
    c.near(acceleration, exact, 5e-3, b.name + ": acceleration at " + Case::number(times));
  } else {
    // A lagging bound lets the block go a little while its weight comes on.
    c.small(std::abs(x3 - x2), 1e-7, b.name + ": sticks");
  }
}
const HardCase slides("motion", "a block on a slope, tan a = mu - 1 %, mu + 1 %, 2 mu",
                      "dynamics: Coulomb; QuasiCoulomb",
                      "sticks for ever (1e-7); slides with g (sin a - mu cos a) to 0.5 %", [](Case& c) {
                        for (const TestedModel& b : moving())
                          for (const Real times : {0.99, 1.01, 2.0}) slope(c, b, times);
                      });

// One or four elements that swing freely, held at the foot.
void oscillation_count(Case& c, Real radius, Index count, bool bounces) {
  for (const TestedModel& b : moving()) {
    CaseSetup s{.body = mesh::rectangle({.size = {1, 1}, .cells = {1, 1}}), .young = 100};
    s.radius = radius;
    if (bounces) {
      s.contacts = {
          {.side = "bottom", .tool = rigid::line({0, -0.01}, {1, 0}), .mu = 0.3, .normal = 500, .tangential = 500}};
      s.loads = {{"top", 1, [](Real) { return -1.0; }}};
      s.velocity = [](const V&) { return V(0.2, -0.1); };
    } else {
      s.driven = {held("bottom", 0), held("bottom", 1)};
      s.velocity = [](const V& x) { return V(0.5 * x[1], 0.2 * x[1]); };
    }
    s.marches = {steps(Real(count) * 0.02, count, 1e-9)};
    Real first = 0, largest = 0;
    (void)completes(
        c, b, s,
        [&](const ConvergedState& m) {
          const Real e = m.energies.kinetic + m.energies.elastic + m.energies.penalty;
          if (m.step.number == 1) first = e;
          largest = std::max(largest, e);
        },
        1e-6);
    if (!bounces)
      c.require(largest < first * (radius == 1 ? 1.01 : 1.001),
                b.name + ": energy grows to " + Case::number(largest / first));
  }
}
const HardCase conserves("motion", "free swinging, spectral radius 1", "dynamics: Coulomb; QuasiCoulomb",
                         "10 000 steps: energy never above the start's by 1 %; energy balance closes",
                         [](Case& c) { oscillation_count(c, 1, 10000, false); });
const HardCase conserves_long(
    "motion", "free swinging, spectral radius 1, long", "dynamics: Coulomb; QuasiCoulomb",
    "100 000 steps: energy never above the start's by 1 %; energy balance closes",
    [](Case& c) { oscillation_count(c, 1, 100000, false); }, Form::full);
const HardCase damps("motion", "free swinging, spectral radius 0.5", "dynamics: Coulomb; QuasiCoulomb",
                     "10 000 steps: energy balance closes", [](Case& c) { oscillation_count(c, 0.5, 10000, false); });
const HardCase chatters("motion", "a block dropped askew on a rough floor: rebound and chatter",
                        "dynamics: Coulomb; QuasiCoulomb", "5000 steps: energy balance closes",
                        [](Case& c) { oscillation_count(c, 0.5, 5000, true); });
const HardCase chatters_long(
    "motion", "rebound and chatter, long, spectral radius 0.5", "dynamics: Coulomb; QuasiCoulomb",
    "100 000 steps: energy balance closes", [](Case& c) { oscillation_count(c, 0.5, 100000, true); }, Form::full);

// --- impact

// A bar of 50 elements that hits a wall at velocity 1: force rho c v A = 10 for 2 L / c = 0.02.
void hits(Case& c, const TestedModel& b, const TimeScheme& scheme, Real normal, Index steps_per_transit) {
  const Real transit = 0.01, gap = 0.002, dt = transit / Real(steps_per_transit), start = 0.05;
  CaseSetup s{.body = mesh::rectangle({.size = {1, 10}, .cells = {2, 50}}), .young = 1e4, .poisson = 0};
  s.contacts = {{.side = "bottom",
                 .tool = rigid::line({0, -gap}, {1, 0}),
                 .normal = normal,
                 .tangential = 1,
                 .per = PenaltyPer::stiffness}};
  s.density = 1e-2;
  s.scheme = scheme;
  s.velocity = [](const V&) { return V(0, -1); };
  const Index count = 5 * steps_per_transit / 2;
  s.marches = {steps(dt * Real(count), count, 1e-9)};
  Real largest = 0, end = 0, low = 100, high = 0, impulse = 0, sum = 0;
  Index n = 0;
  const CaseResult p = completes(
      c, b, s,
      [&](const ConvergedState& m) {
        end = (m.energies.kinetic + m.energies.elastic + m.energies.penalty) / start;
        largest = std::max(largest, end);
        const Real force = -m.force()[1], t = (m.step.time - 0.5 * dt - gap) / transit;
        impulse += force * dt;
        if (t < 0.3 || t > 1.7) return;
        low = std::min(low, force);
        high = std::max(high, force);
        sum += force;
        ++n;
      },
      1e-4);
  const std::string at = b.name + ", alpha_f " + Case::number(scheme.alpha_f) + ", " + Case::number(normal) +
                         " times, " + std::to_string(steps_per_transit) + " steps";
  const bool overdamped = scheme.alpha_m < -0.9;
  // At 400 steps the tolerance of 1e-9 is an aim: M / dt^2 leaves seven digits of the forces, and the run says so. At
  // 100 it leaves eight, which is where the warning begins.
  for (const Warning& w : p.warnings)
    c.require(w.name == "digits_lost" && steps_per_transit >= 100, at + ": no warning, " + w.name + ": " + w.text);
  c.require(largest < 1 + 1e-9, at + ": energy grows to " + Case::number(largest));
  c.require(end > (overdamped ? 0.94 : 0.97) && end < 0.998, at + ": end energy " + std::to_string(end));
  c.require(impulse / 0.1 - 1 > (overdamped ? 0.95 : 0.96) && impulse / 0.1 - 1 < 0.997, at + ": rebound");
  // At 400 steps the waves of single elements are resolved, and the mesh disperses them.
  const Real part = steps_per_transit < 400 ? 0.01 : normal > 1 ? 0.16 : 0.25;
  c.near(low, 10, part, at + ": force");
  c.near(high, 10, part, at + ": force");
  c.near(sum / Real(n), 10, 2e-3, at + ": mean force");
}
const HardCase impacts(
    "motion", "a bar hits a wall: 5 schemes, 3 penalties and multipliers, 50 to 400 steps a transit",
    "dynamics: QuasiCoulomb at mu = 0; frictionless with multipliers",
    "energy never above the start's (1e-9); force of the wave to 1 % (mean 0.2 %; 16 % where the mesh disperses)",
    [](Case& c) {
      for (const Index count : {50, 100, 400})
        for (const TimeScheme& scheme :
             {newmark(), chung_hulbert(0.9), chung_hulbert(0.5), chung_hulbert(0.0), hht(0.1)}) {
          for (const Real normal : {1.0, 100.0, 1e4}) hits(c, moving()[1], scheme, normal, count);
          hits(c, ringing(), scheme, 10, count);
        }
    },
    Form::full);

// Taylor's bar: copper, 227 m/s; mm, t, s.
CaseResult taylor(Case& c, const V& cells, Real radius, Real end, Index count, bool held_foot, const Look& look = {}) {
  CaseSetup s{.body = mesh::rectangle({.size = {3.2, 32.4}, .cells = {Index(cells[0]), Index(cells[1])}}),
              .young = 117e3,
              .poisson = 0.35,
              .yield = 400,
              .hardening = 100};
  s.contacts = {{.side = "bottom",
                 .tool = rigid::line({0, held_foot ? -100.0 : 0.0}, {1, 0}),
                 .normal = 100,
                 .tangential = 1,
                 .per = PenaltyPer::stiffness}};
  s.driven = {held("left", 0)};
  if (held_foot) s.driven.push_back(held("bottom", 1));
  s.density = 8.93e-9;
  s.radius = radius;
  s.velocity = [=](const V& x) { return V(0, held_foot && x[1] < 1e-9 ? 0 : -227e3); };
  s.marches = {steps(end, count, 1e-6)};
  CaseResult p = completes(c, tube(), s, look, 1e-3);
  c.require(p.warnings.empty(), "no warning");
  return p;
}
const HardCase taylors(
    "motion", "Taylor's bar on a plane, 5 x 50 and 10 x 100", "axisymmetric J2 dynamics, QuasiCoulomb, EigenLdlt",
    "largest strain within 6 % between schemes; 3.17 with the foot held; dish 0.255 +- 0.02 mm, closed again",
    [](Case& c) {
      Real least = 100, most = 0;
      for (const Real radius : {1.0, 0.9, 0.5, 0.0}) {
        const Real strain = taylor(c, {5, 50}, radius, 80e-6, 800, false).plastic;
        least = std::min(least, strain);
        most = std::max(most, strain);
      }
      c.small(most / least - 1, 0.06, "strain between schemes");
      c.near(0.5 * (least + most), 3.48, 0.05, "strain");
      c.near(taylor(c, {5, 50}, 0.5, 80e-6, 800, true).plastic, 3.17, 0.02, "strain with the foot held");
      // The release wave meets at the axis and lifts the centre, which comes back.
      Real dish = 0, last = 0;
      (void)taylor(c, {10, 100}, 0.5, 12e-6, 200, false, [&](const ConvergedState& m) {
        last = m.u[1];
        dish = std::max(dish, last);
      });
      c.near(dish, 0.255, 0.02 / 0.255, "dish");
      c.small(last, 0.005, "the dish closes");
      c.note("strain " + Case::number(least) + " to " + Case::number(most) + ", dish " + std::to_string(dish));
    },
    Form::full);

// A soft block slides under constant friction in steps that resolve its flutter: lift-off bounds it.
const HardCase flutters(
    "motion", "a soft block flutters while it slides, mu = 0.49, spectral radius 1", "dynamics: Coulomb; QuasiCoulomb",
    "4000 steps: the scheme gains nothing, no warning; energy bounded",
    [](Case& c) {
      for (const TestedModel& b : moving()) {
        const Real weight = 500 * 9.81, cosine = 1 / std::sqrt(1.25), sine = 0.5 * cosine;
        CaseSetup s{.body = mesh::rectangle({.size = {1, 0.5}, .cells = {8, 4}}), .young = 1e7, .poisson = 0.3};
        s.contacts = {{.side = "bottom",
                       .tool = rigid::line({0, 0}, {1, 0}),
                       .mu = 0.49,
                       .normal = 100,
                       .tangential = 100,
                       .per = PenaltyPer::stiffness}};
        s.density = 1000;
        s.radius = 1;
        for (const char* side : {"top", "bottom"}) {
          const auto on = [=](Real t) { return 0.5 * std::min(1.0, 4 * t * t) * weight; };
          s.loads.push_back({side, 1, [=](Real t) { return -cosine * on(t); }});
          s.loads.push_back({side, 0, [=](Real t) { return sine * on(t); }});
        }
        s.marches = {steps(4, 4000, 1e-8)};
        Real high = 0, vibration = 0;
        const CaseResult p = completes(c, b, s, [&](const ConvergedState& m) {
          high = std::max(high, -m.force()[1] / (weight * cosine));
          vibration = std::max(vibration, m.energies.elastic + m.energies.penalty);
        });
        c.require(p.energies.algorithmic > -1e-3 * p.energies.external && p.warnings.empty(),
                  b.name + ": gains " + Case::number(-p.energies.algorithmic));
        c.require(vibration < 0.2 * p.energies.external, b.name + ": bounded");
        c.note(b.name + ": force up to " + Case::number(high) + " times the load, loses " +
               Case::number(p.energies.algorithmic) + " J of " + Case::number(p.energies.external));
      }
    },
    Form::full);

}  // namespace
