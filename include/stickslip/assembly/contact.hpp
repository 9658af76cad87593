// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/contact_kernel.hpp>
#include <stickslip/assembly/facet.hpp>
#include <stickslip/assembly/sparse_matrix.hpp>
#include <stickslip/geometry/pose.hpp>
#include <stickslip/geometry/profile.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/policy/model.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// A side of the body against a rigid tool: what the user says of it.
template <class Model>
struct Contact {
  static constexpr int dim = Model::Kinematics::dim;

  std::string side;             ///< named side of the mesh
  rigid::Profile tool;          ///< in its own frame
  rigid::Motion<dim> motion{};  ///< the frame's pose over time
  [[no_unique_address]] Only<has_friction<Model>, typename Model::Friction::Law, Contact>
      friction{};                             ///< parameters of the law
  typename Model::Enforcement enforcement{};  ///< parameters of the enforcement
  std::string name = "";  ///< for results; the side's name if empty. Not {}: GCC 12 breaks down where it is left out
};

/// What a pair did in the last assembly.
struct ContactSummary {
  Index touching = 0;        ///< nodes in contact
  Index sliding = 0;         ///< of them, nodes that slide
  Real max_penetration = 0;  ///< [length]
  Real max_slip = 0;         ///< largest slid distance of a node so far [length]
  Real bound = 0;       ///< sum of the friction forces that the nodes could bear at their current pressures [force]
  Real lag = 0;         ///< sum of the changes of these that the law has not seen yet [force]
  Real dissipated = 0;  ///< by friction in the step [energy]

  void merge(const ContactSummary& other) {
    touching += other.touching;
    sliding += other.sliding;
    max_penetration = std::max(max_penetration, other.max_penetration);
    max_slip = std::max(max_slip, other.max_slip);
    bound += other.bound;
    lag += other.lag;
    dissipated += other.dissipated;
  }
};

/// A contact node at a converged state.
template <int dim>
struct ContactNodeState {
  Vec<Real, dim> force = Vec<Real, dim>::Zero();  ///< of the node on the tool [force]
  Real gap = 0;                                   ///< [length]
  Real slip = 0;                                  ///< slid distance so far [length]; 0 without friction
  bool touching = false;
};

/// A side of the body in contact with one rigid tool: memory of its nodes and the loop over them.
template <class Model>
class ContactPair {
 public:
  using Friction = typename Model::Friction;
  using Enforcement = typename Model::Enforcement;
  static constexpr int dim = Model::Kinematics::dim;
  using Memory = NodeMemory<Real, dim, Enforcement, Friction>;
  using Matrix = SparseMatrix<matrix_storage<Model>>;
  static constexpr bool remembers = !std::is_empty_v<Memory>;
  /// Whether the friction law looks at the area that a node carries.
  static constexpr bool takes_area = [] {
    if constexpr (has_friction<Model>)
      return depends_on_area<typename Friction::Law>();
    else
      return false;
  }();
  /// Bytes that a contact node keeps for one state (there are two: converged and trial).
  static constexpr std::size_t bytes_per_node = remembers ? sizeof(Memory) : 0;

  template <class MeshType>
  ContactPair(const Contact<Model>& contact, const MeshType& mesh, const typename Model::Kinematics& kinematics)
      : contact_(contact),
        nodes_(mesh.side(contact.side).nodes),
        weight_(nodes_.size(), 0.0),
        states_(nodes_.size()),
        trial_states_(nodes_.size()),
        pressures_(nodes_.size()) {
    if (contact_.name.empty()) contact_.name = contact_.side;
    if (contact_.tool.empty())
      throw std::invalid_argument("contact \"" + contact_.name + "\": the tool has no surface");
    if constexpr (requires { contact_.enforcement.validate(); }) contact_.enforcement.validate();
    if constexpr (has_friction<Model>)
      if constexpr (requires { contact_.friction.validate(); }) contact_.friction.validate();
    if constexpr (has_friction<Model>)
      if (!(contact_.enforcement.stick_stiffness(1) > 0))
        throw std::invalid_argument("contact \"" + contact_.name +
                                    "\": friction needs a positive tangential stiffness");
    if constexpr (remembers) {
      committed_.resize(nodes_.size());
      trial_.resize(nodes_.size());
    }
    weigh(mesh, kinematics);
  }

  const std::string& name() const { return contact_.name; }
  const Contact<Model>& contact() const { return contact_; }
  const std::vector<Index>& nodes() const { return nodes_; }
  /// The nodes at the converged state.
  const std::vector<ContactNodeState<dim>>& states() const { return states_; }
  /// What happened in the last assembly.
  const ContactSummary& summary() const { return summary_; }
  /// Total force on the tool at the converged state.
  const Vec<Real, dim>& force() const { return force_; }

  void connect(const Dofs& equations, const Matrix& matrix) {
    slots_.clear();
    for (const Index n : nodes_) slots_.push_back(matrix.map(equations, components(n)));
  }

  static std::array<Index, static_cast<std::size_t>(dim)> components(Index node) {
    std::array<Index, static_cast<std::size_t>(dim)> c;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = node * dim + static_cast<Index>(i);
    return c;
  }

  /// Takes the positions at `time` for the start of sliding.
  template <class MeshType>
  Trouble start(const MeshType& mesh, const Field& u, Real time) {
    const rigid::Pose<dim> pose = contact_.motion.at(time);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const SurfacePoint<Real, dim> at = closest(mesh, u, pose, nodes_[k]);
      if (!std::isfinite(at.gap)) return {Cause::not_finite, {Place::Kind::contact_node, nodes_[k]}};
      states_[k].gap = at.gap;
      if constexpr (has_friction<Model>) committed_[k].friction.place = at.place;
    }
    return {};
  }

  /// Begins an iteration: the pressures of the converged state become variables of their own.
  void begin_iteration() { pressures_.begin(); }
  /// Makes the pressures follow the change du of the displacements.
  void follow(const Field& du) {
    for (std::size_t k = 0; k < nodes_.size(); ++k) pressures_.follow(k, du.template segment<dim>(nodes_[k] * dim));
  }
  void move(Real length) { pressures_.move(length); }
  Real openness() const { return pressures_.openness(); }

  /// Adds contact forces and their tangent at the nodal displacements u and `time`. With `excess`, at the pressures of
  /// the iteration, and it takes the forces that closing their defects adds.
  template <class MeshType>
  Trouble assemble(const MeshType& mesh, const Field& u, Real time, Real dt, const Field* driven, Field& forces,
                   Field* excess, Matrix& matrix) {
    const rigid::Pose<dim> pose = contact_.motion.at(time);
    summary_ = {};
    trial_force_.setZero();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const Index n = nodes_[k];
      const SurfacePoint<Real, dim> at = closest(mesh, u, pose, n);
      if (!std::isfinite(at.gap)) return {Cause::not_finite, {Place::Kind::contact_node, n}};
      Memory old{};
      if constexpr (remembers) old = committed_[k];
      Vec<Real, dim - 1> slipped = Vec<Real, dim - 1>::Zero();
      if constexpr (has_friction<Model>) slipped[0] = contact_.tool.difference(at.place[0], old.friction.place[0]);
      const Real pressure = excess ? pressures_[k].value : settled_pressure(contact_.enforcement, weight_[k], at, old);
      const auto node = contact_node<Real, dim>(contact_.enforcement, contact_.friction, Friction{}, weight_[k], at,
                                                slipped, old, pressure, dt, area(k));
      if (node.cause != Cause::none) return {node.cause, {Place::Kind::contact_node, n}};
      if constexpr (remembers) trial_[k] = node.memory;

      ContactNodeState<dim>& state = trial_states_[k];
      state.gap = at.gap;
      state.touching = node.touching;
      state.force.setZero();
      pressures_[k] = node.pressure;
      if constexpr (has_friction<Model>) {
        state.slip = node.memory.friction.slip;
        summary_.max_slip = std::max(summary_.max_slip, state.slip);
      }
      if (!node.touching) continue;
      state.force = pose.rotation * node.force;
      Mat<Real, dim> stiffness = pose.rotation * node.stiffness * pose.rotation.transpose();
      if (!state.force.allFinite() || !stiffness.allFinite())
        return {Cause::not_finite, {Place::Kind::contact_node, n}};
      forces.template segment<dim>(n * dim) += state.force;
      if (excess) {
        pressures_[k].slope = pose.rotation * node.pressure.slope;
        pressures_[k].excess = pose.rotation * node.pressure.excess;
        excess->template segment<dim>(n * dim) += pressures_[k].excess;
      }
      if (driven) forces.template segment<dim>(n * dim) += stiffness * driven->template segment<dim>(n * dim);
      matrix.add(slots_[k], stiffness);

      trial_force_ += state.force;
      ++summary_.touching;
      summary_.sliding += node.sliding ? 1 : 0;
      summary_.max_penetration = std::max(summary_.max_penetration, -at.gap);
      summary_.bound += node.bound;
      summary_.lag += std::abs(node.lag);
      summary_.dissipated += node.dissipated;
    }
    return {};
  }

  /// Energy that penetration and sticking store at the converged state, where the enforcement tells it.
  Real stored_energy() const requires requires(const Enforcement& e) { e.energy(Real(), Real()); }
  {
    Real sum = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!states_[k].touching) continue;
      sum += contact_.enforcement.energy(states_[k].gap, weight_[k]);
      if constexpr (has_friction<Model>)
        sum += 0.5 * committed_[k].friction.traction.squaredNorm() / contact_.enforcement.stick_stiffness(weight_[k]);
    }
    return sum;
  }

  /// Makes the memory and the forces of the last assembly the converged ones.
  void commit() {
    if constexpr (remembers) std::swap(committed_, trial_);
    std::swap(states_, trial_states_);
    pressures_.commit();
    force_ = trial_force_;
  }

 private:
  template <class MeshType>
  SurfacePoint<Real, dim> closest(const MeshType& mesh, const Field& u, const rigid::Pose<dim>& pose,
                                  Index node) const {
    const Vec<Real, dim> x = mesh.nodes[static_cast<std::size_t>(node)] + u.template segment<dim>(node * dim);
    return contact_.tool.closest(Vec<Real, dim>(pose.rotation.transpose() * (x - pose.translation)));
  }

  // Reference area that a node carries, where the friction law asks for it.
  Real area([[maybe_unused]] std::size_t k) const {
    if constexpr (takes_area)
      return areas_[k];
    else
      return 0;
  }

  // The measure behind one unit of nodal stiffness, and the areas.
  template <class MeshType>
  void weigh(const MeshType& mesh, const typename Model::Kinematics& kinematics) {
    const PenaltyPer per = contact_.enforcement.per;
    if (per == PenaltyPer::node) std::fill(weight_.begin(), weight_.end(), 1.0);
    if (per == PenaltyPer::unit_depth)
      std::fill(weight_.begin(), weight_.end(),
                Model::Kinematics::hoop ? 2 * pi : kinematics.measure(mesh.nodes[static_cast<std::size_t>(nodes_[0])]));
    const auto add_areas = [&](std::vector<Real>& sums) {
      for (std::size_t k = 0; k < nodes_.size(); ++k)
        for (const auto& facet : mesh.side(contact_.side).facets)
          sums[k] += facet_share(mesh, kinematics, facet, nodes_[k]);
    };
    if (per == PenaltyPer::area) add_areas(weight_);
    if constexpr (takes_area) {
      areas_.assign(nodes_.size(), 0.0);
      add_areas(areas_);
    }
  }

  Contact<Model> contact_;
  std::vector<Index> nodes_;
  std::vector<Real> weight_;
  [[no_unique_address]] Only<takes_area, std::vector<Real>, Model> areas_;
  std::vector<ContactNodeState<dim>> states_, trial_states_;
  StiffRelations<dim> pressures_;
  [[no_unique_address]] Only<remembers, std::vector<Memory>, ContactPair> committed_;
  [[no_unique_address]] Only<remembers, std::vector<Memory>, ContactSummary> trial_;
  std::vector<std::array<Index, static_cast<std::size_t>(Matrix::block_entries(dim))>> slots_;
  ContactSummary summary_;
  Vec<Real, dim> force_ = Vec<Real, dim>::Zero(), trial_force_ = Vec<Real, dim>::Zero();
};

}  // namespace stickslip
