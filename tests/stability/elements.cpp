// SPDX-License-Identifier: BSL-1.0
// The element that bends where elements of its kind are known to fail: hourglass motions in compression, necks,
// distorted cells, inversion, one layer of cells in contact.
#include "run_case.hpp"

namespace {

using namespace stability;

const char* const elastic_model = "AssumedStrain, QuasiCoulomb, EigenLdlt";
const char* const plastic_model = "AssumedStrain, J2, QuasiCoulomb, EigenLdlt";

MarchOptions equal_steps(Real end, Index count, Real tolerance = 1e-10) {
  return {.end = end, .steps = count, .tolerance = tolerance};
}

// A block of 4 x 2 between frictionless plates, shortened or lengthened in plane strain; every other row of inner nodes
// is moved sideways by `tilt` of its height, in turns.
CaseSetup pulled(Real poisson, Real stretch, Index count, Real tilt) {
  CaseSetup s{.body = mesh::rectangle({.size = {4, 2}, .cells = {6, 4}}), .young = 1000, .poisson = poisson};
  for (V& x : s.body.nodes) {
    const long column = std::lround(x[0] * 1.5);
    if (column > 0 && column < 6) x[0] += (column % 2 == 1 ? tilt : -tilt) * (x[1] - 1) * 0.3;
  }
  s.driven = {held("left", 0), held("bottom", 1), {"top", 1, [stretch](Real t) {
                                                     return 2 * (std::exp(t * std::log(stretch)) - 1);
                                                   }}};
  s.marches = {equal_steps(1, count)};
  return s;
}
const HardCase trapezoids(
    "elements", "trapezoids tilted by 0, 17 and 45 degrees, nu = 0.3 to 0.4999999: squeezed to 0.6, pulled to thrice",
    elastic_model, "exact force, whatever the cells", [](Case& c) {
      for (const Real tilt : {0.0, std::tan(17 * pi / 180), 1.0})
        for (const Real nu : {0.3, 0.4999, 0.4999999})
          for (const Real stretch : {0.6, 3.0}) {
            Real force = 0;
            (void)completes(c, bends(), pulled(nu, stretch, 10, tilt),
                            [&](const ConvergedState& m) { force = m.reaction("top", 1); });
            c.near(force, 1000 / (1 - nu * nu) * std::log(stretch) / stretch * 4, 1e-8, "force");
          }
    });

const HardCase inversion("elements", "squeezed to a hundredth, and through", elastic_model,
                         "exact force at 0.01; beyond: refused at the element", [](Case& c) {
                           Real force = 0;
                           (void)completes(c, bends(), pulled(0.3, 0.01, 40, 0.3),
                                           [&](const ConvergedState& m) { force = m.reaction("top", 1); });
                           c.near(force, 1000 / 0.91 * std::log(0.01) / 0.01 * 4, 1e-7, "force");
                           refused_when_inverted(c, bends(), pulled(0.3, 0.5, 1, 0.3));
                         });

// Flat cells are the most easily excited; the corners of rough plates excite them. Nearly incompressible, a coarse
// block is stiffer than one of Q1/P0: its strains lose volume where they vary much (theory.md, eq. 2.23).
const HardCase hourglass(
    "elements", "a block between rough plates, squeezed to 0.6: 4 x 16 flat cells, nu = 0.3; 16 x 16, nu = 0.4999",
    "AssumedStrain; MeanDilatation",
    "force of Q1/P0, its hourglass motion but for a factor of two; force of 32 x 32 cells to 6 %", [](Case& c) {
      const auto squeezed = [&](const TestedModel& b, Real poisson, std::array<Index, 2> cells, Real& force) {
        CaseSetup s{.body = mesh::rectangle({.cells = cells}), .young = 1000, .poisson = poisson};
        s.driven = {held("bottom", 0), held("bottom", 1), held("top", 0), {"top", 1, [](Real t) { return -0.4 * t; }}};
        s.marches = {equal_steps(1, 10)};
        const CaseResult p = completes(c, b, s, [&](const ConvergedState& m) { force = m.reaction("top", 1); });
        Real largest = 0;
        for (const auto& cell : s.body.cells)
          for (const Index i : {0, 1}) {
            Real motion = 0;
            for (std::size_t a = 0; a < 4; ++a) motion += (a % 2 == 0 ? 0.25 : -0.25) * p.u[2 * cell[a] + i];
            largest = std::max(largest, std::abs(motion));
          }
        return largest;
      };
      Real force = 0, plain = 0;
      const Real motion = squeezed(bends(), 0.3, {4, 16}, force), of_plain = squeezed(quasi(), 0.3, {4, 16}, plain);
      c.near(force, plain, 0.02, "force of Q1/P0");
      c.require(motion < 2 * of_plain, "hourglass motion");
      (void)squeezed(bends(), 0.4999, {16, 16}, force);
      c.near(force, -990.5, 0.06, "force of 32 x 32 cells");
      c.note("hourglass motion " + Case::number(motion) + ", of Q1/P0 " + Case::number(of_plain));
    });

// A bar that is one part in a hundred thinner in the middle: its force is greatest where the stress there is the slope
// of hardening (Considere), and then one cell's row takes all.
const HardCase neck("elements", "a tapered bar pulled past its greatest force", plastic_model,
                    "greatest force = Considere's of the thinnest section; then the neck takes all", [](Case& c) {
                      const Real taper = 0.01, yield = 2, modulus = 5;
                      CaseSetup s{.body = mesh::rectangle({.size = {1, 4}, .cells = {3, 12}}), .young = 1000};
                      s.yield = yield, s.hardening = modulus;
                      for (V& x : s.body.nodes) x[0] *= 1 - taper * (1 - x[1] / 4);
                      s.driven = {held("left", 0), held("bottom", 1), {"top", 1, [](Real t) { return 8 * t; }}};
                      s.marches = {equal_steps(1, 80, 1e-8)};
                      Real greatest = 0, last = 0;
                      const CaseResult p = completes(
                          c, bending_metal(), s,
                          [&](const ConvergedState& m) {
                            last = m.reaction("top", 1);
                            greatest = std::max(greatest, last);
                          },
                          1e-2);
                      // sigma = 2 / sqrt(3) (Y + h 2 / sqrt(3) e), the force per area sigma exp(-e).
                      const Real first = 2 / std::sqrt(3.) * yield, slope = 4. / 3 * modulus;
                      const Real strain = 1 - first / slope;
                      c.near(greatest, (1 - taper) * slope * std::exp(-strain), 0.01, "greatest force");
                      c.require(last < 0.7 * greatest, "the neck takes all");
                      c.note("force falls from " + Case::number(greatest) + " to " + Case::number(last));
                    });

// A clamped strip of one layer under an end load that keeps its direction: the elastica (Mattiasson 1981).
const HardCase elastica(
    "elements", "a strip of 100 x 1, 20 cells, bent by P L^2 / E I = 1, 2, 5, 10", elastic_model,
    "deflection of the elastica", [](Case& c) {
      CaseSetup s{.body = mesh::rectangle({.size = {100, 1}, .cells = {20, 1}}), .young = 1e4};
      s.driven = {held("left", 0), held("left", 1)};
      const Real unit = 1e4 / 0.91 / 12 / (100 * 100);
      s.loads = {{"right", 1, [unit](Real t) { return unit * t; }}};
      const Index tip = s.body.side("right").nodes.back();
      const std::pair<Real, Real> exact[] = {{1, 0.30172}, {2, 0.49346}, {5, 0.71379}, {10, 0.81061}};
      for (const auto& [load, deflection] : exact) s.marches.push_back({.end = load, .steps = 10, .tolerance = 1e-8});
      std::size_t seen = 0;
      (void)completes(c, bends(), s, [&](const ConvergedState& m) {
        for (const auto& [load, deflection] : exact)
          if (m.step.time == load) {
            ++seen;
            c.near(m.u[2 * tip + 1] / 100, deflection, 0.012, "deflection");
          }
      });
      c.require(seen == std::size(exact), "all loads were seen");
    });

// The same strip, 40 x 1 and 8 cells, pushed down by a disc at its end.
const HardCase strip("elements", "a strip of one layer under a rough disc", elastic_model,
                     "force of beam theory; forces balance, the steps do not matter", [](Case& c) {
                       Real before = 0;
                       for (const Index count : {4, 20})
                         for (const Real mu : {0.0, 0.3}) {
                           CaseSetup s{.body = mesh::rectangle({.size = {40, 1}, .cells = {8, 1}}), .young = 1000};
                           s.driven = {held("left", 0), held("left", 1)};
                           s.contacts = {{.side = "top",
                                          .tool = rigid::disc({40, 6}, 5),
                                          .motion = [](Real t) { return V(0, -0.5 * t); },
                                          .mu = mu,
                                          .normal = 1e3,
                                          .tangential = 1e2}};
                           s.marches = {equal_steps(1, count)};
                           V support(0, 0);
                           const CaseResult p = completes(c, bends(), s, [&](const ConvergedState& m) {
                             support = V(m.reaction("left", 0), m.reaction("left", 1));
                           });
                           const Real plate = 1000 / 0.91 / 12, shear = 1000 / 2.6;
                           const Real theory = 0.5 / (40 * 40 * 40 / 3. / plate + 40 / (5. / 6 * shear));
                           c.near(std::abs(p.forces[0][1]), theory, 0.01, "beam theory");
                           c.small((support - p.forces[0]).norm() / p.forces[0].norm(), 1e-7, "balance");
                           if (mu == 0 && before != 0) c.near(p.forces[0][1], before, 1e-8, "steps");
                           if (mu == 0) before = p.forces[0][1];
                         }
                     });

}  // namespace
