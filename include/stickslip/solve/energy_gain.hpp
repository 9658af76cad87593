// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/geometry/poses_along.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/solve/report.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// Where the work done on a body has gone [energy]. Strain energy and plastic work are those of the points, kinetic
/// energy that of the mass matrix; penetration and sticking store energy in the penalties.
struct Energies {
  Real kinetic = 0;
  Real elastic = 0;
  Real plastic = 0;
  Real penalty = 0;
  Real friction = 0;     ///< dissipated by sliding
  Real damping = 0;      ///< dissipated by the model's Damping
  Real external = 0;     ///< work of supports, loads and moving tools, and the kinetic energy of the start
  Real algorithmic = 0;  ///< what the time scheme and impacts dissipate, and the quadrature of the forces over finite
                         ///< steps; negative: what the time scheme has gained

  /// Work that cannot be accounted for: that of the residual which Newton's method has left.
  Real unbalanced() const {
    return external - kinetic - elastic - plastic - penalty - friction - damping - algorithmic;
  }

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("kinetic", self.kinetic);
    visit("elastic", self.elastic);
    visit("plastic", self.plastic);
    visit("penalty", self.penalty);
    visit("friction", self.friction);
    visit("damping", self.damping);
    visit("external", self.external);
    visit("algorithmic", self.algorithmic);
  }
};

namespace detail {
template <class Material, class TensorPattern>
inline constexpr bool tells_energy = requires(const Material& material, const Tensor<Real, TensorPattern>& F,
                                              const typename Material::template State<Real, TensorPattern>& state) {
  material.energy(F, state);
};
template <class TensorPattern, class... Types>
constexpr bool all_tell_energy(BodyTypes<Types...>) {
  return (tells_energy<typename Types::Material, TensorPattern> && ...);
}
}  // namespace detail

/// Whether a model's materials and enforcement tell their energies; those of a user may not.
template <class Model>
concept TellsEnergies = detail::all_tell_energy<typename Model::Kinematics::TensorPattern>(BodyTypesOf<Model>{}) &&
    (!has_contact<Model> ||
     requires(const typename Model::Enforcement& enforcement) { enforcement.energy(Real(), Real()); });

/// The energy balance of a run of a scene (theory.md, eq. 7.7): made before its first step, updated after every step.
/// They cost a pass over the points a step.
template <class Model, class Scene>
class EnergyGain {
 public:
  static constexpr int dim = Model::Kinematics::dim;

  explicit EnergyGain(const Scene& scene) : scene_(scene), u_(scene.displacement()) {
    // What acts already at the start, as far as it is known.
    // Without inertia loads that are there at once count as put on in the first step, as the forces do that bear them.
    external_ = scene.system().forces().external;
    if constexpr (has_inertia<Model>) {
      external_.setZero(u_.size());
      if (scene.system().prescribed().add_loads(scene.time(), external_))
        external_.setZero();  // the first step says so
      energies_.external = start_kinetic_ = scene.inertia().kinetic_energy();
    } else {
      before_.internal = scene.system().forces().internal;
      before_.contact = scene.system().forces().contact;
      before_.reaction.setZero(u_.size());
    }
    read_state();
    start_ = energies_.kinetic + energies_.elastic + energies_.penalty;
  }

  /// Adds the step that has just been taken.
  void update(const StepReport& step) {
    const auto& system = scene_.system();
    const auto& space = system.space();
    const Field du = scene_.displacement() - u_;
    Real old_share = 0.5;  // weight of the smooth forces at the start of the step
    if constexpr (has_inertia<Model>) old_share = scene_.inertia().scheme().alpha_f;
    const auto mean = [&](const Field& old, const Field& now) {
      return Field(old_share * old + (1 - old_share) * now);
    };
    const Energies old = energies_;

    // Work done on the body: supports by their reactions, loads, tools by the motion of their surface under the nodes.
    Field reaction(u_.size());
    Real residual_work = 0;
    reaction = system.forces().reaction;
    for (Index c = 0; c < reaction.size(); ++c) {
      if (system.dofs().supported(c)) continue;
      residual_work += du[c] * std::exchange(reaction[c], 0.0);
    }
    residual_work = space.sum(residual_work);
    const Real by_tools = space.sum(tool_work(du, step.time - step.dt, step.time));
    Real external = space.dot(du, mean(external_, system.forces().external)) + by_tools;
    Real algorithmic = 0;
    if constexpr (has_inertia<Model>) {
      // All forces that the balance averages, those of inertia among them, do the work of supports, loads and residual.
      external += space.dot(du, reaction);
      algorithmic = external + residual_work;
      if constexpr (has_damping<Model>) {
        energies_.damping += scene_.inertia().dissipated();
        algorithmic -= scene_.inertia().dissipated();
      }
    } else {
      external += space.dot(du, mean(before_.reaction, reaction));
      algorithmic = space.dot(du, mean(before_.internal, system.forces().internal)) +
                    space.dot(du, mean(before_.contact, system.forces().contact)) + by_tools;
      before_.internal = system.forces().internal;
      before_.contact = system.forces().contact;
      before_.reaction = reaction;
    }
    energies_.friction += step.contact.dissipated;
    energies_.external += external;
    read_state();
    // What the forces did, against what the energies say that they did.
    energies_.algorithmic += algorithmic - step.contact.dissipated - (energies_.kinetic - old.kinetic) -
                             (energies_.elastic - old.elastic) - (energies_.plastic - old.plastic) -
                             (energies_.penalty - old.penalty);
    largest_work_ = std::max(largest_work_, std::abs(energies_.external - start_kinetic_));

    u_ = scene_.displacement();
    external_ = system.forces().external;
    if constexpr (with_forces) {
      before_.forces.clear();
      scene_.visit_contacts([&](const auto& pair) {
        before_.forces.insert(before_.forces.end(), pair.states().begin(), pair.states().end());
      });
    }
  }

  /// The energy balance since the start.
  const Energies& energies() const { return energies_; }
  /// What the time scheme has gained since the start, over the largest of the energy of the start and the work done so
  /// far (theory.md, eq. 7.17) [-]; 0 where it has lost.
  Real gain() const {
    const Real scale = std::max(start_, largest_work_);
    return energies_.algorithmic < 0 && scale > 0 ? -energies_.algorithmic / scale : 0;
  }

  /// The energy balance, to be kept with a march (io::save).
  void serialize(Archive& archive, const std::string& balance = "energy balance") {
    archive(balance + ", energies", energies_);
    archive(balance + ", start", start_);
    archive(balance + ", kinetic energy of the start", start_kinetic_);
    archive(balance + ", largest work", largest_work_);
    archive(balance + ", displacement", u_);
    archive(balance + ", external", external_);
    if constexpr (!has_inertia<Model>) {
      archive(balance + ", internal", before_.internal);
      archive(balance + ", contact", before_.contact);
      archive(balance + ", reaction", before_.reaction);
    }
    if constexpr (with_forces) archive.resizable(balance + ", contact nodes", before_.forces);
  }

 private:
  static constexpr bool with_forces = has_contact<Model> && !has_inertia<Model>;

  // Energies that are functions of the state.
  void read_state() {
    energies_.elastic = energies_.plastic = energies_.penalty = 0;
    scene_.bodies().for_each([&](const auto& body) {
      const auto& material = body.material();
      body.visit_points(scene_.displacement(), [&](Index, int, const auto& F, const auto& state, Real weight) {
        energies_.elastic += weight * material.energy(F, state);
        if constexpr (requires { material.plastic_work(state); })
          energies_.plastic += weight * material.plastic_work(state);
      });
    });
    if constexpr (has_contact<Model>)
      scene_.visit_contacts([&](const auto& pair) { energies_.penalty += pair.stored_energy(); });
    const auto& space = scene_.system().space();
    for (Real* energy : {&energies_.elastic, &energies_.plastic, &energies_.penalty}) *energy = space.sum(*energy);
    if constexpr (has_inertia<Model>) energies_.kinetic = scene_.inertia().kinetic_energy();
  }

  // Work that the moving tools do on the body, which has moved by du, from time t0 to t1: with inertia by the force of
  // the step's end, which is the impulse over all of it.
  Real tool_work([[maybe_unused]] const Field& du, [[maybe_unused]] Real t0, [[maybe_unused]] Real t1) const {
    Real work = 0;
    if constexpr (has_contact<Model>) {
      [[maybe_unused]] std::size_t p = 0;
      rigid::PosesAlong<dim> along;
      scene_.visit_contacts([&](const auto& pair) {
        along.take(pair.motion(), t0, t1);
        for (std::size_t k = 0; k < pair.nodes().size(); ++k) {
          const Index n = pair.nodes()[k];
          const Vec<Real, dim> x = scene_.bodies().positions()[static_cast<std::size_t>(n)] + scene_.displacement(n);
          const Vec<Real, dim> own = at_node<dim>(du, n);
          Vec<Real, dim> force = pair.states()[k].force;
          if constexpr (with_forces) {
            force *= 0.5;
            if (!before_.forces.empty()) force += 0.5 * before_.forces[p++].force;
          }
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
  // those that begin and that end there, which lie on either side of the tangent (theory.md, eq. 4.28).
  static Vec<Real, dim> carried(const rigid::PosesAlong<dim>& along, const Vec<Real, dim>& x,
                                const Vec<Real, dim>& own) {
    Vec<Real, dim> way = Vec<Real, dim>::Zero();
    for (std::size_t i = 1; i < along.size(); ++i) {
      const Vec<Real, dim> here = x - (1 - along[i - 1].share) * own, next = x - (1 - along[i].share) * own;
      way += 0.5 * (moved(along[i - 1].pose, along[i].pose, next) - moved(along[i].pose, along[i - 1].pose, here));
    }
    return way;
  }

  struct Before {
    Field internal, contact, reaction;
    std::vector<ContactNodeState<dim>> forces;  // by pair and node
  };

  const Scene& scene_;
  Energies energies_;
  Real start_ = 0, start_kinetic_ = 0, largest_work_ = 0;
  Field u_, external_;
  [[no_unique_address]] StoredIf<!has_inertia<Model>, Before, EnergyGain> before_;  // at the start of the step
};

}  // namespace stickslip
