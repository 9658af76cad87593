// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"
#include "solvers.hpp"

namespace solvers {

template <class Model>
std::vector<Real> drag() {
  auto p = scene::press_and_drag<Model>(0.2, 0.2, 1);
  auto march = p->march({.end = 1, .steps = 5, .tolerance = 1e-11});
  if (!march.finish()) return {};
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
  return o;
}

}  // namespace solvers
