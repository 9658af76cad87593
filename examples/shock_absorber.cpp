// SPDX-License-Identifier: BSL-1.0
//
// The shock absorber, or invertube: a thin tube is driven over a die that turns it inside out (García Garino &
// Ponthot).
//
// An aluminium tube of 50.8 mm outside diameter, 1.63 mm wall and 63.5 mm length goes down on a die at 40 m/s. The die,
// reconstructed, is a post of the tube's bore with a concave quarter circle of 3.97 mm at its foot that turns the
// leading end outwards, then a flat. The curl of plastic strain takes up the energy. Implicit dynamics; 50 mm in
// 1.25 ms. (The paper prints 44 m/s, yet 50 mm in 1.25 ms and its own 144 km/h are 40 m/s.)
//
//        z |  post | |               The upper nodes are driven; every node starts at their velocity, unless
//          |       | | tube          --start-velocity off. All faces of the tube but its upper one may touch the die.
//          |       |_|               The same faces are in contact with themselves: from about 24 mm of travel on
//          |        \_______ flat     the curled end meets the wall and folds. --self-contact off is the paper's run,
//          +--------------------- r  in which the tube passes through itself; the output says from where on. Lengths
//                                    in mm, time in s, mass in t, forces in N of the full turn, stresses in MPa.

#include "common/benchmark.hpp"
#include "common/self_penetration.hpp"

#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/stickslip.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>

using namespace stickslip;

// What the benchmark is made of, decided at compile time. Friction and solver come from the command line's names.
struct Tube : QuasistaticDefaults {
  using Kinematics = Axisymmetric;
  using Material = FiniteJ2<LinearHardening>;
  using TimeIntegration = GeneralizedAlpha;
};

// How much of it, decided at run time.
constexpr Real outer_radius = 25.4, wall = 1.63, length = 63.5, bore = outer_radius - wall, die_radius = 3.97;
constexpr Real speed = 40e3, travel = 50.0;

// The friction of the die is that of the tube on itself.
template <class Model>
struct Folding : Model {
  using Surfaces = SurfaceContact<typename Model::Friction>;
};

template <class Rigid>
int invert(const examples::Options& options) {
  using Model = Folding<Rigid>;
  const auto& p = options.parameters;
  auto tube = mesh::rectangle(
      {.origin = {bore, 0}, .size = {wall, length}, .cells = {3 * options.refine, 100 * options.refine}});
  mesh::join(tube, "surface", {"left", "bottom", "right"});

  // The die, walked down the post with the tube on the left.
  auto die = rigid::path({bore, 80}, {0, -1});
  die.straight(80).left(die_radius, p.at("arc-angle") * pi / 180).straight(80);
  Contact<Model> on_die{
      .side = "surface", .tool = die, .enforcement = {.normal = 1e7, .tangential = 1e6}, .name = "die"};
  SurfaceContacts<Model> on_itself(p.at("self-contact") == 0 ? 1 : 0);
  for (auto& c : on_itself) {
    c.side = c.against = "surface";
    c.enforcement = {.normal = 1e5, .tangential = 1e4, .per = PenaltyPer::area};
    c.name = "itself";
  }
  if constexpr (has_friction<Model>) {
    on_die.friction = {.mu = options.mu};
    for (auto& c : on_itself) c.friction = {.mu = options.mu};
  }

  const Real scale = p.at("yield-scale");
  Problem<Model> absorber{{
      .body = tube,
      .material = {.young = 67000, .poisson = 0.33, .hardening = {.yield = 15 * scale, .modulus = 44.7 * scale}},
      .density = 2.7e-9,
      .time_integration = {.scheme = chung_hulbert(p.at("spectral-radius"))},
      .contacts = {on_die},
      .surfaces = on_itself,
  }};
  absorber.drive("top", 1, [](Real t) { return -speed * t; });
  if (p.at("start-velocity") == 0) absorber.start_velocity({0, -speed});

  return examples::run<Model, examples::Books::kept>(
      options, absorber,
      {.labels = {.name = "shock_absorber",
                  .kinematics = "axisymmetric",
                  .material = "finite J2, linear hardening",
                  .travel = "travel of the upper end",
                  .force = "force on the upper end",
                  .view = "set xrange [15:50]\nset yrange [-8:70]"},
       .march = {.end = travel / speed,
                 .initial = 0.02 / speed,
                 .largest = 0.5 / speed,
                 .target_iterations = 6,
                 .stops = {10 / speed, 20 / speed, 30 / speed, 40 / speed}},
       .travel_mm = [&] { return speed * absorber.time(); },
       .force_N = [&] { return -absorber.reaction("top", 1); },
       .depth_in_itself = [&] { return examples::depth_in_itself(tube, absorber.displacement(), "surface"); },
       .most_in_itself_mm = on_itself.empty() ? 0 : 0.1,  // nodes lie a little deeper than means
       .reach_mm = 75});
}

int main(int argc, char** argv) {
  constexpr auto frictions = examples::coulomb_laws;
  using examples::AllSolvers;
  const examples::Program program{
      .name = "shock_absorber",
      .title = "a tube turned inside out by a die, in implicit dynamics",
      .frictions = frictions.list(),
      .solvers = AllSolvers::solvers().names(),
      .mu = 0.15,
      .tolerance = 1e-2,
      .parameters = {
          {.name = "arc-angle", .about = "of the die's circle, in degrees", .value = 90, .low = 30, .high = 180},
          {.name = "yield-scale",
           .about = "factor on the flow stress; 9.80665 if the paper meant kgf/mm2",
           .value = 1,
           .low = 0.1,
           .high = 100},
          {.name = "self-contact", .about = "of the tube", .value = 0, .names = {"on", "off"}},
          {.name = "start-velocity", .about = "of the whole tube", .value = 0, .names = {"on", "off"}},
          {.name = "spectral-radius",
           .about = "of the time scheme at infinite frequency",
           .value = 0,
           .low = 0,
           .high = 1},
          examples::element_option()}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    if (options->list) return examples::print_list<Tube, AllSolvers>(frictions);
    return examples::dispatch_element<Tube, AllSolvers>(*options, frictions,
                                                        [&]<class Model>() { return invert<Model>(*options); });
  });
}
