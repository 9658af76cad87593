// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/contact.hpp>
#include <stickslip/contact/contact_nodes.hpp>
#include <stickslip/contact/contact_skills.hpp>
#include <stickslip/contact/node_kernel.hpp>
#include <stickslip/contact/outer_start.hpp>
#include <stickslip/contact/slip_reversals.hpp>
#include <stickslip/dofs/condensed_unknowns.hpp>

#include <algorithm>
#include <limits>

namespace stickslip {

/// The history of a contact pair: the nodes' memory, their pressures as condensed unknowns, and the multipliers and
/// slip bounds that an outer iteration starts from. `Nodes` says where the nodes are, against a tool (ContactNodes) or
/// against another surface (SurfaceNodes).
template <class Enforcement_, class Friction_, class Nodes>
class ContactHistory : public Nodes {
 public:
  using Friction = Friction_;
  using Enforcement = Enforcement_;
  using Skills = ContactSkills<Enforcement, Friction>;
  static constexpr int dim = Nodes::dim;
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

  /// Whether the penalties are in parts of the body's stiffness, and whether that is still to be told.
  bool in_parts_of_stiffness() const { return enforcement_.per == PenaltyPer::stiffness; }
  bool needs_stiffness() const { return in_parts_of_stiffness() && !(measures_.tributary()[0] > 0); }
  /// Takes the penalties from the body's tangent, where they are in parts of it.
  template <class Matrix>
  void compute_penalties(const IndexMap& dofs, const Matrix& tangent) {
    if (in_parts_of_stiffness() && !measures_.take_stiffness(dofs, nodes_, tangent))
      this->refuse("the body has no stiffness at any of its nodes; give the penalty another unit");
  }

  /// Begins an iteration: the pressures of the converged state become unknowns of their own.
  void begin_iteration() {
    pressures_.begin();
    std::fill(stiffest_.begin(), stiffest_.end(), 0.0);
    reversals_.begin_iteration();
    start_.begin_iteration(states_.converged());
  }
  /// Predicts the pressures after the change du of the displacements, with a fraction of their constraint residuals
  /// closed; with none of it (0) the change is a probe. That leaves those alone whose constraints are not closed at the
  /// enforcement's stiffness: their constraint forces follow du.
  void predict(const Field& du, Real fraction) {
    for (std::size_t k = 0; k < nodes_.size(); ++k) pressures_.predict(k, this->change_at(k, du), fraction);
    for (std::size_t k = 0; fraction == 0 && relaxed_ && k < nodes_.size(); ++k)
      if (relaxes_[k]) pressures_.predict(k, Vec<Real, Nodes::components>::Zero(), 0);
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
    this->serialize_measures(archive, part("weights"));
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
      sum += enforcement_.energy(states_.converged(k).gap, this->converged_weight(k));
      if constexpr (with_friction)
        sum += 0.5 * memory_.converged(k).friction.traction.squaredNorm() /
               enforcement_.stick_stiffness(this->converged_weight(k));
    }
    return sum;
  }

  /// The largest stiffness of sticking at any node; 0 without friction [force / length].
  Real largest_stick_stiffness() const {
    Real largest = 0;
    for (std::size_t k = 0; with_friction && k < nodes_.size(); ++k) largest = std::max(largest, stick_stiffness(k));
    return largest;
  }
  /// The largest stiffness of a node that sticks in the last evaluation: its force has the round-off of positions times
  /// that. One that slides has it in the plane from its bound; in space it turns with its slip [force / length].
  Real largest_sticking() const {
    Real largest = 0;
    for (std::size_t k = 0; with_friction && k < nodes_.size(); ++k)
      if (this->touches(k) && (dim == 3 || !states_.trial(k).sliding)) largest = std::max(largest, stick_stiffness(k));
    return largest;
  }
  /// Whether constraints of the last evaluation are closed at less than the enforcement's stiffness.
  bool relaxed() const { return relaxed_; }

 protected:
  using Nodes::name_, Nodes::nodes_, Nodes::states_, Nodes::trial_summary_, Nodes::measures_;

  // Of a description and what the nodes are made from.
  template <class Description, class BodiesType>
  ContactHistory(const Description& contact, const BodiesType& bodies)
      : Nodes(contact, bodies),
        enforcement_(contact.enforcement),
        pressures_(nodes_.size()),
        memory_(nodes_.size()),
        start_(nodes_.size()),
        reversals_(nodes_.size()),
        body_stiffness_(nodes_.size(), 0.0),
        stiffest_(body_stiffness_),
        relaxes_(nodes_.size(), false) {
    if constexpr (with_friction) friction_ = contact.friction;
    if constexpr (requires { enforcement_.validate(); }) enforcement_.validate();
    if constexpr (requires { friction_.validate(); }) friction_.validate();
    if (with_friction && !(enforcement_.stick_stiffness(1) > 0))
      this->refuse("friction needs a positive tangential stiffness");
  }
  // Takes what the body has at a node, before any contact is added to it; a stiff constraint is closed at a part of
  // what it has in the first tangent of an iteration.
  void take_body_stiffness(std::size_t k, Real stiffness, Real of_inertia) {
    body_stiffness_[k] = stiffness;
    if (!(stiffest_[k] > 0)) stiffest_[k] = largest_closing_stiffness * (std::max(stiffness, Real(0)) + of_inertia);
  }
  Real stiffest(std::size_t k, bool iterating) const {
    return iterating && stiffest_[k] > 0 ? stiffest_[k] : std::numeric_limits<Real>::infinity();
  }
  // Notes whether the constraint of a node is relaxed, and gives the gap that its pressure has, which has more digits.
  Real note_relaxed(std::size_t k, bool relaxed, Real gap, Real residual) {
    relaxes_[k] = relaxed;
    if (!relaxed) return gap;
    relaxed_ = true;
    return gap + residual / stiffest_[k];
  }
  Real stick_stiffness(std::size_t k) const { return enforcement_.stick_stiffness(this->weight(k)); }

  [[no_unique_address]] StoredIf<with_friction, typename Friction::Law, ContactHistory> friction_;
  Enforcement enforcement_;
  CondensedUnknowns<Nodes::components> pressures_;
  [[no_unique_address]] History<Memory> memory_;
  [[no_unique_address]] typename Skills::template Start<Memory> start_;
  [[no_unique_address]] typename Skills::template Reversals<dim> reversals_;
  std::vector<Real> body_stiffness_;  // at the nodes
  std::vector<Real> stiffest_;        // at which a node's constraint is closed, at most; 0 before it is known
  std::vector<bool> relaxes_;         // whether it is closed at that one
  bool relaxed_ = false;              // whether some are, in the last evaluation
  Real dt_ = 0;                       // of the last evaluation
};

}  // namespace stickslip
