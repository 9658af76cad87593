// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/pose.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// What a pair did in the last assembly.
struct ContactSummary {
  Index touching = 0;        ///< nodes in contact
  Index sliding = 0;         ///< of them, nodes that slide
  Real max_penetration = 0;  ///< [length]
  Real max_slip = 0;         ///< largest slid distance of a node so far [length]
  Real bound = 0;       ///< sum of the friction forces that the nodes could bear at their current pressures [force]
  Real lag = 0;         ///< sum of the changes of these that the law has not seen yet [force]
  Real swing = 0;       ///< the same with its sign, of nodes that touched before the step as well [force]
  Real dissipated = 0;  ///< by friction in the step [energy]
  Real missed = 0;      ///< what friction would dissipate besides in the step if its bounds did not lag [energy]
  Real stored = 0;      ///< by penetration: the nodes' changes in the step, their magnitudes summed [energy]
  Real turn = 0;        ///< of the nodes' slides within the step over what is allowed (theory.md, eq. 4.25) [-]

  void merge(const ContactSummary& other) {
    touching += other.touching;
    sliding += other.sliding;
    max_penetration = std::max(max_penetration, other.max_penetration);
    max_slip = std::max(max_slip, other.max_slip);
    bound += other.bound;
    lag += other.lag;
    swing += other.swing;
    dissipated += other.dissipated;
    missed += other.missed;
    stored += other.stored;
    turn = std::max(turn, other.turn);
  }
};

/// A contact node at a converged state.
template <int dim>
struct ContactNodeState {
  Vec<Real, dim> force = Vec<Real, dim>::Zero();  ///< of the node on the tool [force]
  Real gap = 0;                                   ///< [length]
  Real slip = 0;                                  ///< slid distance so far [length]; 0 without friction
  Real pressure = 0;                              ///< part of the force along the tool's normal [force]
  bool touching = false;
  bool sliding = false;
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
  const std::vector<ContactNodeState<dim>>& states() const { return states_; }
  /// What happened in the step that led to the converged state.
  const ContactSummary& summary() const { return summary_; }
  /// What happened in the last assembly, of a step that may be given up.
  const ContactSummary& trial_summary() const { return trial_summary_; }
  /// Whether a node, by its place in `nodes`, touched the tool in the last assembly.
  bool touches(std::size_t k) const { return trial_states_[k].touching; }
  /// Total force on the tool at the converged state.
  const Vec<Real, dim>& force() const { return force_; }

 protected:
  // Throws std::invalid_argument where the side has no nodes.
  ContactRecord(std::string name, std::string side, rigid::Motion<dim> motion, std::vector<Index> nodes)
      : name_(name.empty() ? side : std::move(name)),
        side_(std::move(side)),
        motion_(std::move(motion)),
        nodes_(std::move(nodes)),
        states_(nodes_.size()),
        trial_states_(nodes_.size()) {
    if (nodes_.empty()) refuse("the side has no nodes");
  }
  [[noreturn]] void refuse(const std::string& reason) const {
    throw std::invalid_argument("contact \"" + name_ + "\": " + reason);
  }

  std::string name_, side_;
  rigid::Motion<dim> motion_;
  std::vector<Index> nodes_;
  std::vector<ContactNodeState<dim>> states_, trial_states_;
  ContactSummary summary_, trial_summary_;
  Vec<Real, dim> force_ = Vec<Real, dim>::Zero(), trial_force_ = Vec<Real, dim>::Zero();
};

}  // namespace stickslip
