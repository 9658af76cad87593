// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/element.hpp>
#include <stickslip/policy/enforcement.hpp>
#include <stickslip/policy/friction.hpp>
#include <stickslip/policy/inertia.hpp>
#include <stickslip/policy/kinematics.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/policy/material.hpp>

namespace stickslip {

/// True when the bundle has contact at all.
template <class Model>
inline constexpr bool has_contact = Model::Enforcement::active;

/// True when the bundle has friction.
template <class Model>
inline constexpr bool has_friction = has_contact<Model>&& Model::Friction::active;

/// Symmetry of the contact terms: enforcement, friction bound and pressure source together.
template <class Model>
constexpr Symmetry contact_symmetry() {
  if constexpr (!has_contact<Model>)
    return Symmetry::symmetric;
  else
    return widest(Model::Enforcement::symmetry, friction_symmetry<typename Model::Friction>());
}

/// Symmetry of the whole system: the widest over all policies.
template <class Model>
inline constexpr Symmetry system_symmetry = widest(Model::Material::symmetry, contact_symmetry<Model>());

namespace detail {
template <class Solver, Symmetry system>
struct SolverFor {
  using type = Solver;
};
template <LinearSolverFamily Solver, Symmetry system>
struct SolverFor<Solver, system> {
  using type = typename Solver::template For<system>;
};
}  // namespace detail

/// The solver that serves the bundle: the one it names, or the member of the family it names.
template <class Model>
using SolverOf = typename detail::SolverFor<typename Model::LinearSolver, system_symmetry<Model>>::type;

/// Triangle or full matrix: symmetric systems keep their lower triangle unless the solver wants all of it.
template <class Model>
inline constexpr Symmetry matrix_storage = widest(system_symmetry<Model>, SolverOf<Model>::storage);

/// Instantiate to have a bundle checked, one sentence for each rule.
template <class Model>
struct CheckModel {
  static_assert(KinematicsPolicy<typename Model::Kinematics>,
                "stickslip: the bundle's Kinematics does not meet KinematicsPolicy; see docs/policies.md, section Kinematics.");
  static_assert(ElementPolicy<typename Model::Element>,
                "stickslip: the bundle's Element does not meet ElementPolicy; see docs/policies.md, section Element.");
  static_assert(Model::Element::dim == Model::Kinematics::dim,
                "stickslip: Element and Kinematics differ in dimension; choose an element of the kinematics' dimension.");
  static_assert(MaterialPolicy<typename Model::Material, typename Model::Kinematics::Shape>,
                "stickslip: the bundle's Material does not meet MaterialPolicy; see docs/policies.md, section Material.");
  static_assert(FrictionPolicy<typename Model::Friction>,
                "stickslip: the bundle's Friction does not meet FrictionPolicy; see docs/policies.md, section Friction.");
  static_assert(EnforcementPolicy<typename Model::Enforcement>,
                "stickslip: the bundle's Enforcement does not meet EnforcementPolicy; see docs/policies.md, section Enforcement.");
  static_assert(has_contact<Model> || !Model::Friction::active,
                "stickslip: the bundle has Friction but no contact to rub at; set Enforcement (Penalty) or make Friction Frictionless.");
  static_assert(InertiaPolicy<typename Model::Inertia>,
                "stickslip: the bundle's Inertia does not meet InertiaPolicy; see docs/policies.md, section Inertia.");
  static_assert(LinearSolverPolicy<SolverOf<Model>>,
                "stickslip: the bundle's LinearSolver does not meet LinearSolverPolicy; see docs/policies.md, section Linear solver.");
  static_assert(system_symmetry<Model> == Symmetry::symmetric || SolverOf<Model>::accepts == Symmetry::general,
                "stickslip: the bundle's LinearSolver takes symmetric systems only, but Friction with the current pressure (or the "
                "Material) makes the tangent non-symmetric; take Quasi<...> friction, or a general solver such as EigenLu.");
  static constexpr bool ok = true;
};

}  // namespace stickslip
