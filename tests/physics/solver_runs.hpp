// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"
#include "solvers.hpp"

#include <cmath>

namespace solvers {

template <class Model>
std::vector<Real> drag(Real mu = 0.2, Real stiffening = 1) {
  auto p = scene::press_and_drag<Model>(mu, 0.2, 1, {8, 4}, stiffening);
  if (!p->march({.end = 1, .steps = 5, .tolerance = stiffening > 1 ? 1e-9 : 1e-11}).finish()) return {};
  return {p->displacement().begin(), p->displacement().end()};
}
template <class Model>
Stiff stiff_drag(Real mu, Real stiffening, Real sticking, unsigned seed) {
  auto p = scene::press_and_drag<Model>(mu, 0.2, 1, {8, 4}, stiffening, sticking, seed);
  auto march = p->march({.end = 1, .steps = 5, .smallest = 1e-2, .tolerance = 1e-8});
  (void)march.finish();
  const auto force = p->contact_force("tool");
  return {march.outcome(), {p->displacement().begin(), p->displacement().end()}, {force[0], force[1]}};
}
template <class Solver>
Outcome outcome() {
  Outcome o;
  if constexpr (Solver::accepts == Symmetry::general) o.coulomb = drag<scene::Model<Solver, Coulomb>>();
  o.quasi = drag<scene::Model<Solver, QuasiCoulomb>>();
  o.positive = answer<Solver>(positive);
  o.indefinite = answer<Solver>(indefinite);
  o.singular = answer<Solver>(singular);
  o.again = answer_again<Solver>();
  for (const Matrix& m : doubtful) o.judged.push_back(answer<Solver>(m));
  o.stiff = drag<scene::Model<Solver, QuasiCoulomb>>(0, 1e9);
  using Quasi = scene::Model<Solver, QuasiCoulomb>;
  for (unsigned seed = 0; seed <= 10; ++seed) {
    const Real times = seed == 0 ? 1e9 : std::pow(1e2, 6 + seed % 5);
    o.normal.push_back(stiff_drag<Quasi>(0, times, times, seed));
    o.sliding.push_back(stiff_drag<Quasi>(0.2, times, 1e4, seed));
    o.sticking.push_back(stiff_drag<Quasi>(0.5, 1e3, std::pow(10, seed == 0 ? 7 : 8 + 1.2 * seed), seed));
  }
  return o;
}

}  // namespace solvers
