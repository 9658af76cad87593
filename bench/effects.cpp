// SPDX-License-Identifier: BSL-1.0
// The price of each effect: one scene on one mesh, an effect more from line to line; time of a Newton iteration, as a
// ratio to the leanest. The models take turns, so that a slow spell of the machine hits all alike.
#include <stickslip/linear_solver/banded.hpp>
#include <stickslip/stickslip.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <tuple>
#include <vector>

using namespace stickslip;

struct Lean : QuasistaticDefaults {
  static constexpr const char* name = "elastic, plane strain, no contact";
  using Enforcement = NoContact;
  using LinearSolver = Banded;
};
struct Touching : Lean {
  static constexpr const char* name = "+ contact";
  using Enforcement = Penalty;
};
struct Lagged : Touching {
  static constexpr const char* name = "+ friction, Quasi-Coulomb";
  using Friction = QuasiCoulomb;
};
struct Curved : Lagged {
  static constexpr const char* name = "+ friction, Quasi-Coulomb, on a curved tool";
  static constexpr bool curved = true;
};
struct Exact : Touching {
  static constexpr const char* name = "+ friction, Coulomb by LU";
  using Friction = Coulomb;
};
struct OnFactor : Touching {
  static constexpr const char* name = "+ friction, Coulomb on a symmetric factor";
  using Friction = Coulomb;
  using LinearSolver = Corrected<BandedCholesky>;
};
struct Plastic : Lagged {
  static constexpr const char* name = "Quasi-Coulomb + plasticity, linear hardening";
  using Material = FiniteJ2<LinearHardening>;
};
struct PowerPlastic : Lagged {
  static constexpr const char* name = "Quasi-Coulomb + plasticity, power hardening";
  using Material = FiniteJ2<PowerHardening>;
};
struct Rate : Exact {
  static constexpr const char* name = "Coulomb by LU + hypoelastic plasticity";
  using Material = HypoelasticJ2<LinearHardening>;
};
struct Turned : Plastic {
  static constexpr const char* name = "Quasi-Coulomb + plasticity + axisymmetry";
  using Kinematics = Axisymmetric;
};
struct Moving : Plastic {
  static constexpr const char* name = "Quasi-Coulomb + plasticity + inertia";
  using TimeIntegration = GeneralizedAlpha;
};
using Effects =
    std::tuple<Lean, Touching, Lagged, Curved, Exact, OnFactor, Plastic, PowerPlastic, Rate, Turned, Moving>;

template <class Model>
double microseconds_per_iteration(Index refine) {
  typename Model::Material material{};
  material.young = 68956;
  material.poisson = 0.32;
  if constexpr (requires { material.hardening.modulus; }) material.hardening = {.yield = 31, .modulus = 261.2};
  if constexpr (requires { material.hardening.exponent; })
    material.hardening = {.strength = 100, .offset = 1e-3, .exponent = 0.2};
  typename Problem<Model>::Parameters parameters{
      .body = mesh::rectangle({.origin = {1, 0}, .size = {20, 5}, .cells = {40 * refine, 10 * refine}}),
      .material = material};
  if constexpr (has_inertia<Model>) parameters.density = 2.7e-9;
  if constexpr (has_contact<Model>) {
    Contact<Model> plate{.side = "top",
                         .tool = rigid::line({0, 5}, {-1, 0}),
                         .motion = [](Real t) { return Vec<Real, 2>(0.2 * t, -0.1 * t); },
                         .enforcement = {.normal = 1e5, .tangential = 1e4}};
    if constexpr (requires { Model::curved; }) plate.tool = rigid::path({51, 5.4}, {-1, -0.02}).right(2000, 0.04);
    if constexpr (has_friction<Model>) plate.friction = {.mu = 0.1};
    parameters.contacts = {plate};
  }
  Problem<Model> block(std::move(parameters));
  block.hold("bottom", 0).hold("bottom", 1);
  if constexpr (!has_contact<Model>) block.drive("top", 1, [](Real t) { return -0.1 * t; });
  auto march = block.march({.end = 1, .steps = 10, .tolerance = 1e-9});
  const Outcome& outcome = march.finish();
  if (!outcome) {
    std::fprintf(stderr, "%s: %s\n", Model::name, outcome.message().c_str());
    std::exit(1);
  }
  const Timings& t = march.report().timings;
  return 1e6 * (t.assembly + t.contact + t.factorization + t.solve) / march.report().iterations;
}

int main(int argc, char** argv) {
  const Index refine = argc > 1 ? std::max(1, std::atoi(argv[1])) : 2;
  constexpr std::size_t n = std::tuple_size_v<Effects>;
  std::array<std::vector<double>, n> times;
  for (int round = 0; round < 7; ++round)
    std::apply(
        [&]<class... Models>(const Models&...) {
          std::size_t k = 0;
          (times[k++].push_back(microseconds_per_iteration<Models>(refine)), ...);
        },
        Effects{});
  std::printf(
      "%d elements; microseconds of a Newton iteration, median of 7, and its ratio to the first line's (min-max)\n",
      400 * refine * refine);
  std::apply(
      [&]<class... Models>(const Models&...) {
        std::size_t k = 0;
        const auto print = [&](const char* name, std::size_t bytes) {
          std::vector<double> ratio;
          for (std::size_t i = 0; i < times[k].size(); ++i) ratio.push_back(times[k][i] / times[0][i]);
          std::sort(ratio.begin(), ratio.end());
          std::vector<double> sorted = times[k++];
          std::sort(sorted.begin(), sorted.end());
          std::printf("%-46s %9.0f  %5.2f (%.2f-%.2f)  %3zu bytes a point\n", name, sorted[sorted.size() / 2],
                      ratio[ratio.size() / 2], ratio.front(), ratio.back(), bytes);
        };
        (print(Models::name, Body<Models>::bytes_per_point), ...);
      },
      Effects{});
}
