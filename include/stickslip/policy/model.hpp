// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/policy/damping.hpp>
#include <stickslip/policy/element.hpp>
#include <stickslip/policy/enforcement.hpp>
#include <stickslip/policy/friction.hpp>
#include <stickslip/policy/kinematics.hpp>
#include <stickslip/policy/linear_solver.hpp>
#include <stickslip/policy/material.hpp>
#include <stickslip/policy/surfaces.hpp>
#include <stickslip/policy/time_integration.hpp>

#include <tuple>

namespace stickslip {

/// The types of bodies of a model with several: `using Bodies = BodyTypes<Blank, Die>;`, each type with an Element and
/// a Material. A model without `Bodies` has one body, of its own Element and Material.
template <class... Types>
struct BodyTypes {};

namespace detail {
template <class Model>
concept NamesBodies = requires {
  typename Model::Bodies;
};
template <class Model>
struct BodyTypesIn {
  using type = BodyTypes<Model>;
};
template <NamesBodies Model>
struct BodyTypesIn<Model> {
  using type = typename Model::Bodies;
};
template <class Type>
concept HasSoundElement = ElementPolicy<typename Type::Element>;
template <class Type, class TensorPattern>
concept HasSoundMaterial = MaterialPolicy<typename Type::Material, TensorPattern>;
template <class List>
inline constexpr bool sound_elements = false;
template <class... Types>
inline constexpr bool sound_elements<BodyTypes<Types...>> = sizeof...(Types) > 0 && (HasSoundElement<Types> && ...);
template <class List, int dim>
inline constexpr bool same_dimension = false;
template <class... Types, int dim>
inline constexpr bool same_dimension<BodyTypes<Types...>, dim> = ((Types::Element::dim == dim) && ...);
template <class List, class TensorPattern>
inline constexpr bool sound_materials = false;
template <class... Types, class TensorPattern>
inline constexpr bool sound_materials<BodyTypes<Types...>, TensorPattern> = (HasSoundMaterial<Types, TensorPattern> &&
                                                                             ...);
template <class... Types>
constexpr Symmetry material_symmetry(BodyTypes<Types...>) {
  Symmetry s = Symmetry::symmetric;
  ((s = widest(s, Types::Material::symmetry)), ...);
  return s;
}
}  // namespace detail

/// The types of the bodies of a model: those that it names, or itself.
template <class Model>
using BodyTypesOf = typename detail::BodyTypesIn<Model>::type;

/// Symmetry of the bodies: the widest over their materials.
template <class Model>
inline constexpr Symmetry bodies_symmetry = detail::material_symmetry(BodyTypesOf<Model>{});

/// The types of a user's own terms in the balance: `using Terms = TermTypes<Mine>;` (dofs/term.hpp).
template <class... Types>
struct TermTypes {};

namespace detail {
template <class Model>
struct TermTypesIn {
  using type = TermTypes<>;
};
template <class Model>
  requires requires {
    typename Model::Terms;
  }
struct TermTypesIn<Model> {
  using type = typename Model::Terms;
};
template <class List>
struct TermTuple;
template <class... Types>
struct TermTuple<TermTypes<Types...>> {
  using type = std::tuple<Types...>;
};
template <class... Types>
constexpr Symmetry terms_symmetry(TermTypes<Types...>) {
  Symmetry s = Symmetry::symmetric;
  ((s = widest(s, Types::symmetry)), ...);
  return s;
}
}  // namespace detail

/// The terms of a model, a tuple: empty where it names none.
template <class Model>
using TermsOf = typename detail::TermTuple<typename detail::TermTypesIn<Model>::type>::type;

/// True when the model has contact at all.
template <class Model>
inline constexpr bool has_contact = Model::Enforcement::active;

namespace detail {
template <class Model>
struct SurfacesNamedBy {
  using type = NoSurfaceContact;
};
template <class Model>
  requires requires {
    typename Model::Surfaces;
  }
struct SurfacesNamedBy<Model> {
  using type = typename Model::Surfaces;
};
}  // namespace detail

/// The contact between surfaces of bodies in the model: `NoSurfaceContact` where it names none.
template <class Model>
using SurfacesOf = typename detail::SurfacesNamedBy<Model>::type;

/// True when the bodies of the model touch each other, or themselves.
template <class Model>
inline constexpr bool has_surfaces = SurfacesOf<Model>::active;

namespace detail {
template <class OfTools, class Surfaces, bool active = Surfaces::active>
struct AllFrictions {
  using type = OfTools;
};
template <class OfTools, class Surfaces>
struct AllFrictions<OfTools, Surfaces, true> {
  using type = PerContact<OfTools, typename Surfaces::Friction>;
};
template <class... OfTools, class Surfaces>
struct AllFrictions<PerContact<OfTools...>, Surfaces, true> {
  using type = PerContact<OfTools..., typename Surfaces::Friction>;
};
}  // namespace detail

/// The friction of all contacts of a model, with tools and between surfaces.
template <class Model>
using FrictionsOf = typename detail::AllFrictions<typename Model::Friction, SurfacesOf<Model>>::type;

/// True when the model has friction.
template <class Model>
inline constexpr bool has_friction = has_contact<Model>&& FrictionsOf<Model>::active;

/// True when a step takes several outer iterations: multipliers, or a bound that is brought up to date.
template <class Model>
constexpr bool has_outer_iterations() {
  if constexpr (has_friction<Model>)
    return is_augmented<typename Model::Enforcement> || friction_is_iterated<FrictionsOf<Model>>;
  else if constexpr (has_contact<Model>)
    return is_augmented<typename Model::Enforcement>;
  else
    return false;
}

/// True when a bound lags behind the pressure and can be probed.
template <class Model>
constexpr bool has_lag() {
  if constexpr (has_friction<Model>)
    return friction_lags<FrictionsOf<Model>>;
  else
    return false;
}

/// True when the matrix is only near the residual's derivative: what it lacks Newton's method must find out.
template <class Model>
constexpr bool has_inexact_tangent() {
  if constexpr (has_friction<Model>)
    return friction_is_symmetrised<FrictionsOf<Model>>;
  else
    return false;
}

/// True when the model has inertia.
template <class Model>
inline constexpr bool has_inertia = Model::TimeIntegration::active;

namespace detail {
template <class Model>
struct DampingNamedBy {
  using type = Undamped;
};
template <class Model>
  requires requires {
    typename Model::Damping;
  }
struct DampingNamedBy<Model> {
  using type = typename Model::Damping;
};
}  // namespace detail

/// The damping of the model: `Undamped` where it names none.
template <class Model>
using DampingOf = typename detail::DampingNamedBy<Model>::type;

/// True when the model has damping.
template <class Model>
inline constexpr bool has_damping = DampingOf<Model>::active;

/// Symmetry of the normal contact.
template <class Model>
constexpr Symmetry enforcement_symmetry() {
  if constexpr (has_contact<Model>)
    return Model::Enforcement::symmetry;
  else
    return Symmetry::symmetric;
}

/// Symmetry of the contact terms: enforcement, friction bound and pressure source together.
template <class Model>
constexpr Symmetry contact_symmetry() {
  if constexpr (!has_contact<Model>)
    return Symmetry::symmetric;
  else
    return widest(enforcement_symmetry<Model>(), friction_symmetry<FrictionsOf<Model>>());
}

/// Symmetry of the whole system: the widest over all policies.
template <class Model>
inline constexpr Symmetry system_symmetry =
    widest(widest(bodies_symmetry<Model>, detail::terms_symmetry(typename detail::TermTypesIn<Model>::type{})),
           contact_symmetry<Model>());

/// Symmetry of all but friction.
template <class Model>
inline constexpr Symmetry smooth_symmetry =
    widest(widest(bodies_symmetry<Model>, detail::terms_symmetry(typename detail::TermTypesIn<Model>::type{})),
           enforcement_symmetry<Model>());

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

/// The solver that serves the model: the one it names, or the member of the family it names.
template <class Model>
using SolverOf = typename detail::SolverFor<typename Model::LinearSolver, system_symmetry<Model>>::type;

/// What that is made from.
template <class Model>
using SolverParametersOf = SolverParameters<SolverOf<Model>>;

/// Triangle or full matrix: symmetric systems keep their lower triangle unless the solver wants all of it; general ones
/// only for a solver that takes what the triangle lacks apart, which contact and friction can tell and a material
/// cannot.
template <class Model>
inline constexpr Symmetry matrix_storage = (accepts_couplings<SolverOf<Model>> &&
                                            smooth_symmetry<Model> == Symmetry::symmetric)
                                               ? SolverOf<Model>::storage
                                               : widest(system_symmetry<Model>, SolverOf<Model>::storage);

/// True when the matrix is stored as a triangle and the couplings of sliding nodes apart.
template <class Model>
inline constexpr bool stores_couplings = (system_symmetry<Model> == Symmetry::general) &&
                                         (matrix_storage<Model> == Symmetry::symmetric);

namespace detail {
// A solver by its storage alone.
template <Symmetry storage_>
struct StorageOnly {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = storage_;
  static constexpr bool corrects = storage_ == Symmetry::symmetric;
  void analyze(const SparseView&);
  Factorization factorize(const SparseView&);
  bool solve(const Real*, Real*);
};
// A type of body by its parts, so that models that name them differently are one.
template <class Element_, class Material_>
struct BodyType {
  using Element = Element_;
  using Material = Material_;
};
template <class Type>
struct BodiesOfMechanics {
  using Element = typename Type::Element;
  using Material = typename Type::Material;
};
template <class... Types>
struct BodiesOfMechanics<BodyTypes<Types...>> {
  using Bodies = BodyTypes<Types...>;
};
template <class Model>
struct BodiesIn {
  using type = BodyType<typename Model::Element, typename Model::Material>;
};
template <class List>
struct PlainBodies;
template <class... Types>
struct PlainBodies<BodyTypes<Types...>> {
  using type = BodyTypes<BodyType<typename Types::Element, typename Types::Material>...>;
};
template <NamesBodies Model>
struct BodiesIn<Model> : PlainBodies<typename Model::Bodies> {};
template <class T>
struct NamedTool {
  using Tool = T;
};
template <>
struct NamedTool<void> {};
template <class Model>
struct ToolNameOf {
  using type = void;
};
template <class Model>
  requires requires {
    typename Model::Tool;
  }
struct ToolNameOf<Model> {
  using type = typename Model::Tool;
};
}  // namespace detail

/// A model but for its solver, of which only the storage of the matrix is left: what the body, the contacts and the
/// balance are made of. Models that differ in the solver alone share it, and the compiler's work with it.
template <class Kinematics_, class Bodies_, class Friction_, class Surfaces_, class Enforcement_, class Inertia_,
          class Damping_, class Tool_, class Terms_, Symmetry storage>
struct Mechanics : detail::NamedTool<Tool_>, detail::BodiesOfMechanics<Bodies_> {
  using Kinematics = Kinematics_;
  using Friction = Friction_;
  using Surfaces = Surfaces_;
  using Enforcement = Enforcement_;
  using TimeIntegration = Inertia_;
  using Damping = Damping_;
  using Terms = Terms_;
  using LinearSolver = detail::StorageOnly<storage>;
};
template <class Model>
using MechanicsOf =
    Mechanics<typename Model::Kinematics, typename detail::BodiesIn<Model>::type, typename Model::Friction,
              SurfacesOf<Model>, typename Model::Enforcement, typename Model::TimeIntegration, DampingOf<Model>,
              typename detail::ToolNameOf<Model>::type, typename detail::TermTypesIn<Model>::type,
              matrix_storage<Model>>;

/// The rules of a model, a concept each. A rule that combines policies holds while one of them breaks its own
/// contract: one mistake gives one sentence.
namespace rule {
template <class Model>
concept Kinematics = KinematicsPolicy<typename Model::Kinematics>;
template <class Model>
concept Element = detail::sound_elements<BodyTypesOf<Model>>;
template <class Model>
concept SameDimension =
    !Kinematics<Model> || !Element<Model> || detail::same_dimension<BodyTypesOf<Model>, Model::Kinematics::dim>;
template <class Model>
concept Material =
    !Kinematics<Model> || detail::sound_materials<BodyTypesOf<Model>, typename Model::Kinematics::TensorPattern>;
template <class Model>
concept Friction = FrictionPolicy<typename Model::Friction>;
template <class Model>
concept Enforcement = EnforcementPolicy<typename Model::Enforcement>;
template <class Model>
concept FrictionNeedsContact =
    !Friction<Model> || !Enforcement<Model> || Model::Enforcement::active || !Model::Friction::active;
template <class Model>
concept DirectionsNeedSpace = !Kinematics<Model> || !Friction<Model> || Model::Kinematics::dim == 3 ||
                              !friction_is_anisotropic<FrictionsOf<Model>>;
template <class Model>
concept Surfaces = SurfacesPolicy<SurfacesOf<Model>>;
template <class Model>
concept SurfacesNeedContact =
    !Surfaces<Model> || !Enforcement<Model> || Model::Enforcement::active || !SurfacesOf<Model>::active;
template <class Model>
concept SurfacesInThePlane =
    !Kinematics<Model> || !Surfaces<Model> || Model::Kinematics::dim == 2 || !SurfacesOf<Model>::active;
template <class Model>
concept TimeIntegration = TimeIntegrationPolicy<typename Model::TimeIntegration>;
template <class Model>
concept Damping = DampingPolicy<DampingOf<Model>>;
template <class Model>
concept DampingNeedsInertia =
    !TimeIntegration<Model> || !Damping<Model> || Model::TimeIntegration::active || !DampingOf<Model>::active;
template <class Model>
concept HasSymmetry = Kinematics<Model> && Material<Model> && Friction<Model> && Surfaces<Model> && Enforcement<Model>;
template <class Model>
concept LinearSolver = !HasSymmetry<Model> || LinearSolverPolicy<SolverOf<Model>>;
template <class Model>
concept SolverAcceptsSystem =
    !HasSymmetry<Model> || !LinearSolver<Model> || system_symmetry<Model> == Symmetry::symmetric ||
    SolverOf<Model>::accepts == Symmetry::general;
template <class Model>
concept CorrectsCouplings = !HasSymmetry<Model> || !LinearSolver<Model> || !accepts_couplings<SolverOf<Model>> ||
                            smooth_symmetry<Model> == Symmetry::symmetric;
}  // namespace rule

/// True for a model that meets every rule.
template <class Model>
inline constexpr bool valid_model =
    rule::Kinematics<Model>&& rule::Element<Model>&& rule::SameDimension<Model>&& rule::Material<Model>&&
        rule::Friction<Model>&& rule::Enforcement<Model>&& rule::FrictionNeedsContact<Model>&& rule::Surfaces<Model>&&
            rule::SurfacesNeedContact<Model>&& rule::SurfacesInThePlane<Model>&& rule::DirectionsNeedSpace<Model>&&
                rule::TimeIntegration<Model>&& rule::Damping<Model>&& rule::DampingNeedsInertia<Model>&&
                    rule::LinearSolver<Model>&& rule::SolverAcceptsSystem<Model>&& rule::CorrectsCouplings<Model>;

/// Instantiate to have a model checked, one sentence for each rule.
template <class Model>
struct CheckModel {
  static_assert(
      rule::Kinematics<Model>,
      "stickslip: the model's Kinematics does not meet KinematicsPolicy; see docs/policies.md, section Kinematics.");
  static_assert(rule::Element<Model>,
                "stickslip: the model's Element does not meet ElementPolicy; see docs/policies.md, section Element.");
  static_assert(
      rule::SameDimension<Model>,
      "stickslip: Element and Kinematics differ in dimension; choose an element of the kinematics' dimension.");
  static_assert(
      rule::Material<Model>,
      "stickslip: the model's Material does not meet MaterialPolicy; see docs/policies.md, section Material.");
  static_assert(
      rule::Friction<Model>,
      "stickslip: the model's Friction does not meet FrictionPolicy; see docs/policies.md, section Friction.");
  static_assert(rule::Enforcement<Model>,
                "stickslip: the model's Enforcement does not meet EnforcementPolicy; see docs/policies.md, section "
                "Enforcement.");
  static_assert(rule::FrictionNeedsContact<Model>,
                "stickslip: the model has Friction but no contact to rub at; set Enforcement (Penalty) or make "
                "Friction Frictionless.");
  static_assert(rule::DirectionsNeedSpace<Model>,
                "stickslip: the model's Friction depends on the direction, and a section has but one; set Kinematics "
                "to ThreeDimensional or take an isotropic law.");
  static_assert(rule::Surfaces<Model>,
                "stickslip: the model's Surfaces does not meet SurfacesPolicy; see docs/policies.md, section Surface "
                "contact.");
  static_assert(rule::SurfacesNeedContact<Model>,
                "stickslip: the model has Surfaces but no Enforcement for them; set Enforcement (Penalty) or leave "
                "Surfaces out.");
  static_assert(rule::SurfacesInThePlane<Model>,
                "stickslip: the model has Surfaces in three dimensions, which is not there yet; set Kinematics to "
                "PlaneStrain or Axisymmetric.");
  static_assert(rule::TimeIntegration<Model>,
                "stickslip: the model's TimeIntegration does not meet TimeIntegrationPolicy; see docs/policies.md, "
                "section Time integration.");
  static_assert(rule::Damping<Model>,
                "stickslip: the model's Damping does not meet DampingPolicy; see docs/policies.md, section Damping.");
  static_assert(rule::DampingNeedsInertia<Model>,
                "stickslip: the model has Damping but no inertia, so that nothing vibrates; set TimeIntegration to "
                "GeneralizedAlpha or leave Damping out.");
  static_assert(rule::LinearSolver<Model>,
                "stickslip: the model's LinearSolver does not meet LinearSolverPolicy; see docs/policies.md, section "
                "Linear solver.");
  static_assert(
      rule::SolverAcceptsSystem<Model>,
      "stickslip: the model's LinearSolver takes symmetric systems only, but Friction with the current pressure (or "
      "the "
      "Material) makes the tangent non-symmetric; take Quasi<...> friction, or a general solver such as EigenLu.");
  static_assert(
      rule::CorrectsCouplings<Model>,
      "stickslip: the model's LinearSolver corrects a symmetric factor for sliding nodes, but the Material or "
      "the Enforcement is not symmetric either; take a general solver such as EigenLu.");
  static constexpr bool ok = true;
};

}  // namespace stickslip
