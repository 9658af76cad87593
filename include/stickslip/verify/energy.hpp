// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/problem.hpp>

#include <vector>

namespace stickslip::verify {

/// Where the work done on a body has gone [energy]. Strain energy and plastic work are those of the points, kinetic
/// energy that of the mass matrix; penetration and sticking store energy in the penalties.
struct Energies {
  Real kinetic = 0;
  Real elastic = 0;
  Real plastic = 0;
  Real penalty = 0;
  Real friction = 0;     ///< dissipated by sliding
  Real external = 0;     ///< work of supports, loads and moving tools, and the kinetic energy of the start
  Real algorithmic = 0;  ///< what the time scheme dissipates, and the quadrature of the forces over finite steps

  /// Work that cannot be accounted for: that of the residual which Newton's method has left.
  Real unbalanced() const { return external - kinetic - elastic - plastic - penalty - friction - algorithmic; }
};

/// Keeps the books of a run (theory.md, eq. 7.7): make one before the first step of a march, update it after every
/// step. It costs a pass over the points a step and nothing where it is not used.
template <class Model>
class EnergyLedger {
 public:
  static constexpr int dim = Model::Kinematics::dim;

  /// Begin after `Problem::march`, before its first step.
  explicit EnergyLedger(const Scene<MechanicsOf<Model>>& problem) : problem_(problem), u_(problem.displacement()) {
    // What acts already at the start, as far as it is known: loads and initial penetrations in dynamics.
    const System<MechanicsOf<Model>>& system = problem.system();
    internal_ = system.internal();
    contact_ = system.contact();
    external_ = system.external();
    reaction_.setZero(u_.size());
    acceleration_ = reaction_;
    if constexpr (has_inertia<Model>) {
      acceleration_ = problem.inertia().acceleration();
      energies_.external = problem.inertia().kinetic_energy();
    }
    read_state();
  }

  /// Books the step that has just been taken.
  void update(const StepReport& step) {
    const System<MechanicsOf<Model>>& system = problem_.system();
    const Field du = problem_.displacement() - u_;
    Real before = 0.5;  // weight of the forces at the start of the step
    if constexpr (has_inertia<Model>) before = problem_.inertia().scheme().alpha_f;
    const auto mean = [&](const Field& old, const Field& now) { return Field(before * old + (1 - before) * now); };

    // Work done on the body: supports by their reactions, loads, tools by the motion of their surface under the nodes.
    Field reaction(u_.size());
    for (Index c = 0; c < reaction.size(); ++c)
      reaction[c] = system.dofs().equation(c) == Dofs::constrained ? system.reaction(c) : 0.0;
    Real external = has_inertia<Model> ? du.dot(reaction) : du.dot(mean(reaction_, reaction));
    external += du.dot(mean(external_, system.external()));
    const Real by_tools = tool_work(du, step.time - step.dt, step.time, before);
    external += by_tools;

    // What the body's forces did, against what its energies say they did.
    const Energies old = energies_;
    energies_.friction += step.contact.dissipated;
    energies_.external += external;
    read_state();
    Real algorithmic = du.dot(mean(internal_, system.internal())) - (energies_.elastic - old.elastic) -
                       (energies_.plastic - old.plastic);
    algorithmic += du.dot(mean(contact_, system.contact())) + by_tools - (energies_.penalty - old.penalty) -
                   step.contact.dissipated;
    if constexpr (has_inertia<Model>) {
      const auto& inertia = problem_.inertia();
      Field force = Field::Zero(du.size());
      inertia.add_product(
          (1 - inertia.scheme().alpha_m) * inertia.acceleration() + inertia.scheme().alpha_m * acceleration_, force);
      algorithmic += du.dot(force) - (energies_.kinetic - old.kinetic);
      acceleration_ = inertia.acceleration();
    }
    energies_.algorithmic += algorithmic;

    u_ = problem_.displacement();
    internal_ = system.internal();
    contact_ = system.contact();
    external_ = system.external();
    reaction_ = reaction;
    if constexpr (has_contact<Model>) {
      forces_.clear();
      problem_.visit_contacts(
          [&](const auto& pair) { forces_.insert(forces_.end(), pair.states().begin(), pair.states().end()); });
    }
  }

  /// The books, to be kept with a march (io::save).
  void serialize(Archive& archive) {
    archive("books, energies", energies_);
    archive("books, displacement", u_);
    archive("books, internal", internal_);
    archive("books, contact", contact_);
    archive("books, external", external_);
    archive("books, reaction", reaction_);
    archive("books, acceleration", acceleration_);
    archive.any_length("books, contact nodes", forces_);
  }

  /// The books since the start.
  const Energies& energies() const { return energies_; }

 private:
  // Energies that are functions of the state.
  void read_state() {
    const auto& material = problem_.body().material();
    energies_.elastic = energies_.plastic = energies_.penalty = 0;
    problem_.body().visit_points(problem_.displacement(),
                                 [&](Index, int, const auto& F, const auto& state, Real weight) {
                                   energies_.elastic += weight * material.energy(F, state);
                                   if constexpr (requires { material.plastic_work(state); })
                                     energies_.plastic += weight * material.plastic_work(state);
                                 });
    if constexpr (has_contact<Model>)
      problem_.visit_contacts([&](const auto& pair) { energies_.penalty += pair.stored_energy(); });
    if constexpr (has_inertia<Model>) energies_.kinetic = problem_.inertia().kinetic_energy();
  }

  // Work that the moving tools do on the body, which has moved by du, from time t0 to t1.
  Real tool_work([[maybe_unused]] const Field& du, [[maybe_unused]] Real t0, [[maybe_unused]] Real t1,
                 [[maybe_unused]] Real before) const {
    Real work = 0;
    if constexpr (has_contact<Model>) {
      std::size_t p = 0;
      rigid::PosesAlong<dim> along;
      problem_.visit_contacts([&](const auto& pair) {
        along.take(pair.motion(), t0, t1);
        for (std::size_t k = 0; k < pair.nodes().size(); ++k) {
          const Index n = pair.nodes()[k];
          const Vec<Real, dim> x = problem_.body().mesh().nodes[static_cast<std::size_t>(n)] + problem_.displacement(n);
          const Vec<Real, dim> own = at_node<dim>(du, n);
          Vec<Real, dim> force = (1 - before) * pair.states()[k].force;
          if (!forces_.empty()) force += before * forces_[p++].force;
          work -=
              force.dot(along.turns() ? carried(along, x, own) : moved(along[0].pose, along[along.size() - 1].pose, x));
        }
      });
    }
    return work;
  }
  // Way of the point of a tool that is at x in the end.
  static Vec<Real, dim> moved(const rigid::Pose<dim>& from, const rigid::Pose<dim>& to, const Vec<Real, dim>& x) {
    return x - from.in_space(to.on_tool(x));
  }
  // Ways of the points of a turning tool that a node comes to on its own way to x, one after the other: the mean of
  // those that begin and that end there, which lie on either side of the tangent (theory.md, eq. 4.27).
  static Vec<Real, dim> carried(const rigid::PosesAlong<dim>& along, const Vec<Real, dim>& x,
                                const Vec<Real, dim>& own) {
    Vec<Real, dim> way = Vec<Real, dim>::Zero();
    for (std::size_t i = 1; i < along.size(); ++i) {
      const Vec<Real, dim> here = x - (1 - along[i - 1].share) * own, next = x - (1 - along[i].share) * own;
      way += 0.5 * (moved(along[i - 1].pose, along[i].pose, next) - moved(along[i].pose, along[i - 1].pose, here));
    }
    return way;
  }

  const Scene<MechanicsOf<Model>>& problem_;
  Energies energies_;
  Field u_, internal_, contact_, external_, reaction_, acceleration_;
  std::vector<ContactNodeState<dim>> forces_;  // at the start of the step, by pair and node
};

template <class Model>
EnergyLedger(const Problem<Model>&) -> EnergyLedger<Model>;

}  // namespace stickslip::verify
