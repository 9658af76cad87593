// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/contact.hpp>
#include <stickslip/contact/contact_nodes.hpp>
#include <stickslip/contact/contact_skills.hpp>
#include <stickslip/contact/node_kernel.hpp>
#include <stickslip/contact/outer_start.hpp>
#include <stickslip/contact/slip_reversals.hpp>
#include <stickslip/dofs/condensed_unknowns.hpp>

#include <limits>

namespace stickslip {

namespace detail {
template <class Model, class Friction>
using ContactNodesOf =
    ContactNodes<Model::Kinematics::dim, ToolOf<Model>, ContactSkills<typename Model::Enforcement, Friction>::friction,
                 ContactSkills<typename Model::Enforcement, Friction>::takes_area>;
}  // namespace detail

/// The history of a contact pair: the nodes' memory, their pressures as condensed unknowns, and the multipliers and
/// slip bounds that an outer iteration starts from.
template <class Model, class Friction_>
class ContactHistory : public detail::ContactNodesOf<Model, Friction_> {
 public:
  using Friction = Friction_;
  using Enforcement = typename Model::Enforcement;
  using Skills = ContactSkills<Enforcement, Friction>;
  static constexpr int dim = Model::Kinematics::dim;
  using Memory = NodeMemory<Real, dim, Enforcement, Friction>;
  static constexpr bool with_friction = Skills::friction;
  static constexpr bool takes_area = Skills::takes_area;
  /// Whether steps take several outer iterations for this pair.
  static constexpr bool outer_iterations = Skills::outer_iterations;
  /// Whether the slip bound lags behind the pressure, and can be told which one to take.
  static constexpr bool lags = Skills::lags;
  /// Bytes that a contact node keeps for one state (there are two: converged and trial).
  static constexpr std::size_t bytes_per_node = std::is_empty_v<Memory> ? 0 : sizeof(Memory);

  const Enforcement& enforcement() const { return enforcement_; }

  /// Takes the positions at `time` for the start of sliding. Throws std::invalid_argument where they cannot be a start.
  void start(const Field& u, Real time) {
    const auto points = this->start_points(u, time);
    for (std::size_t k = 0; k < points.size(); ++k) {
      states_.set_trial(k, {.gap = points[k].gap});
      Memory memory = memory_.converged(k);
      if constexpr (with_friction) memory.friction.surface_coordinate = points[k].surface_coordinate;
      memory_.set_trial(k, memory);
    }
    states_.commit();
    memory_.commit();
    reset_augmentations();
  }

  /// Begins an iteration: the pressures of the converged state become unknowns of their own.
  void begin_iteration() {
    pressures_.begin();
    reversals_.begin_iteration();
    start_.begin_iteration(states_.converged());
  }
  /// Predicts the pressures after the change du of the displacements, with a fraction of their constraint residuals
  /// closed; with none of it (0) the change is a probe.
  void predict(const Field& du, Real fraction) {
    for (std::size_t k = 0; k < nodes_.size(); ++k) pressures_.predict(k, at_node<dim>(du, nodes_[k]), fraction);
    reversals_.next_search(fraction == 0);
    if (fraction != 0) start_.predict([this](std::size_t k) { return pressures_.predicted(k); }, memory_);
  }
  void set_step(Real length) { pressures_.set_step(length); }
  Real constraint_merit() const { return pressures_.constraint_merit(); }
  /// Makes the iteration, which has begun, linearise more nodes as sticking. With `sticking` it starts from nodes that
  /// all stick, and lagging bounds are of the step's own pressures until `reset_augmentations`.
  void retry(bool sticking) requires with_friction {
    reversals_.retry(sticking);
    if constexpr (lags)
      if (sticking) start_.use_own_of_all();
  }
  /// Pressure of a node in the last evaluation [force].
  Real current_pressure(std::size_t k) const { return this->touches(k) ? pressures_[k].value : 0; }

  /// Goes back to the multipliers and the bounds of the converged state.
  void reset_augmentations() {
    start_.reset(memory_);
    measures_.restore_penalty();
  }
  /// Starts the next outer iteration from where the last one ended: its tractions are the multipliers, its pressures
  /// enter the bounds. Surface coordinates and accumulated slips stay those of the converged state.
  void next_augmentation() requires outer_iterations {
    if constexpr (Skills::updates_lag) {
      lag_increment();
      start_.relax();
    }
    if constexpr (is_augmented<Enforcement>)
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        start_[k].enforcement = memory_.trial(k).enforcement;
        if constexpr (with_friction) {
          start_[k].friction.traction = memory_.trial(k).friction.traction;
          reversals_.set_stuck(k, this->touches(k) && !states_.trial(k).sliding);
        }
      }
  }
  /// Goes a smaller part of the way of the last `next_augmentation`; false where there is nothing left of it.
  bool backtrack() requires outer_iterations {
    if constexpr (Skills::updates_lag)
      return start_.backtrack();
    else
      return false;
  }
  void scale_penalty(Real factor) { measures_.scale_penalty(factor); }
  /// How far the last outer iteration is from what another one would give [-]: the largest gap of a pressed node and
  /// the largest reversible slip of a sticking one, over the nodes' spacing, and the lag of the bounds. In dynamics the
  /// `motion` of the step takes the spacing's place, within limits (theory.md, eq. 4.19).
  Real outer_residual([[maybe_unused]] Real motion = std::numeric_limits<Real>::infinity()) const {
    Real largest = 0;
    if constexpr (is_augmented<Enforcement>)
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        if (!this->touches(k)) continue;
        const Real spacing = measures_.spacing(k), length = std::clamp(100 * motion, 0.01 * spacing, spacing);
        largest = std::max(largest, std::abs(states_.trial(k).gap) / length);
        if constexpr (with_friction)
          if (!states_.trial(k).sliding)
            largest = std::max(largest, (memory_.trial(k).friction.traction - start_[k].friction.traction).norm() /
                                            (stick_stiffness(k) * length));
      }
    if (Skills::updates_lag && trial_summary_.friction_capacity > 0)
      largest = std::max(largest, trial_summary_.lag / trial_summary_.friction_capacity);
    return largest;
  }
  /// Differences of the pressures and those that the bounds are of [force].
  const Field& lag_increment() requires lags {
    return start_.lag_increment([this](std::size_t k) { return current_pressure(k); }, memory_, dt_);
  }
  /// Makes the bounds those of the pressures a part of the last `lag_increment` on; `end_probe` takes it back.
  void perturb_bound(Real part) requires lags { start_.set_bound_pressure(part); }
  void end_probe() requires lags { start_.end_probe(memory_); }
  /// Square of the norm of what the pressures have changed by since the last `lag_increment` [force^2].
  Real pressure_response_squared() const requires lags {
    return start_.pressure_response_squared([this](std::size_t k) { return current_pressure(k); });
  }

  /// Makes the last evaluation's memory and forces the converged ones.
  void commit() {
    this->commit_record();
    memory_.commit();
    pressures_.commit();
    measures_.keep_penalty();  // what a converged step took stays
    reset_augmentations();
  }
  /// The converged state. The measures are part of it: they come from the start, and outer iterations may scale them.
  [[gnu::cold]] void serialize(Archive& archive) {
    const auto part = [this](const char* what) { return joined({"contact ", name_, ", ", what}); };
    archive.check_equal(part("side"), this->side_);
    states_.serialize(archive, part("nodes"));
    measures_.serialize(archive, part("weights"));
    pressures_.serialize(archive, part("pressures"));
    memory_.serialize(archive, part("memory"));
    archive(part("force"), this->force_);
    archive(part("summary"), this->summary_);
    if (archive.loading()) reset_augmentations();
  }
  /// Energy that penetration and sticking store at the converged state, where the enforcement tells it.
  Real stored_energy() const requires requires(const Enforcement& e) { e.energy(Real(), Real()); }
  {
    Real sum = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!states_.converged(k).touching) continue;
      sum += enforcement_.energy(states_.converged(k).gap, measures_.tributary()[k]);
      if constexpr (with_friction)
        sum += 0.5 * memory_.converged(k).friction.traction.squaredNorm() / stick_stiffness(k);
    }
    return sum;
  }

 protected:
  using Nodes = detail::ContactNodesOf<Model, Friction>;
  using Nodes::name_, Nodes::nodes_, Nodes::states_, Nodes::trial_summary_, Nodes::measures_;

  template <class BodiesType>
  ContactHistory(const Contact<Model, Friction>& contact, const BodiesType& bodies)
      : Nodes(contact.name, contact.side, contact.tool, contact.motion, contact.start_depth, contact.enforcement.per,
              bodies),
        friction_(contact.friction),
        enforcement_(contact.enforcement),
        pressures_(nodes_.size()),
        memory_(nodes_.size()),
        start_(nodes_.size()),
        reversals_(nodes_.size()) {
    if constexpr (requires { enforcement_.validate(); }) enforcement_.validate();
    if constexpr (requires { friction_.validate(); }) friction_.validate();
    if (with_friction && !(enforcement_.stick_stiffness(1) > 0))
      this->refuse("friction needs a positive tangential stiffness");
  }
  Real stick_stiffness(std::size_t k) const { return enforcement_.stick_stiffness(measures_.tributary()[k]); }

  [[no_unique_address]] decltype(Contact<Model, Friction>::friction) friction_;
  Enforcement enforcement_;
  CondensedUnknowns<dim> pressures_;
  [[no_unique_address]] History<Memory> memory_;
  [[no_unique_address]] typename Skills::template Start<Memory> start_;
  [[no_unique_address]] typename Skills::template Reversals<dim> reversals_;
  Real dt_ = 0;  // of the last evaluation
};

}  // namespace stickslip
