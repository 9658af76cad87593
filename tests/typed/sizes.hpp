// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "axes.hpp"

#include <stickslip/solve/system.hpp>

namespace typed {

/// Numbers that a quadrature point remembers, by the laws: Cp^-1 and p; F^-1, tau and p.
constexpr std::size_t numbers_per_point(std::size_t material, int dim) {
  const std::size_t symmetric = dim == 3 ? 6 : 4, full = dim == 3 ? 9 : 5;
  return material < j2_perfect ? 0 : material < hypo_perfect ? symmetric + 1 : full + symmetric + 1;
}
/// Numbers that a contact node remembers: friction force, place and slid distance, what the source needs of a pressure
/// that the bound looks at, a multiplier.
constexpr std::size_t numbers_per_node(std::size_t bound, std::size_t source, std::size_t enforcement, int dim) {
  const std::size_t places = dim == 3 ? 3 : 1, friction = bound == smooth ? 0 : 2 * places + 1,
                    pressure = bound == smooth || bound == tresca || source == current ? 0
                               : source == ahead                                       ? 2
                                                                                       : 1;
  return friction + pressure + (enforcement == augmented ? 1 : 0);
}

/// An effect that the model does not call for is of no size, any other of the size that its theory says.
template <class Model, std::size_t material, std::size_t bound, std::size_t source, std::size_t enforcement>
constexpr void check_sizes() {
  constexpr int dim = Model::Kinematics::dim;
  static_assert(Body<Model>::bytes_per_point == numbers_per_point(material, dim) * sizeof(Real));
  static_assert(History<std::array<typename Body<Model>::State, Model::Element::points>,
                        !std::is_empty_v<typename Body<Model>::State>>::stored ==
                (numbers_per_point(material, dim) > 0));
  static_assert(SolverOf<Model>::accepts == Symmetry::general || system_symmetry<Model> == Symmetry::symmetric);
  static_assert(matrix_storage<Model> == Symmetry::general ||
                (system_symmetry<Model> == Symmetry::symmetric && SolverOf<Model>::storage == Symmetry::symmetric));
  static_assert(std::is_same_v<typename System<Model>::Matrix, SparseMatrix<matrix_storage<Model>>>);
  static_assert(std::is_empty_v<typename System<Model>::Pairs> == !has_contact<Model>);
  static_assert(std::is_empty_v<typename System<Model>::Inertia> == !has_inertia<Model>);
  if constexpr (has_contact<Model>) {
    constexpr auto numbers = [](std::size_t which) {
      return numbers_per_node(which, source, enforcement, dim) * sizeof(Real);
    };
    if constexpr (bound == by_pair) {
      using Rubbing = typename FrictionOf<Coulomb, boost::mp11::mp_at_c<Sources, source>>::type;
      static_assert(ContactPair<Model, Rubbing>::bytes_per_node == numbers(coulomb));
      static_assert(ContactPair<Model, Frictionless>::bytes_per_node == numbers(smooth));
    } else {
      using Pair = ContactPair<Model>;
      static_assert(Pair::bytes_per_node == numbers(bound));
      static_assert(Pair::takes_area == (bound == capped || bound == tresca));
      static_assert(Pair::outer_iterations == (enforcement == augmented || (source == iterated && bound != tresca)));
      static_assert(std::is_empty_v<decltype(Contact<Model>::friction)> == (bound == smooth));
    }
  }
}

}  // namespace typed
