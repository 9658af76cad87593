// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"
#include "solvers.hpp"

namespace solvers {

template <class Model>
std::vector<Real> drag(Real mu = 0.2, Real stiffening = 1, stickslip::Outcome* end = nullptr) {
  auto p = scene::press_and_drag<Model>(mu, 0.2, 1, {8, 4}, stiffening);
  auto march = p->march({.end = 1, .steps = 5, .smallest = end ? 1e-2 : 0, .tolerance = stiffening > 1 ? 1e-9 : 1e-11});
  (void)march.finish();
  if (end) *end = march.outcome();
  if (!march.outcome()) return {};
  return {p->displacement().begin(), p->displacement().end()};
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
  o.at_most = drag<scene::Model<Solver, QuasiCoulomb>>(0, 1e19, &o.hopeless);
  return o;
}

}  // namespace solvers
