// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/contact_history.hpp>
#include <stickslip/contact/surface_nodes.hpp>
#include <stickslip/dofs/evaluation.hpp>
#include <stickslip/dofs/node_couplings.hpp>
#include <stickslip/dofs/sparse_matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace stickslip {

namespace detail {
template <class Model, class Friction, class Skills = ContactSkills<typename Model::Enforcement, Friction>>
using SurfaceHistory = ContactHistory<typename Model::Enforcement, Friction,
                                      SurfaceNodes<typename Model::Kinematics, Skills::friction, Skills::takes_area>>;
}  // namespace detail

/// The contact term of one surface on another, or on itself: its kernels are contact_law at the nodes and SegmentFoot
/// at the points (theory.md, eq. 4.37-4.40).
template <class Model, class Friction_>
class SurfacePair : public detail::SurfaceHistory<Model, Friction_> {
 public:
  using Base = detail::SurfaceHistory<Model, Friction_>;
  using Base::with_friction, Base::dim, Base::places, Base::components;
  using typename Base::Friction, typename Base::Memory, typename Base::Point;
  using Matrix = SparseMatrix<matrix_storage<Model>>;

  /// Throws std::invalid_argument, naming the contact, for parameters that cannot be.
  template <class Description, class BodiesType>
  SurfacePair(const Description& contact, const BodiesType& bodies) : Base(contact, bodies), response_(nodes_.size()) {}
  SurfacePair(const SurfacePair&) = delete;
  SurfacePair& operator=(const SurfacePair&) = delete;

  /// Makes the scatter maps into a matrix.
  void connect(const IndexMap& dofs, const Matrix& matrix) {
    this->stale_ = false;
    equations_.clear();
    slots_.clear();
    slot_start_.assign(1, 0);
    diagonal_.clear();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const std::size_t first = equations_.size();
      for (const Index n : this->stencil(k))
        for (int i = 0; i < dim; ++i) equations_.push_back(dofs.equation(n * dim + i));
      for (std::size_t b = first; b < equations_.size(); ++b)
        for (std::size_t a = triangle ? b : first; a < equations_.size(); ++a)
          slots_.push_back(matrix.entry(equations_[a], equations_[b]));
      slot_start_.push_back(slots_.size());
      for (int i = 0; i < dim; ++i)
        if (const Index e = dofs.equation(nodes_[k] * dim + i); e != IndexMap::constrained)
          diagonal_.push_back({k, matrix.entry(e, e)});
    }
  }
  /// Entries of its couplings at most.
  std::size_t coupling_entries() const { return equations_.size(); }

  /// Measures the body's stiffness at the nodes, before any contact is added to it.
  template <class Evaluation>
  void measure_body(const Evaluation& ev) {
    largest_.assign(nodes_.size(), 0.0);
    for (const auto& [k, entry] : diagonal_) largest_[k] = std::max(largest_[k], ev.matrix.value(entry));
    for (std::size_t k = 0; k < nodes_.size(); ++k) this->take_body_stiffness(k, largest_[k], ev.inertia_stiffness);
  }
  /// Adds what the forces that close relaxed constraints have beyond the constraint forces (theory.md, eq. 6.22).
  void add_closing_forces(Field& forces) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!relaxes_[k]) continue;
      const Vec<Real, components> beyond = scaled(pressures_[k].force, 1 / measured_closing - 1);
      Vec<Real, places> along;
      for (int i = 0; i < places; ++i) along[i] = beyond[1 + i];
      this->scatter(k, beyond[0], along, forces);
    }
  }

  /// Adds contact forces and their tangent.
  template <class Evaluation>
  Failure evaluate(const Evaluation& ev, Field& forces) {
    this->begin_evaluation();
    dt_ = ev.dt;
    relaxed_ = false;
    if (!this->take_positions(ev.u)) return {FailureCause::not_finite, {Location::Kind::contact_node, nodes_[0]}};
    if (ev.constraint_force) roundoff_ = this->gap_roundoff(ev.u);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (const FailureCause cause = evaluate_node(k, ev); cause != FailureCause::none)
        return {cause, {Location::Kind::contact_node, nodes_[k]}};
    this->take_gradients([&](std::size_t k) { return response_[k].touching; });
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (response_[k].touching)
        if (const FailureCause cause = add_node(k, ev, forces); cause != FailureCause::none)
          return {cause, {Location::Kind::contact_node, nodes_[k]}};
    if (ev.driven || ev.want == Want::tangent) add_curvature(ev, forces);
    trial_summary_.max_penetration = this->deepest_;
    this->end_evaluation();
    return {};
  }

  /// Square of the norm of what the round-off of the gaps makes of the pressures, where of the body's stiffness at a
  /// node no more than that share answers [force^2].
  Real gap_roundoff_squared(Real share) const {
    Real square = 0, softest = std::numeric_limits<Real>::infinity();
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (this->touches(k) && body_stiffness_[k] > 0) softest = std::min(softest, body_stiffness_[k]);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (this->touches(k)) square += std::pow(std::min(-pressures_[k].gradient[0], share * softest) * roundoff_, 2);
    return square;
  }

  /// Makes the last evaluation's memory and forces the converged ones; tractions go to the metric of the new
  /// configuration (theory.md, eq. 4.41).
  void commit() {
    if constexpr (with_friction)
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        if (!response_[k].touching) continue;
        Memory memory = memory_.trial(k);
        memory.friction.traction *= this->stretch(k);
        memory_.set_trial(k, memory);
      }
    this->commit_positions();
    Base::commit();
  }

 private:
  using Base::nodes_, Base::states_, Base::trial_summary_, Base::measures_, Base::enforcement_, Base::friction_,
      Base::pressures_, Base::memory_, Base::start_, Base::reversals_, Base::body_stiffness_, Base::relaxes_,
      Base::relaxed_, Base::dt_;
  using Response = ContactResponse<Real, places, Memory>;
  static constexpr bool triangle = matrix_storage<Model> == Symmetry::symmetric;

  static constexpr bool follows_pressure() {
    if constexpr (with_friction)
      return Friction::Law::depends_on_pressure && Friction::Pressure::follows_current;
    else
      return false;
  }
  static constexpr bool couples() {
    if constexpr (follows_pressure())
      return !is_symmetrised<typename Friction::Pressure>();
    else
      return false;
  }

  // The laws at a node.
  template <class Evaluation>
  FailureCause evaluate_node(std::size_t k, const Evaluation& ev) {
    const ContactNodeState<dim>& before = states_.converged(k);
    const Memory old = start_.at(k, memory_);
    const bool iterating = ev.constraint_force != nullptr;
    const Real gap = this->gap(k);
    Response& node = response_[k];
    Real penalty = 0;
    if (this->faces(k)) {
      const Real weight = this->weight(k);
      penalty = penalty_pressure(enforcement_, weight, gap, old);
      const Real pressure = iterating ? pressures_[k].value : penalty;
      node = contact_law<Real, places>(enforcement_, friction_, Friction{}, weight, gap, this->slip(k), old, pressure,
                                       ev.dt, this->area(k), iterating && reversals_.sticks(k, pressure, ev.again),
                                       this->stiffest(k, iterating));
      if (node.cause != FailureCause::none) return node.cause;
    } else {  // past an end of the master: nothing to touch
      node = {};
      if constexpr (with_friction) node.memory.friction.accumulated_slip = old.friction.accumulated_slip;
    }
    memory_.set_trial(k, start_.advance(k, node.memory, node.touching, node.pressure, memory_, ev.dt));
    ContactNodeState<dim> state{.gap = this->note_relaxed(k, node.relaxed, gap, node.pressure_residual),
                                .pressure = node.pressure,
                                .touching = node.touching,
                                .sliding = node.sliding};
    auto& unknown = pressures_[k];
    unknown = {};
    unknown.value = node.pressure;
    unknown.residual = node.pressure_residual;
    unknown.gradient[0] = -node.d_gap;
    const Real closing = node.pressure_residual * (node.relaxed ? measured_closing : 1);
    unknown.force[0] = -closing;
    if constexpr (with_friction) {
      if constexpr (follows_pressure())
        for (int i = 0; i < places; ++i) unknown.force[1 + i] = node.friction.d_pressure[i] * closing;
      if (iterating && !ev.again) {
        Vec<Real, places> slides = Vec<Real, places>::Zero();
        if (node.sliding) slides = node.friction.traction;
        reversals_.note(k, slides, node.sliding, penalty > 0);
      }
      state.accumulated_slip = node.memory.friction.accumulated_slip;
    }
    if (iterating) unknown.forget(4 * roundoff_ * std::abs(node.d_gap));
    states_.set_trial(k, state);
    this->note_node(before, state);
    return FailureCause::none;
  }

  // Adds a touching node's force and the part of its tangent that is dyads of gradients.
  template <class Evaluation>
  FailureCause add_node(std::size_t k, const Evaluation& ev, Field& forces) {
    const Response& node = response_[k];
    ContactNodeState<dim> state = states_.trial(k);
    state.force = this->force(k, -node.pressure, node.friction.traction);
    if (!is_finite(state.force)) return FailureCause::not_finite;
    states_.set_trial(k, state);
    this->note_touching(states_.converged(k), state, node);
    this->scatter(k, -node.pressure, node.friction.traction, forces);
    if (ev.constraint_force) {
      Vec<Real, places> along = node.to_stick;
      for (int i = 0; i < places; ++i) along[i] += pressures_[k].force[1 + i];
      this->scatter(k, pressures_[k].force[0], along, *ev.constraint_force);
    }
    const bool smooth = ev.want == Want::frictionless_tangent;
    if (ev.driven) {
      const Vec<Real, components> change = this->change_at(k, *ev.driven);
      Vec<Real, places> along = Vec<Real, places>::Zero();
      if constexpr (with_friction)
        for (int i = 0; i < places; ++i) {
          for (int j = 0; j < places; ++j) along[i] += node.friction.d_surface(i, j) * change[1 + j];
          if constexpr (couples()) along[i] -= node.friction.d_pressure[i] * node.d_gap * change[0];
        }
      this->scatter(k, node.d_gap * change[0], along, forces);
    }
    if (ev.want == Want::residual) return FailureCause::none;
    const std::size_t first = this->first_entry(k) * dim, count = this->stencil(k).size() * dim;
    std::size_t slot = slot_start_[k];
    for (std::size_t b = 0; b < count; ++b) {
      const Real gap = this->gap_slope(first + b) * node.d_gap;
      Real slip = 0, follow = 0;
      if constexpr (with_friction)
        if (!smooth) slip = this->slip_slope(first + b) * node.friction.d_surface(0, 0);
      if constexpr (couples() && !stores_couplings<Model>)
        if (!smooth) follow = -gap * node.friction.d_pressure[0];
      for (std::size_t a = triangle ? b : 0; a < count; ++a) {
        Real value = this->gap_slope(first + a) * gap;
        if constexpr (with_friction) value += this->slip_slope(first + a) * (slip + follow);
        ev.matrix.add(slots_[slot++], value);
      }
    }
    if constexpr (couples() && stores_couplings<Model>)
      if (node.sliding && !smooth) {
        const std::span<const Index> equations(equations_.data() + first, count);
        ev.couplings.add(
            equations,
            [&](Index i) {
              return this->slip_slope(first + static_cast<std::size_t>(i)) * node.friction.d_pressure[0];
            },
            [&](Index i) { return -this->gap_slope(first + static_cast<std::size_t>(i)) * node.d_gap; });
      }
    return FailureCause::none;
  }

  // Adds the curvature of the points' gaps and places under the tractions of their nodes.
  template <class Evaluation>
  void add_curvature(const Evaluation& ev, Field& forces) {
    this->for_each_point([&](std::size_t q, const auto& at, const auto& nodes) {
      Real normal = 0, along = 0;
      std::size_t k = 0;
      this->for_each_share(q, [&](std::size_t of, Real share) {
        k = of;  // whose stencil has the point's nodes
        if (!response_[of].touching) return;
        normal -= this->gap_part(of, share) * response_[of].pressure;
        if constexpr (with_friction) along += this->slip_part(q, of, share) * response_[of].friction.traction[0];
      });
      if (normal == 0 && along == 0) return;
      std::array<std::size_t, 4> local;
      for (std::size_t p = 0; p < 4; ++p) local[p] = (this->entry(k, nodes[p]) - this->first_entry(k)) * dim;
      const std::size_t count = this->stencil(k).size() * dim;
      for (std::size_t p = 0; p < 4; ++p)
        for (std::size_t r = 0; r < 4; ++r) {
          const Mat<Real, dim> block = at.foot.curvature(p, r, normal, along);
          if (ev.driven) add_at_node<dim>(forces, nodes[p], product(block, at_node<dim>(*ev.driven, nodes[r])));
          if (ev.want != Want::tangent) continue;
          for (int j = 0; j < dim; ++j)
            for (int i = 0; i < dim; ++i) {
              const std::size_t a = local[p] + static_cast<std::size_t>(i), b = local[r] + static_cast<std::size_t>(j);
              if (triangle && a < b) continue;
              const std::size_t slot = triangle ? b * count - b * (b + 1) / 2 + a : b * count + a;
              ev.matrix.add(slots_[slot_start_[k] + slot], block(i, j));
            }
        }
    });
  }

  std::vector<Response> response_;
  std::vector<Index> equations_, slots_;  // of the entries of stencils, by component; of the blocks over them
  std::vector<std::size_t> slot_start_;
  std::vector<std::pair<std::size_t, Index>> diagonal_;  // node and entry of its free components
  std::vector<Real> largest_;                            // of the body at the nodes
  Real roundoff_ = 0;                                    // of a gap
};

}  // namespace stickslip
