// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>
#include <stickslip/base/want.hpp>

namespace stickslip {

/// One evaluation of all terms of a system, and where they add their tangent. Forces go to a field of the term's kind.
template <class Matrix_, class Couplings_>
struct Evaluation {
  using Matrix = Matrix_;
  const Field& u;  ///< nodal displacements [length]
  Real time = 0, dt = 0;
  Want want = Want::tangent;
  const Field* driven = nullptr;      ///< increments still to come: the forces are then those to first order after them
  bool again = false;                 ///< at the iterate of the last evaluation, to have the tangent as well
  Field* constraint_force = nullptr;  ///< within an iteration, at the condensed unknowns: takes their constraint forces
  Matrix& matrix;
  Couplings_& couplings;       ///< of sliding nodes, where they are stored apart from the matrix
  Real inertia_stiffness = 0;  ///< that inertia adds to the matrix at most, in parts of contact's share of it
};

}  // namespace stickslip
