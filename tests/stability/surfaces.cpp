// SPDX-License-Identifier: BSL-1.0
// Bodies that touch bodies, and themselves.
#include "suite.hpp"

#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/stickslip.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace stability::surfaces {

struct Strip : BodyDefaults {};
struct Folded : QuasistaticDefaults {
  using Bodies = BodyTypes<Strip>;
  using Surfaces = SurfaceContact<QuasiCoulomb>;
};
struct Metal : BodyDefaults {
  using Material = FiniteJ2<LinearHardening>;
};
struct Pressed : QuasistaticDefaults {
  using Bodies = BodyTypes<Metal>;
  using Surfaces = SurfaceContact<Coulomb>;
};

Penalty penalty(Real normal) {
  return {.normal = normal, .tangential = 0.3 * normal, .per = PenaltyPer::area};
}

// A slider pressed on a slab and drawn along it, the whole scene turned by an angle, its nodes numbered by chance.
struct Slide {
  Real along = 0, down = 0, slip = 0;
};
Slide slide(Case& c, Real angle, bool shuffled) {
  std::mt19937 random(5);
  const Real cosine = std::cos(angle), sine = std::sin(angle);
  const auto prepared = [&](Mesh<2, 4> mesh) {
    for (auto& x : mesh.nodes) x = V(cosine * x[0] - sine * x[1], sine * x[0] + cosine * x[1]);
    if (!shuffled) return mesh;
    std::vector<Index> place(mesh.nodes.size());
    std::iota(place.begin(), place.end(), 0);
    std::shuffle(place.begin(), place.end(), random);
    auto nodes = mesh.nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) mesh.nodes[static_cast<std::size_t>(place[n])] = nodes[n];
    const auto renumber = [&](auto& list) {
      for (Index& n : list) n = place[static_cast<std::size_t>(n)];
    };
    for (auto& cell : mesh.cells) renumber(cell);
    std::shuffle(mesh.cells.begin(), mesh.cells.end(), random);
    for (auto& [name, side] : mesh.sides) {
      renumber(side.nodes);
      for (auto& facet : side.facets) renumber(facet);
      std::shuffle(side.facets.begin(), side.facets.end(), random);
    }
    return mesh;
  };
  auto slab = prepared(mesh::rectangle({.origin = {0, 0}, .size = {4, 1}, .cells = {12, 3}}));
  auto slider = prepared(mesh::rectangle({.origin = {1, 1}, .size = {1, 0.5}, .cells = {4, 2}}));
  Problem<Folded> p{{.bodies = {{.name = "slab", .mesh = slab, .material = {.young = 1e3, .poisson = 0.3}},
                                {.name = "slider", .mesh = slider, .material = {.young = 3e3, .poisson = 0.3}}},
                     .surfaces = {{.side = "slider.bottom",
                                   .against = "slab.top",
                                   .friction = {.mu = 0.3},
                                   .enforcement = penalty(1e5),
                                   .name = "joint"}}}};
  p.hold("slab.bottom", 0).hold("slab.bottom", 1);
  const auto way = [=](Real t, Index i) {
    const Real down = -0.02 * std::min(t, 1.0), along = 0.7 * std::max(t - 1, 0.0);
    return i == 0 ? cosine * along - sine * down : sine * along + cosine * down;
  };
  for (const Index i : {0, 1}) p.drive("slider.top", i, [=](Real t) { return way(t, i); });
  c.completes(p.march({.end = 2, .steps = 30, .tolerance = 1e-10}));
  const V f = p.contact_force("joint");
  return {cosine * f[0] + sine * f[1], -sine * f[0] + cosine * f[1], p.contact("joint").summary().max_slip};
}

const HardCase turned(
    "surfaces", "a slide, turned by 0, 35, 90 and 200 degrees, renumbered at random",
    "plane Hencky, QuasiCoulomb, EigenLdlt", "forces and slip the same to 1e-7", [](Case& c) {
      const Slide first = slide(c, 0, false);
      for (const auto& [degrees, shuffled] : {std::pair{0.0, true}, {35.0, false}, {90.0, true}, {200.0, true}}) {
        const Slide other = slide(c, degrees * pi / 180, shuffled);
        c.near(other.along, first.along, 1e-7, "force along");
        c.near(other.down, first.down, 1e-7, "force down");
        c.near(other.slip, first.slip, 1e-7, "slip");
      }
    });

const HardCase wall("surfaces", "walls of 1/2 to 1/20 of a facet bent on themselves by nothing",
                    "plane Hencky, QuasiCoulomb, EigenLdlt", "no contact at all", [](Case& c) {
                      for (const Real thickness : {0.5, 0.2, 0.05}) {
                        auto strip = mesh::rectangle({.size = {10, thickness}, .cells = {10, 2}});
                        mesh::join(strip, "skin", {"bottom", "right", "top", "left"});
                        Problem<Folded> p{
                            {.bodies = {{.name = "strip", .mesh = strip, .material = {.young = 1e3, .poisson = 0.3}}},
                             .surfaces = {{.side = "strip.skin",
                                           .against = "strip.skin",
                                           .friction = {.mu = 0.2},
                                           .enforcement = penalty(1e5),
                                           .name = "self"}}}};
                        p.hold("strip.left", 0).hold("strip.left", 1);
                        p.drive("strip.right", 1, [](Real t) { return -2 * t; });
                        c.completes(p.march({.end = 1, .initial = 0.02}));
                        c.small(p.contact("self").force().norm(), 0, "force on itself");
                      }
                    });

const HardCase layers(
    "surfaces", "three layers drawn apart, penalties 1e3 to 1e12 times the body",
    "plane Hencky, QuasiCoulomb, EigenLdlt",
    "both joints bear 0.2 of the load; the load grows with the penalty to one limit", [](Case& c) {
      Real before = 0;
      for (const Real normal : {1e6, 1e8, 1e11, 1e15}) {
        const auto layer = [](Real low, Index cells) {
          return mesh::rectangle({.origin = {0, low}, .size = {4, 0.5}, .cells = {cells, 2}});
        };
        auto middle = mesh::rectangle({.origin = {-1, 0.5}, .size = {6, 0.5}, .cells = {17, 2}});
        Penalty stiff = penalty(normal);
        stiff.tangential = 1e5;
        Problem<Folded> p{
            {.bodies = {{.name = "a", .mesh = layer(0, 8), .material = {.young = 1e3, .poisson = 0.3}},
                        {.name = "b", .mesh = middle, .material = {.young = 1e3, .poisson = 0.3}},
                        {.name = "c", .mesh = layer(1, 9), .material = {.young = 1e3, .poisson = 0.3}}},
             .surfaces = {
                 {.side = "a.top", .against = "b.bottom", .friction = {.mu = 0.2}, .enforcement = stiff, .name = "low"},
                 {.side = "c.bottom",
                  .against = "b.top",
                  .friction = {.mu = 0.2},
                  .enforcement = stiff,
                  .name = "high"}}}};
        p.hold("a.bottom", 0).hold("a.bottom", 1).hold("c.top", 0);
        p.drive("c.top", 1, [](Real t) { return -0.01 * std::min(t, 1.0); });
        p.drive("b.right", 0, [](Real t) { return 0.3 * std::max(t - 1, 0.0); });
        c.completes(p.march({.end = 2, .steps = 40}));
        const V low = p.contact_force("low"), high = p.contact_force("high");
        c.near(std::abs(low[0] / low[1]), 0.2, 0.01, "friction of the lower joint");
        c.near(std::abs(high[0] / high[1]), 0.2, 0.01, "friction of the upper joint");
        if (before > 0) c.near(std::abs(low[1]), before, normal == 1e8 ? 0.02 : 1e-3, "load");
        before = std::abs(low[1]);
      }
    });

const HardCase fold("surfaces", "a strip folded to an eighth of its length",
                    "plane Hencky, QuasiCoulomb, EigenLdlt",
                    "folds lie on one another; the force on the strip is in balance", [](Case& c) {
                      auto strip = mesh::rectangle({.size = {30, 1}, .cells = {90, 3}});
      for (auto& x : strip.nodes) x[1] += 0.05 * std::sin(3 * pi * x[0] / 30) * std::sin(pi * x[0] / 30);
      mesh::join(strip, "skin", {"bottom", "right", "top", "left"});
                      Problem<Folded> p{
                          {.bodies = {{.name = "strip", .mesh = strip, .material = {.young = 1e3, .poisson = 0.3}}},
                           .surfaces = {{.side = "strip.skin",
                                         .against = "strip.skin",
                                         .friction = {.mu = 0.1},
                                         .enforcement = penalty(1e4),
                                         .name = "self"}}}};
                      p.hold("strip.left", 0).hold("strip.left", 1).hold("strip.right", 1);
                      p.drive("strip.right", 0, [](Real t) { return -30 * t; });
                      c.completes(p.march({.end = 0.03, .initial = 1e-4, .largest = 3e-4}));
      c.completes(p.march({.end = 0.88, .initial = 1e-3, .largest = 0.01}));
                      c.require(p.contact("self").summary().touching > 0, "it touches itself");
                      c.small(std::abs(p.reaction("strip.left", 0) + p.reaction("strip.right", 0)),
                              1e-4 * std::abs(p.reaction("strip.left", 0)), "balance of the ends");
                    });

const HardCase upset(
    "surfaces", "a soft billet upset by 60 % between elastic dies, friction 0 to 1", "plane J2, exact Coulomb, EigenLu",
    "completes; the dies bear the same force", [](Case& c) {
      for (const Real mu : {0.0, 0.3, 1.0}) {
        auto billet = mesh::rectangle({.origin = {0, 0}, .size = {1, 1}, .cells = {6, 6}});
        const auto die = [](Real low, Index cells) {
          return mesh::rectangle({.origin = {0, low}, .size = {3, 0.5}, .cells = {cells, 2}});
        };
        const auto steel = [] {
          FiniteJ2<LinearHardening> m;
          m.young = 1e5, m.poisson = 0.3, m.hardening = {.yield = 1e9, .modulus = 0};
          return m;
        }();
        FiniteJ2<LinearHardening> soft;
        soft.young = 1e3, soft.poisson = 0.3, soft.hardening = {.yield = 5, .modulus = 20};
        Problem<Pressed> p{{.bodies = {{.name = "low", .mesh = die(-0.5, 11), .material = steel},
                                       {.name = "billet", .mesh = billet, .material = soft},
                                       {.name = "up", .mesh = die(1, 13), .material = steel}},
                            .surfaces = {{.side = "billet.bottom",
                                          .against = "low.top",
                                          .friction = {.mu = mu},
                                          .enforcement = penalty(1e5),
                                          .name = "below"},
                                         {.side = "billet.top",
                                          .against = "up.bottom",
                                          .friction = {.mu = mu},
                                          .enforcement = penalty(1e5),
                                          .name = "above"}}}};
        p.hold("low.bottom", 0).hold("low.bottom", 1).hold("low.left", 0).hold("billet.left", 0).hold("up.left", 0);
        p.hold("up.top", 0).drive("up.top", 1, [](Real t) { return -0.6 * t; });
        c.completes(p.march({.end = 1, .initial = 0.005, .largest = 0.02}));
        c.near(p.contact_force("below")[1], -p.contact_force("above")[1], 1e-4, "forces at mu = " + Case::number(mu));
      }
    });

const HardCase end("surfaces", "a slider drawn off the end of a slab and pushed back on",
                   "plane Hencky, QuasiCoulomb, EigenLdlt", "free past the end; back it bears what it bore",
                   [](Case& c) {
                     auto slab = mesh::rectangle({.origin = {0, 0}, .size = {4, 1}, .cells = {10, 3}});
                     auto slider = mesh::rectangle({.origin = {2, 1}, .size = {1, 0.5}, .cells = {3, 2}});
                     Problem<Folded> p{
                         {.bodies = {{.name = "slab", .mesh = slab, .material = {.young = 1e3, .poisson = 0.3}},
                                     {.name = "slider", .mesh = slider, .material = {.young = 1e3, .poisson = 0.3}}},
                          .surfaces = {{.side = "slider.bottom",
                                        .against = "slab.top",
                                        .friction = {.mu = 0.1},
                                        .enforcement = penalty(1e5),
                                        .name = "joint"}}}};
                     p.hold("slab.bottom", 0).hold("slab.bottom", 1);
                     p.drive("slider.top", 1, [](Real t) {
                       return -0.002 * std::min(t, 1.0) + (t > 2 && t < 3 ? 0.1 * std::min(t - 2, 3 - t) : 0.0);
                     });
                     p.drive("slider.top", 0, [](Real t) {
                       return 2.5 * std::clamp(t - 1, 0.0, 1.0) - 2.5 * std::clamp(t - 2.5, 0.0, 1.0);
                     });
                     c.completes(p.march({.end = 1, .initial = 0.1}));
                     const Real pressed = p.contact_force("joint")[1];
                     c.completes(p.march({.end = 2, .initial = 0.02, .largest = 0.02}));
                     c.small(p.contact_force("joint").norm(), 0, "force past the end");
                     c.completes(p.march({.end = 3.5, .initial = 0.02, .largest = 0.02}));
                     c.near(p.contact_force("joint")[1], pressed, 0.05, "force once it is back");
                   });

}  // namespace stability::surfaces
