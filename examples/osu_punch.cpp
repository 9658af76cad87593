// SPDX-License-Identifier: BSL-1.0
//
// The OSU hemispherical punch (Lee, Wagoner & Nakamachi 1990).
//
// A round sheet of 1 mm, clamped at its rim, is stretched over a hemispherical punch of radius 50.8 mm by 40 mm. The
// sheet wraps the punch from the pole outwards and bends over the fillet of the die. It is the first benchmark of
// García Garino & Ponthot's paper on the Quasi-Coulomb law: the sheet is thin, the normal forces change slowly, and a
// friction bound that lags one step behind hardly errs.
//
//        z |         /             The punch comes down from above. The die stands below, its fillet of 6.35 mm ends
//          | punch .'              where the sheet is clamped (*), at r = 59.18 mm.
//          |___.--'_____________
//    sheet |____________________*  Lengths in mm, forces in N of the full turn, stresses in MPa.
//          |                .--'
//          |               | die
//          +--------------------- r

#include "common/benchmark.hpp"

#include <stickslip/stickslip.hpp>

using namespace stickslip;

// What the benchmark is made of, decided at compile time. Friction and solver come from the command line's names.
struct Punch : QuasistaticDefaults {
  using Kinematics = Axisymmetric;
  using Material = FiniteJ2<PowerHardening>;
};

// How much of it, decided at run time.
constexpr Real punch_radius = 50.8, die_fillet = 6.35, rim = 59.18, thickness = 1.0;

template <class Model>
int punch(const examples::Options& options) {
  // The tools, walked with the sheet on the left: the punch from its flank over the pole, the die up its throat, over
  // the fillet and outwards.
  const auto sphere = rigid::path({punch_radius, thickness + punch_radius}, {0, -1}).right(punch_radius, pi);
  const auto die =
      rigid::path({rim - die_fillet, -100}, {0, 1}).straight(100 - die_fillet).right(die_fillet, pi / 2).straight(40);
  const Real travel = options.parameters.at("travel");
  const auto downwards = [travel](Real t) { return Vec<Real, 2>(0, -travel * t); };

  Contact<Model> on_punch{.side = "top",
                          .tool = sphere,
                          .motion = downwards,
                          .enforcement = {.normal = 1e5, .tangential = 1e4},
                          .name = "punch"};
  Contact<Model> on_die{
      .side = "bottom", .tool = die, .enforcement = {.normal = 1e5, .tangential = 1e4}, .name = "die"};
  if constexpr (has_friction<Model>) on_punch.friction = on_die.friction = {.mu = options.mu};

  Problem<Model> sheet{{
      .body = mesh::rectangle({.size = {rim, thickness}, .cells = {14 * options.refine, 2 * options.refine}}),
      .material = {.young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 0.0001, .exponent = 0.216}},
      .contacts = {on_punch, on_die},
  }};
  sheet.hold("left", 0).hold("right", 0).hold("right", 1);

  return examples::run<Model>(options, sheet,
                              {.labels = {.name = "osu_punch",
                                          .kinematics = "axisymmetric",
                                          .material = "finite J2, power hardening",
                                          .travel = "punch travel",
                                          .force = "punch force",
                                          .view = "set xrange [0:75]\nset yrange [-50:20]"},
                               .march = {.end = 1,
                                         .initial = 0.1 / travel,
                                         .largest = 0.8 / travel,
                                         .stops = {10 / travel, 20 / travel, 30 / travel}},
                               .travel_mm = [&] { return travel * sheet.time(); },
                               .force_N = [&] { return sheet.contact_force("punch")[1]; },
                               .reach_mm = 60});
}

int main(int argc, char** argv) {
  constexpr auto frictions = examples::coulomb_laws;
  using examples::AllSolvers;
  const examples::Program program{
      .name = "osu_punch",
      .title = "a clamped sheet stretched over a hemispherical punch",
      .frictions = frictions.list(),
      .solvers = AllSolvers::solvers().names(),
      .mu = 0.15,
      .parameters = {{.name = "travel", .about = "punch travel in mm", .value = 40, .low = 1, .high = 500},
                     examples::element_option()}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    if (options->list) return examples::print_list<Punch, AllSolvers>(frictions);
    return examples::dispatch_element<Punch, AllSolvers>(*options, frictions,
                                                         [&]<class Model>() { return punch<Model>(*options); });
  });
}
