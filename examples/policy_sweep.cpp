// SPDX-License-Identifier: BSL-1.0
//
// A compile-time experiment: a list of models, each run on one scene, one table.
//
// A roller is pressed into a strip of aluminium and drawn along it. The first model is the reference; every other one
// changes what its name says. To add a model, write its type and put it on the list: what the choices mean together,
// whether the tangent is symmetric, what a point has to remember and which solver may be taken, follows.
//
//          (   ) -> then along        Plane strain, lengths in mm, forces in N per mm of depth, stresses in
//     _____(___)_____________         MPa. The strip stands on its bottom.
//    |_______________________|

#include <stickslip/stickslip.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

using namespace stickslip;

// The reference, and what the others inherit from it.
struct Reference : QuasistaticDefaults {
  static constexpr const char* name = "Coulomb, penalty, finite J2";
  using Kinematics = PlaneStrain;
  using Material = FiniteJ2<LinearHardening>;
  using Friction = Coulomb;
};

// The experiment. ------------------------------------------------------------------------------------------------
struct Lagged : Reference {
  static constexpr const char* name = "  pressure of the last step";
  using Friction = QuasiCoulomb;
};
struct Extrapolating : Reference {
  static constexpr const char* name = "  pressure extrapolated";
  using Friction = ExtrapolatedCoulomb;
};
struct Iterated : Reference {
  static constexpr const char* name = "  pressure iterated";
  using Friction = WithPressure<Coulomb, LagIterated>;
};
struct Multipliers : Reference {
  static constexpr const char* name = "  augmented Lagrangian";
  using Enforcement = AugmentedLagrangian;
};
struct SymmetricMultipliers : Multipliers {
  static constexpr const char* name = "  augmented, symmetric";
  using Friction = WithPressure<Coulomb, LagIterated>;
};
struct Capped : Reference {
  static constexpr const char* name = "  capped at the shear yield stress";
  using Friction = CappedCoulomb;
};
struct Smooth : Reference {
  static constexpr const char* name = "  no friction";
  using Friction = Frictionless;
};
struct Rotating : Reference {
  static constexpr const char* name = "  hypoelastic J2";
  using Material = HypoelasticJ2<LinearHardening>;
};
using Sweep =
    std::tuple<Reference, Lagged, Extrapolating, Iterated, Multipliers, SymmetricMultipliers, Capped, Smooth, Rotating>;
// ------------------------------------------------------------------------------------------------------------------

// The numbers of each choice, once for all models that make it.
void set(Coulomb& law) {
  law = {.mu = 0.2};
}
void set(CappedCoulomb& law) {
  law = {.mu = 0.2, .tau_max = 31 / std::sqrt(3.0)};
}
void set(Penalty& penalty) {
  penalty = {.normal = 1e5, .tangential = 1e4};
}
void set(AugmentedLagrangian&) {}  // has nothing to choose
template <class Plastic>
void set(Plastic& material) {
  material.young = 68956;
  material.poisson = 0.32;
  if constexpr (requires { material.hardening; }) material.hardening = {.yield = 31, .modulus = 261.2};
}

struct Row {
  Vec<Real, 2> force = Vec<Real, 2>::Zero();
  RunReport report;
  Outcome outcome;
};

template <class Model>
Row run(Index refine, Index steps) {
  Contact<Model> roller{
      .side = "top",
      .tool = rigid::disc({4, 6}, 3),
      .motion = [](Real t) { return Vec<Real, 2>(4 * std::max(0.0, t - 1), -0.3 * std::min(t, 1.0)); },
      .name = "roller"};
  set(roller.enforcement);
  if constexpr (has_friction<Model>) set(roller.friction);
  typename Model::Material material;
  set(material);
  Problem<Model> strip{{.body = mesh::rectangle({.size = {12, 3}, .cells = {24 * refine, 6 * refine}}),
                        .material = material,
                        .contacts = {roller}}};
  strip.hold("bottom", 0).hold("bottom", 1);
  auto march = strip.march({.end = 2, .steps = steps});
  Row row;
  row.outcome = march.finish();
  row.report = march.report();
  row.force = strip.contact_force("roller");
  return row;
}

template <class Model>
void print(const Row& row, std::optional<Vec<Real, 2>>& reference) {
  if (!row.outcome) {
    std::printf("%-34s %s\n", Model::name, row.outcome.message().c_str());
    return;
  }
  if (!reference) reference = row.force;
  const RunReport& r = row.report;
  const double seconds = r.timings.assembly + r.timings.contact + r.timings.factorization + r.timings.solve;
  std::printf("%-34s %9.2f %9.2f %8.2f %6d %6d %6d %9.1f %-9s %5zu %5zu\n", Model::name, row.force[0], row.force[1],
              100 * (row.force - *reference).norm() / reference->norm(), r.steps, r.iterations, r.outer_iterations,
              1e3 * seconds, system_symmetry<Model> == Symmetry::symmetric ? "symmetric" : "general",
              Body<Model>::bytes_per_point, ContactPair<Model>::bytes_per_node);
}

int main(int argc, char** argv) {
  Index refine = 1, steps = 100;
  for (int i = 1; i < argc; i += 2) {
    const bool known = !std::strcmp(argv[i], "--refine") || !std::strcmp(argv[i], "--steps");
    char* end = nullptr;
    const long value = known && i + 1 < argc ? std::strtol(argv[i + 1], &end, 10) : 0;
    if (!known || value < 1 || value > 100000 || *end != '\0') {
      std::fprintf(
          std::strcmp(argv[i], "--help") ? stderr : stdout,
          "usage: policy_sweep [--refine N] [--steps N]\n"
          "Runs one scene with every model of a list and prints a table. --refine divides the elements N times "
          "in each\ndirection, --steps takes N equal steps (100).\n");
      return std::strcmp(argv[i], "--help") ? 2 : 0;
    }
    (std::strcmp(argv[i], "--refine") ? steps : refine) = static_cast<Index>(value);
  }
  std::printf(
      "A roller pressed into a strip by 0.3 mm and drawn along by 4 mm; force on the roller at the end.\n"
      "difference: from the first model's; time: of assembly, contact and solution; history: bytes of a point of "
      "the body\nand of a contact node.\n\n%-34s %9s %9s %8s %6s %6s %6s %9s %-9s %5s %5s\n",
      "model", "along/N", "up/N", "diff./%", "steps", "iter.", "passes", "time/ms", "tangent", "point", "node");
  std::optional<Vec<Real, 2>> reference;
  bool all = true;
  std::apply(
      [&]<class... Models>(const Models&...) {
        (([&] {
           const Row row = run<Models>(refine, steps);
           all = all && row.outcome;
           print<Models>(row, reference);
         }()),
         ...);
      },
      Sweep{});
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {  // a disc that is full, say
    std::fprintf(stderr, "policy_sweep: the table could not be written\n");
    return 1;
  }
  return all ? 0 : 1;
}
