// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "cover.hpp"
#include "sizes.hpp"

#include <stickslip/problem.hpp>

#include <string>
#include <type_traits>
#include <vector>

namespace typed {

/// What the model says of itself.
struct Facts {
  int dim;
  bool hoop, contact, friction, wall, augmented, follows, outer_iterations, plastic, inertia;
  Symmetry material, system, storage;
};
/// One step of a run; vectors of the plane have a third component of zero.
struct Step {
  StepReport report;
  Vec<Real, 3> rubbing, wall;  // forces of the body on the tools
  Vec<Real, 3> supports;       // of the supports on the body
  Vec<Real, 3> momentum;       // rate of change
};
struct Answer {
  Outcome outcome;
  std::vector<Step> steps;
  Index rejected = 0;
  Field u;
  Real asymmetry = 0;  // largest of the steps' matrices, over the largest entry; of a triangle 0
  Real plastic_strain = 0;
};

// What needs no template, compiled once.
Mesh<2, 4> block(std::integral_constant<int, 2>);
Mesh<3, 8> block(std::integral_constant<int, 3>);
rigid::Tool<2> flat(std::integral_constant<int, 2>);
rigid::Tool<3> flat(std::integral_constant<int, 3>);
rigid::Tool<2> wall(std::integral_constant<int, 2>);
rigid::Tool<3> wall(std::integral_constant<int, 3>);
rigid::Motion<2> press_and_drag(std::integral_constant<int, 2>);
rigid::Motion<3> press_and_drag(std::integral_constant<int, 3>);
/// The same motion of a side, by component.
std::function<Real(Real)> component(Index i);
void give(Hencky& m);
void give(NeoHookean& m);
void give(PerfectPlasticity& h);
void give(LinearHardening& h);
void give(SwiftHardening& h);
void give(VoceHardening& h);
void give(Coulomb& f);
void give(CappedCoulomb& f);
void give(Tresca& f);
void give(SlipWeakeningCoulomb& f);
void give(Stribeck& f);
void give(AnisotropicCoulomb& f);
void give(Penalty& e);
void give(AugmentedLagrangian& e);
template <class Material>
constexpr bool is_plastic = requires(Material m) {
  m.hardening;
};
template <class J2>
  requires is_plastic<J2>
void give(J2& m) {
  m.young = 1000;
  m.poisson = 0.3;
  give(m.hardening);
}

Vec<Real, 3> in_space(const Vec<Real, 2>& v);
Vec<Real, 3> in_space(const Vec<Real, 3>& v);
/// Sum over the nodes.
Vec<Real, 3> total(const Field& field, int dim);
Field between(const Field& from, const Field& to, Real weight);
Real asymmetry(const SparseView& matrix);
/// What holds for every model, and for two that differ in the solver alone.
void check(const Row& row, const Facts& facts, const Answer& answer);

template <class Model, class Friction>
Contact<Model, Friction> rubbing() {
  constexpr std::integral_constant<int, Model::Kinematics::dim> dim{};
  Contact<Model, Friction> contact{.side = "top", .tool = flat(dim), .motion = press_and_drag(dim), .name = "rubbing"};
  give(contact.enforcement);
  if constexpr (Friction::active) give(contact.friction);
  return contact;
}
template <class M, class Friction>
void add_contacts(std::type_identity<Friction>, std::vector<Contact<M, Friction>>& contacts) {
  contacts.push_back(rubbing<M, Friction>());
}
template <class M, class First, class Second>
void add_contacts(std::type_identity<PerContact<First, Second>>,
                  std::tuple<std::vector<Contact<M, First>>, std::vector<Contact<M, Second>>>& contacts) {
  std::get<0>(contacts).push_back(rubbing<M, First>());
  Contact<M, Second> aside{
      .side = "right", .tool = wall(std::integral_constant<int, M::Kinematics::dim>{}), .name = "wall"};
  give(aside.enforcement);
  std::get<1>(contacts).push_back(std::move(aside));
}

/// Presses a flat tool on a block in one step and drags it along in two more; without tools the block's top does so.
template <class Model>
Answer press_and_drag() {
  constexpr int dim = Model::Kinematics::dim;
  constexpr bool with_wall = requires {
    Model::Friction::per_contact;
  };
  typename Problem<Model>::Parameters parameters{.body = block(std::integral_constant<int, dim>{})};
  give(parameters.material);
  if constexpr (has_inertia<Model>) parameters.density = 20;
  if constexpr (has_contact<Model>)
    add_contacts<Model>(std::type_identity<typename Model::Friction>{}, parameters.contacts);
  Problem<Model> problem(std::move(parameters));
  for (Index i = 0; i < dim; ++i) {
    problem.hold("bottom", i);
    if constexpr (!has_contact<Model>) problem.drive("top", i, component(i));
  }
  Answer answer;
  auto march = problem.march({.end = 3, .steps = 3, .tolerance = 1e-11});
  Field acceleration;
  if constexpr (has_inertia<Model>) {
    acceleration = problem.inertia().acceleration();
  }
  for (const StepReport& report : march) {
    Step& step = answer.steps.emplace_back();
    step.report = report;
    step.rubbing = step.wall = step.supports = step.momentum = Vec<Real, 3>::Zero();
    if constexpr (has_contact<Model>) step.rubbing = in_space(problem.contact_force("rubbing"));
    if constexpr (with_wall) step.wall = in_space(problem.contact_force("wall"));
    for (Index i = 0; i < dim; ++i)
      step.supports[i] = problem.reaction("bottom", i) + (has_contact<Model> ? 0 : problem.reaction("top", i));
    answer.asymmetry = std::max(answer.asymmetry, asymmetry(problem.system().tangent().stored));
    if constexpr (has_inertia<Model>) {
      Field force = Field::Zero(acceleration.size());
      problem.inertia().add_product(
          between(acceleration, problem.inertia().acceleration(), 1 - problem.inertia().scheme().alpha_m), force);
      acceleration = problem.inertia().acceleration();
      // The accelerations are those of the smooth forces; contact changes the momentum of free components by itself.
      const auto& system = problem.system();
      if constexpr (has_contact<Model>)
        for (Index c = 0; c < force.size(); ++c)
          if (system.dofs().equation(c) != IndexMap::constrained) force[c] -= system.forces().contact[c];
      step.momentum = total(force, dim);
    }
  }
  answer.outcome = march.outcome();
  answer.rejected = march.report().rejected_steps;
  answer.u = problem.displacement();
  answer.plastic_strain = problem.max_plastic_strain();
  return answer;
}

template <Row row>
void run() {
  using Model = ModelOf<row>;
  static_assert(CheckModel<Model>::ok);
  check_sizes<Model, row.material, row.bound, row.source, row.enforcement>();
  check(row,
        {.dim = Model::Kinematics::dim,
         .hoop = Model::Kinematics::hoop,
         .contact = has_contact<Model>,
         .friction = has_friction<Model>,
         .wall = row.bound == by_pair,
         .augmented = is_augmented<typename Model::Enforcement>,
         .follows = has_friction<Model> && friction_symmetry<typename Model::Friction>() == Symmetry::general,
         .outer_iterations = has_outer_iterations<Model>(),
         .plastic = is_plastic<typename Model::Material>,
         .inertia = has_inertia<Model>,
         .material = Model::Material::symmetry,
         .system = system_symmetry<Model>,
         .storage = matrix_storage<Model>},
        press_and_drag<Model>());
}

/// Runs the rows of the covering set that `mine` takes; returns their number.
template <class Mine>
int run_rows(Mine mine) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    const auto one = [&](auto index) {
      if constexpr (mine(cover[index])) run<cover[index]>();
      return mine(cover[index]) ? 1 : 0;
    };
    return (0 + ... + one(std::integral_constant<std::size_t, i>{}));
  }
  (std::make_index_sequence<cover.size()>{});
}

}  // namespace typed
