// SPDX-License-Identifier: BSL-1.0
//
// Conical extrusion of an aluminium billet (Simo & Laursen 1992).
//
// A ram pushes a billet of radius 50.8 mm and length 254 mm by 178 mm into a rigid cone of half-angle 5 degrees. The
// cone is unbounded: its wall just touches the front edge, so that the nodes of the flank come into contact one after
// another until the rear arrives at about 115 mm and the force takes off. It is the third benchmark of García Garino &
// Ponthot's paper, and the hard one for their law: the normal forces change wildly, and a bound that lags a step behind
// shows. Another problem, by --die container, puts a straight container before the cone, with a rounded joint.
//
//        z |    \  cone          The axis is the left side of the mesh, the ram its bottom; the ram's face is free to
//          |_____\               move radially.
//    billet|      |\             Lengths in mm, forces in N of the full turn, stresses in MPa. Penalties are those of
//          |      | \            the paper, 1e8 and 1e7 N/cm, per node and radian (reconstructed: so the penetration
//          +------+  r           agrees with the paper's).
//            ram ^

#include "common/benchmark.hpp"

#include <stickslip/stickslip.hpp>

#include <cmath>

using namespace stickslip;

// What the benchmark is made of, decided at compile time. Friction and solver come from the command line's names.
struct Extrusion : QuasistaticDefaults {
  using Kinematics = Axisymmetric;
  using Material = FiniteJ2<LinearHardening>;
};

// How much of it, decided at run time.
constexpr Real radius = 50.8, length = 254.0, travel = 178.0;

// The wall, walked upwards with the billet on the left.
rigid::Profile die(Real half_angle, bool container, Real fillet) {
  const Vec<Real, 2> inwards(-std::sin(half_angle), std::cos(half_angle));
  if (!container) return rigid::line({radius, length}, inwards);
  const Real cut = fillet * std::tan(0.5 * half_angle);
  return rigid::path({radius, length - cut - 100}, {0, 1})
      .straight(100)
      .left(fillet, half_angle)
      .straight(100)
      .endless();
}

template <class Model>
int extrude(const examples::Options& options) {
  const auto& p = options.parameters;
  Contact<Model> wall{.side = "right",
                      .tool = die(p.at("half-angle") * pi / 180, p.at("die") == 1, p.at("fillet")),
                      .enforcement = {.normal = 1e7, .tangential = 1e6},
                      .name = "die"};
  if constexpr (has_friction<Model>) wall.friction = {.mu = options.mu};

  Problem<Model> billet{{
      .body = mesh::rectangle({.size = {radius, length}, .cells = {4 * options.refine, 20 * options.refine}}),
      .material = {.young = 68956, .poisson = 0.32, .hardening = {.yield = 31.0, .modulus = 261.2}},
      .contacts = {wall},
  }};
  billet.hold("left", 0).drive("bottom", 1, [](Real t) { return travel * t; });

  return examples::run<Model, examples::Books::kept>(options, billet,
                                                     {.labels = {.name = "conical_extrusion",
                                                                 .kinematics = "axisymmetric",
                                                                 .material = "finite J2, linear hardening",
                                                                 .travel = "ram travel",
                                                                 .force = "ram force",
                                                                 .view = "set xrange [0:120]\nset yrange [0:620]"},
                                                      .march = {.end = 1,
                                                                .initial = 0.1 / travel,
                                                                .largest = 1.6 / travel,
                                                                .stops = {44.5 / travel, 89 / travel, 135 / travel}},
                                                      .travel_mm = [&] { return travel * billet.time(); },
                                                      .force_N = [&] { return billet.reaction("bottom", 1); },
                                                      .reach_mm = 450});
}

int main(int argc, char** argv) {
  constexpr auto frictions = examples::coulomb_laws;
  using examples::AllSolvers;
  const examples::Program program{
      .name = "conical_extrusion",
      .title = "a billet pushed into a rigid cone",
      .frictions = frictions.list(),
      .solvers = AllSolvers::solvers().names(),
      .mu = 0.1,
      .tolerance = 1e-4,
      .parameters = {{.name = "half-angle", .about = "of the cone, in degrees", .value = 5, .low = 0.5, .high = 30},
                     {.name = "die", .about = "the wall", .value = 0, .names = {"unbounded", "container"}},
                     {.name = "fillet",
                      .about = "radius of the joint of container and cone, in mm",
                      .value = 10,
                      .low = 0.1,
                      .high = 1000},
                     examples::element_option()}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    if (options->list) return examples::print_list<Extrusion, AllSolvers>(frictions);
    return examples::dispatch_element<Extrusion, AllSolvers>(*options, frictions,
                                                             [&]<class Model>() { return extrude<Model>(*options); });
  });
}
