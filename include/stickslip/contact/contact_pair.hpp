// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/contact/contact_history.hpp>
#include <stickslip/dofs/evaluation.hpp>
#include <stickslip/dofs/node_couplings.hpp>
#include <stickslip/dofs/sparse_matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <list>
#include <vector>

namespace stickslip {

namespace detail {
template <class Model, class Friction, class Skills = ContactSkills<typename Model::Enforcement, Friction>>
using ToolHistory =
    ContactHistory<typename Model::Enforcement, Friction,
                   ContactNodes<Model::Kinematics::dim, ToolOf<Model>, Skills::friction, Skills::takes_area>>;
}  // namespace detail

/// The contact term of one side of a body on one rigid tool: its stencils are the side's nodes, its kernel is
/// contact_node.
template <class Model, class Friction_ = typename Model::Friction>
class ContactPair : public detail::ToolHistory<Model, Friction_> {
 public:
  using Base = detail::ToolHistory<Model, Friction_>;
  using Base::with_friction, Base::dim;
  using typename Base::Friction, typename Base::Memory, typename Base::Point, typename Base::Pose;
  static_assert(RigidTool<ToolOf<Model>, dim>,
                "stickslip: the model's Tool does not meet RigidTool of its dimension; see docs/policies.md, section "
                "Tool.");
  using Matrix = SparseMatrix<matrix_storage<Model>>;

  /// Throws std::invalid_argument, naming the contact, for parameters that cannot be.
  template <class BodiesType>
  ContactPair(const Contact<Model, Friction>& contact, const BodiesType& bodies)
      : Base(contact, bodies), gap_roundoff_(nodes_.size(), 0.0) {}
  ContactPair(const ContactPair&) = delete;
  ContactPair& operator=(const ContactPair&) = delete;

  /// Its stencils are of single nodes, which the bodies couple, and stay.
  static constexpr bool update(const Field&, const Field&) { return false; }
  static void couple(SparsityPattern&) {}
  /// Entries of its couplings at most.
  std::size_t coupling_entries() const { return nodes_.size() * static_cast<std::size_t>(dim); }
  /// Calls visit(node) for the nodes that touch; with `ever` for all.
  template <class Visit>
  void for_each_held(bool ever, Visit&& visit) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (ever || this->touches(k)) visit(nodes_[k]);
  }
  /// Makes the scatter maps into a matrix.
  void connect(const IndexMap& dofs, const Matrix& matrix) {
    slots_.clear();
    for (const Index n : nodes_) slots_.push_back(matrix.map(dofs, components(n)));
    if constexpr (stores_couplings<Model>) {
      equations_.clear();
      for (const Index n : nodes_) {
        equations_.push_back(components(n));
        for (Index& e : equations_.back()) e = dofs.equation(e);
      }
    }
  }
  /// Measures the body's stiffness at the nodes, before any contact is added to it.
  template <class Evaluation>
  void measure_body(const Evaluation& ev) {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      this->take_body_stiffness(k, ev.matrix.template largest_diagonal<dim>(slots_[k]), ev.inertia_stiffness);
  }
  /// Adds what the forces that close relaxed constraints have beyond the constraint forces (theory.md, eq. 6.22).
  void add_closing_forces(Field& forces) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (relaxes_[k]) add_at_node(forces, nodes_[k], Point(scaled(pressures_[k].force, 1 / measured_closing - 1)));
  }

  /// Adds contact forces and their tangent.
  template <class Evaluation>
  Failure evaluate(const Evaluation& ev, Field& forces) {
    const Pose pose = motion_.at(ev.time);
    if (const Failure f = this->not_rigid(pose)) return f;
    this->begin_evaluation();
    dt_ = ev.dt;
    relaxed_ = false;
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (const FailureCause cause = evaluate_node(k, pose, ev, forces); cause != FailureCause::none)
        return {cause, {Location::Kind::contact_node, nodes_[k]}};
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
      if (this->touches(k))
        square += std::pow(std::min(pressures_[k].gradient.norm(), share * softest) * gap_roundoff_[k], 2);
    return square;
  }

 private:
  using Base::motion_, Base::nodes_, Base::states_, Base::trial_summary_, Base::measures_, Base::enforcement_,
      Base::friction_, Base::pressures_, Base::memory_, Base::start_, Base::reversals_, Base::body_stiffness_,
      Base::relaxes_, Base::relaxed_, Base::dt_;
  using Block = Mat<Real, dim>;
  using Components = std::array<Index, static_cast<std::size_t>(dim)>;

  static Components components(Index node) {
    Components c;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = node * dim + static_cast<Index>(i);
    return c;
  }
  static Block turned(const Pose& pose, const Block& stiffness) {
    return product_transposed(product(pose.rotation, stiffness), pose.rotation);
  }

  template <class Evaluation>
  FailureCause evaluate_node(std::size_t k, const Pose& pose, const Evaluation& ev, Field& forces) {
    const Point x = this->position(ev.u, k);
    SurfacePoint<Real, dim> at = this->closest(pose.on_tool(x));
    if (!std::isfinite(at.gap)) return FailureCause::not_finite;
    const bool iterating = ev.constraint_force != nullptr;
    Memory old = start_.at(k, memory_);
    const Real penalty = penalty_pressure(enforcement_, measures_.tributary()[k], at.gap, old);
    const Real pressure = iterating ? pressures_[k].value : penalty;
    Vec<Real, surface_coordinates<dim>> slip = Vec<Real, surface_coordinates<dim>>::Zero();
    bool followed = false;
    if constexpr (with_friction) {
      slip = relative_displacement<Real, dim>(this->tool_, at.surface_coordinate, old.friction.surface_coordinate);
      if (penalty > 0 || pressure > 0) {
        followed = this->paths_.followed() && ev.time == this->along_.end();
        if (followed && !this->paths_.follow(k, this->tool_, this->along_, x, at, this->stick_stiffness(k),
                                             old.friction.surface_coordinate, old.friction.traction, slip))
          return FailureCause::not_finite;
        if constexpr (dim == 3) add_surface_curvature(this->tool_, pose.on_tool(x), at);
      }
    }
    const auto node = contact_node<Real, dim>(
        enforcement_, friction_, Friction{}, measures_.tributary()[k], at, slip, old, pressure, ev.dt,
        measures_.area(k), iterating && reversals_.sticks(k, pressure, ev.again), this->stiffest(k, iterating));
    if (node.cause != FailureCause::none) return node.cause;
    memory_.set_trial(k, start_.advance(k, node.memory, node.touching, node.pressure.value, memory_, ev.dt));
    const ContactNodeState<dim>& before = states_.converged(k);
    ContactNodeState<dim> state{.gap = at.gap,
                                .pressure = node.touching ? node.pressure.value : 0,
                                .touching = node.touching,
                                .sliding = node.sliding};
    pressures_[k] = node.pressure;
    state.gap = this->note_relaxed(k, node.relaxed, at.gap, node.pressure.residual);
    if constexpr (with_friction) {
      if (iterating && !ev.again) reversals_.note(k, node.friction_force, node.sliding, penalty > 0);
      state.accumulated_slip = node.memory.friction.accumulated_slip;
      if (node.touching && followed)
        this->note_turn(
            this->paths_.turn(node.sliding, node.bound, this->stick_stiffness(k), 1e-3 * measures_.spacing(k)),
            nodes_[k]);
    }
    if (node.touching) state.force = product(pose.rotation, node.force);
    states_.set_trial(k, state);
    this->note_node(before, state);
    if (!node.touching) return FailureCause::none;
    this->note_touching(before, state, node);
    return add_node(k, pose, ev, at, node, state.force, forces);
  }

  // Adds a touching node's force and tangent.
  template <class Evaluation, class Node>
  FailureCause add_node(std::size_t k, const Pose& pose, const Evaluation& ev, const SurfacePoint<Real, dim>& at,
                        const Node& node, const Point& force, Field& forces) {
    const Index n = nodes_[k];
    Block whole = node.stiffness;
    add(whole, node.coupling());
    if (ev.want == Want::frictionless_tangent)
      whole = scaled(product_transposed(at.normal, at.normal), at.normal.dot(product(whole, at.normal)));
    whole = turned(pose, whole);
    if (!is_finite(force) || !is_finite(whole)) return FailureCause::not_finite;
    add_at_node(forces, n, force);
    if (ev.constraint_force) {
      pressures_[k].gradient = product(pose.rotation, node.pressure.gradient);
      pressures_[k].force = product(pose.rotation, node.pressure.force);
      gap_roundoff_[k] = gap_roundoff(at_node<dim>(ev.u, n), this->X_[static_cast<std::size_t>(n)], pose, at);
      pressures_[k].forget(4 * gap_roundoff_[k] * pressures_[k].gradient.norm());
      add_at_node(*ev.constraint_force, n, pressures_[k].force);
      if constexpr (with_friction)
        add_at_node(*ev.constraint_force, n, Point(product(pose.rotation, node.stick_force)));
    }
    if (ev.driven) add_at_node(forces, n, Point(product(whole, at_node<dim>(*ev.driven, n))));
    if (ev.want == Want::residual) return FailureCause::none;
    if constexpr (stores_couplings<Model>) {
      const bool smooth = ev.want == Want::frictionless_tangent;
      ev.matrix.add(slots_[k], smooth ? whole : turned(pose, node.stiffness));
      if (node.sliding && !smooth)
        ev.couplings.add(equations_[k], product(pose.rotation, node.friction_by_pressure),
                         product(pose.rotation, node.pressure.gradient));
    } else {
      ev.matrix.add(slots_[k], whole);
    }
    return FailureCause::none;
  }

  // Round-off of a gap [length]: that of the largest numbers that it is the difference of.
  static Real gap_roundoff(const Point& u, const Point& X, const Pose& pose, const SurfacePoint<Real, dim>& at) {
    Real reach = std::max(X.norm() + u.norm(), pose.translation.norm());
    // To the tool's centre; the curvature of a plane is round-off itself.
    if (const Real bend = at.hess_gap.norm(); bend * reach > 1e-8) reach = std::max(reach, 1 / bend);
    return std::numeric_limits<Real>::epsilon() * reach;
  }

  std::vector<Real> gap_roundoff_;  // of touching nodes
  std::vector<std::array<Index, static_cast<std::size_t>(Matrix::block_entries(dim))>> slots_;
  [[no_unique_address]] StoredIf<stores_couplings<Model>, std::vector<Components>, ContactPair> equations_;
};

namespace detail {
// A list: its pairs stay where they are, and growing it takes no code that moves them.
template <class Model, class Friction>
using PairList = std::list<ContactPair<Model, Friction>>;
}  // namespace detail

namespace detail {
template <class Model, class ToolPairs, class Surfaces, bool active = Surfaces::active>
struct AllPairs {
  using type = ToolPairs;
};
template <class Model, class ToolPairs, class Surfaces>
struct AllPairs<Model, ToolPairs, Surfaces, true> {
  using type = std::tuple<ToolPairs, std::list<typename Surfaces::template Pair<Model>>>;
};
template <class Model>
using ToolPairs = typename ContactLists<Model, typename Model::Friction, PairList>::type;
}  // namespace detail

/// The pairs that the contacts of a model become: those on tools, and those between surfaces where it has them.
template <class Model>
using ContactPairs = typename detail::AllPairs<Model, detail::ToolPairs<Model>, SurfacesOf<Model>>::type;

}  // namespace stickslip
