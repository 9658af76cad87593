// SPDX-License-Identifier: BSL-1.0
//
// The hemispherical punch of osu_punch.cpp in three dimensions: a quarter of the sheet.
//
// The same sheet, tools, material and law of friction, but nothing is known of the symmetry about the axis: the
// solid elements, contact and friction are those of space. Its force must be that of the axisymmetric program.
//
//        z |         /               The plane of symmetry y = 0; y points away from the viewer. Symmetric about x = 0
//          | punch .'                too. The sheet is clamped at its rim (*). Forces are those of the full punch.
//          |___.--'_____________
//    sheet |____________________*    --refine N has 7N x 7N elements in the middle, as many between it and each half
//          |                .--'     of the rim, and 2N through the thickness: 14N along a radius, as osu_punch has.
//          |               | die
//          +--------------------- x
//
// With --solver-table on, every solver that takes the system marches to the travel and its costs are printed:
// sheet_stamping --refine 3 --travel 1 --solver-table on

#include "sheet_stamping/scene.hpp"

#include "common/solver_table.hpp"

#include <concepts>

using namespace stickslip;

// Instantiated once each, in the units of the folder sheet_stamping.
extern template int stamp<SolvedStamping<Coulomb, run_time::Takes::full>>(const examples::Options&);
extern template int stamp<SolvedStamping<Coulomb, run_time::Takes::corrections>>(const examples::Options&);
extern template int stamp<SolvedStamping<QuasiCoulomb, run_time::Takes::triangle>>(const examples::Options&);
using Bending = AssumedStrain<Hex8>;
extern template int stamp<SolvedStamping<Coulomb, run_time::Takes::full, Bending>>(const examples::Options&);
extern template int stamp<SolvedStamping<QuasiCoulomb, run_time::Takes::triangle, Bending>>(const examples::Options&);

int main(int argc, char** argv) {
  using run_time::Named;
  constexpr run_time::Choices frictions{Named<Coulomb>{"coulomb"}, Named<QuasiCoulomb>{"quasi-coulomb"}};
  const examples::Program program{
      .name = "sheet_stamping",
      .title = "a quarter of a clamped sheet stretched over a hemispherical punch, in three dimensions",
      .frictions = frictions.list(),
      .solvers = SheetSolvers::solvers().names(),
      .mu = 0.15,
      .parameters = {
          {.name = "travel", .about = "punch travel in mm", .value = 40, .low = 0.001, .high = 500},
          {.name = "solver-table",
           .about = "run with every solver that takes the system and print what an iteration costs",
           .names = {"off", "on"}},
          examples::element_option(),
          {.name = "memory", .about = "GiB for a solver of the table", .value = 12, .low = 0.1, .high = 1e4},
          {.name = "patience", .about = "seconds for a solver of the table", .value = 3600, .low = 1, .high = 1e6}}};
  return examples::guarded(program.name, [&] {
    const auto options = examples::parse(argc, argv, program);
    if (!options) return 0;
    using Any = SolvedStamping<QuasiCoulomb, run_time::Takes::triangle>;
    if (options->list) return examples::print_list<Any, SheetSolvers>(frictions);
    const auto run = [&](const examples::Options& o) {
      return examples::dispatch_element<Any, SheetSolvers>(o, frictions, [&]<class Model>() -> int {
        using Chosen = Stamping<typename Model::Friction, typename Model::LinearSolver, typename Model::Element>;
        if constexpr (std::same_as<typename Model::Element, Bending> && SolverOf<Model>::corrects)
          throw examples::BadOption("--solver: \"" + o.solver + "\" is not offered with --element assumed-strain");
        else
          return stamp<Chosen>(o);
      });
    };
    if (options->parameters.at("solver-table") == 0) return run(*options);
    const auto able = frictions.find("friction", options->friction, []<class Friction>(Named<Friction>) {
      return run_time::solvers_for<Any, SheetSolvers, Friction>();
    });
    return examples::print_solver_table(*options, able, options->parameters.at("memory"),
                                        options->parameters.at("patience"), run);
  });
}
