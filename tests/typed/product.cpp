// SPDX-License-Identifier: BSL-1.0
// The product of all choices: what the contracts admit of it, and what of that runs.
#include "cover.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

namespace typed {

// What the contracts say of every model with a solver of one kind, in the order of mp_product over the other axes. In
// two stages: one list of all models would take gigabytes to compile.
using Bodies = mp_product<mp_list, AllKinematics, Treatments, Materials>;
using Contacts_ = mp_product<mp_list, Bounds, Sources, Enforcements, Inertias>;

template <class Solver, class Body, class Contacts>
struct Verdicts;
template <class Solver, class... B, class... C>
struct Verdicts<Solver, mp_list<B...>, mp_list<C...>> {
  template <class Contact>
  struct With;
  template <class... P>
  struct With<mp_list<P...>> : std::bool_constant<valid_model<Combination<B..., P..., Solver>>> {};
  static constexpr bool all[] = {With<C>::value...};
};
template <Symmetry accepted>
std::vector<bool> judge() {
  std::vector<bool> valid;
  [&]<class... Body>(mp_list<Body...>) {
    using Solver = DeclaredSolver<accepted>;
    (valid.insert(valid.end(), std::begin(Verdicts<Solver, Body, Contacts_>::all),
                  std::end(Verdicts<Solver, Body, Contacts_>::all)),
     ...);
  }(Bodies{});
  return valid;
}

constexpr std::size_t solvers_in_cover = mumps_ldlt;  // those before it; see cover.hpp

// Law and hardening of a material count as two choices.
using Choices = std::array<std::size_t, axes + 1>;
constexpr std::size_t hardenings = 4;
constexpr Choices split(const std::array<std::size_t, axes>& n) {
  const std::size_t material = n[2];
  const bool hard = material >= j2_perfect;
  return {n[0],
          n[1],
          hard ? 2 + (material - j2_perfect) / hardenings : material,
          hard ? 1 + (material - j2_perfect) % hardenings : 0,
          n[3],
          n[4],
          n[5],
          n[6],
          n[7]};
}
// Marks all pairs of a model's choices.
using Pairs = std::set<std::array<std::size_t, 4>>;
void mark(const Choices& c, Pairs& pairs) {
  for (std::size_t a = 0; a < c.size(); ++a)
    for (std::size_t b = a + 1; b < c.size(); ++b) pairs.insert({a, c[a], b, c[b]});
}

/// Calls visit(numbers, valid) for every model of the product.
template <class Visit>
void for_each_model(Visit&& visit) {
  const std::array judged{judge<Symmetry::symmetric>(), judge<Symmetry::general>()};
  for (std::size_t solver = 0; solver < solvers; ++solver) {
    const std::vector<bool>& valid = judged[solver % 2];
    std::size_t k = 0;
    std::array<std::size_t, axes> n{};
    n[7] = solver;
    const auto walk = [&](const auto& self, std::size_t axis) -> void {
      if (axis == 7) return visit(n, valid[k++]);
      for (n[axis] = 0; n[axis] < choices[axis]; ++n[axis]) self(self, axis + 1);
    };
    walk(walk, 0);
    REQUIRE(k == valid.size());
  }
}

TEST_CASE("the contracts admit the expected part of all models, and the covering set covers its pairs") {
  std::set<std::array<std::size_t, axes>> valid;
  Pairs needed, covered;
  std::size_t product = 0, triangles = 0;
  for_each_model([&](const std::array<std::size_t, axes>& n, bool ok) {
    ++product;
    if (!ok) return;
    valid.insert(n);
    if (n[7] < solvers_in_cover) mark(split(n), needed);
    const bool symmetric_solver = n[7] % 2 == 0;
    triangles += symmetric_solver ? 1 : 0;
  });
  CHECK(product == 3 * 3 * 10 * 8 * 4 * 3 * 2 * 10);
  // Friction and enforcement together: of the symmetric ones, without friction 1 with contact and 1 without, 5
  // isotropic bounds that look at the pressure from 3 sources, Tresca's from all 4; general ones are the 5 with the
  // current pressure. The anisotropic bound adds 3 and 1 in space.
  constexpr std::size_t enforcements = 2, plane_symmetric = 1 + enforcements * (1 + 5 * 3 + 4),
                        plane_general = enforcements * 5, space_symmetric = plane_symmetric + enforcements * 3,
                        space_general = plane_general + enforcements * 1;
  constexpr std::size_t symmetric = 2 * plane_symmetric + space_symmetric, general = 2 * plane_general + space_general;
  // Six of the ten materials are symmetric. A symmetric system takes any of the ten solvers, a general one half of
  // them.
  CHECK(valid.size() == 3 * 2 * (6 * (symmetric * 10 + general * 5) + 4 * (symmetric + general) * 5));
  CHECK(triangles == 3 * 2 * 6 * symmetric * 5);

  for (const Row& row : cover) {
    const auto n = row.numbers();
    CHECK(valid.count(n) == 1);
    mark(split(n), covered);
  }
  for (const auto& pair : needed) {  // axis, choice, axis, choice
    INFO("choice " << pair[1] << " of axis " << pair[0] << " with choice " << pair[3] << " of axis " << pair[2]
                   << ": no model runs");
    CHECK(covered.count(pair) == 1);
  }
  MESSAGE(product << " models in the product, " << valid.size() << " valid; " << needed.size()
                  << " pairs of choices, all in the " << cover.size() << " models that run");
}

}  // namespace typed
