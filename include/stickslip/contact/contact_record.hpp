// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/history.hpp>
#include <stickslip/geometry/pose.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// What a pair did in the last evaluation.
struct ContactSummary {
  Index touching = 0;        ///< nodes in contact
  Index sliding = 0;         ///< of them, nodes that slide
  Real max_penetration = 0;  ///< [length]
  Real max_slip = 0;         ///< largest slid distance of a node so far [length]
  Real friction_capacity =
      0;         ///< sum of the friction forces that the nodes could bear at their current pressures [force]
  Real lag = 0;  ///< sum of the changes of these that the law has not seen yet [force]
  Real lag_oscillation = 0;  ///< the same with its sign, of nodes that touched before the step as well [force]
  Real dissipated = 0;       ///< by friction in the step [energy]
  Real lag_work = 0;         ///< what friction would dissipate besides in the step if its bounds did not lag [energy]
  Real penalty_work = 0;     ///< by penetration: the nodes' changes in the step, their magnitudes summed [energy]
  Real turn = 0;             ///< of the nodes' slides within the step over what is allowed (theory.md, eq. 4.26) [-]

  void merge(const ContactSummary& other) {
    touching += other.touching;
    sliding += other.sliding;
    max_penetration = std::max(max_penetration, other.max_penetration);
    max_slip = std::max(max_slip, other.max_slip);
    friction_capacity += other.friction_capacity;
    lag += other.lag;
    lag_oscillation += other.lag_oscillation;
    dissipated += other.dissipated;
    lag_work += other.lag_work;
    penalty_work += other.penalty_work;
    turn = std::max(turn, other.turn);
  }

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("touching", self.touching);
    visit("sliding", self.sliding);
    visit("max_penetration", self.max_penetration);
    visit("max_slip", self.max_slip);
    visit("friction_capacity", self.friction_capacity);
    visit("lag", self.lag);
    visit("lag_oscillation", self.lag_oscillation);
    visit("dissipated", self.dissipated);
    visit("lag_work", self.lag_work);
    visit("penalty_work", self.penalty_work);
    visit("turn", self.turn);
  }
};

/// A contact node at a converged state.
template <int dim>
struct ContactNodeState {
  Vec<Real, dim> force = Vec<Real, dim>::Zero();  ///< of the node on the tool [force]
  Real gap = 0;                                   ///< [length]
  Real accumulated_slip = 0;                      ///< slid distance so far [length]; 0 without friction
  Real pressure = 0;                              ///< part of the force along the tool's normal [force]
  bool touching = false;
  bool sliding = false;

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("force", self.force);
    visit("gap", self.gap);
    visit("accumulated_slip", self.accumulated_slip);
    visit("pressure", self.pressure);
    visit("touching", self.touching);
    visit("sliding", self.sliding);
  }
};

/// A side of the body in contact with one tool, whatever the law: its nodes and what happened to them.
template <int dim>
class ContactRecord {
 public:
  const std::string& name() const { return name_; }
  const std::string& side() const { return side_; }
  const rigid::Motion<dim>& motion() const { return motion_; }
  const std::vector<Index>& nodes() const { return nodes_; }
  /// The nodes at the converged state.
  const std::vector<ContactNodeState<dim>>& states() const { return states_.converged(); }
  /// What happened in the step that led to the converged state.
  const ContactSummary& summary() const { return summary_; }
  /// Whether an evaluation has come to its end since the last commit: the trial state is of it.
  bool evaluated() const { return evaluated_; }
  /// What happened in the last evaluation, of a step that may be given up.
  const ContactSummary& trial_summary() const {
    assert(evaluated_ && "trial_summary needs a System::evaluate without failure since the last commit");
    return trial_summary_;
  }
  /// Whether a node, by its place in `nodes`, touched the tool in the last evaluation.
  bool touches(std::size_t k) const {
    assert(evaluated_ && "touches needs a System::evaluate without failure since the last commit");
    return states_.trial(k).touching;
  }
  /// Gives up the trial state, which another evaluation is to replace.
  void discard_trial() { evaluated_ = false; }
  /// Total force on the tool at the converged state.
  const Vec<Real, dim>& force() const { return force_; }

 protected:
  // Throws std::invalid_argument where the side has no nodes.
  ContactRecord(std::string name, std::string side, rigid::Motion<dim> motion, std::vector<Index> nodes)
      : name_(name.empty() ? side : std::move(name)),
        side_(std::move(side)),
        motion_(std::move(motion)),
        nodes_(std::move(nodes)),
        states_(nodes_.size()) {
    if (nodes_.empty()) refuse("the side has no nodes");
  }
  [[noreturn, gnu::cold, gnu::noinline]] void refuse(const std::string& reason) const {
    throw std::invalid_argument("contact \"" + name_ + "\": " + reason);
  }

  void begin_evaluation() {
    evaluated_ = false;
    trial_summary_ = {};
    trial_force_.setZero();
  }
  // Notes the trial state of a node, and of one that touches what its `kernel` result contributes.
  void note_node(const ContactNodeState<dim>& before, const ContactNodeState<dim>& state) {
    const auto work = [](const ContactNodeState<dim>& at) { return at.pressure > 0 ? at.pressure * at.gap : 0; };
    trial_summary_.penalty_work += 0.5 * std::abs(work(state) - work(before));
    trial_summary_.max_slip = std::max(trial_summary_.max_slip, state.accumulated_slip);
  }
  template <class Kernel>
  void note_touching(const ContactNodeState<dim>& before, const ContactNodeState<dim>& state, const Kernel& kernel) {
    add(trial_force_, state.force);
    ++trial_summary_.touching;
    trial_summary_.sliding += state.sliding ? 1 : 0;
    trial_summary_.max_penetration = std::max(trial_summary_.max_penetration, -state.gap);
    trial_summary_.friction_capacity += kernel.bound;
    trial_summary_.lag += std::abs(kernel.lag);
    if (before.touching) trial_summary_.lag_oscillation += kernel.lag;
    trial_summary_.dissipated += kernel.dissipated;
    trial_summary_.lag_work += kernel.lag_work;
  }
  void end_evaluation() { evaluated_ = true; }
  void commit_record() {
    assert(evaluated_ && "the commit of a contact needs a System::evaluate without failure since the last commit");
    evaluated_ = false;
    states_.commit();
    summary_ = trial_summary_;
    force_ = trial_force_;
  }

  std::string name_, side_;
  rigid::Motion<dim> motion_;
  std::vector<Index> nodes_;
  History<ContactNodeState<dim>> states_;
  ContactSummary summary_, trial_summary_;
  Vec<Real, dim> force_ = Vec<Real, dim>::Zero(), trial_force_ = Vec<Real, dim>::Zero();

 private:
  bool evaluated_ = false;
};

}  // namespace stickslip
