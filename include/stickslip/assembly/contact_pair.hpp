// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/contact.hpp>
#include <stickslip/assembly/contact_kernel.hpp>
#include <stickslip/assembly/contact_record.hpp>
#include <stickslip/assembly/facet.hpp>
#include <stickslip/assembly/followed_slide.hpp>
#include <stickslip/assembly/node_couplings.hpp>
#include <stickslip/assembly/persistency.hpp>
#include <stickslip/assembly/sparse_matrix.hpp>
#include <stickslip/base/brief.hpp>
#include <stickslip/base/nodal.hpp>
#include <stickslip/base/relaxation.hpp>
#include <stickslip/geometry/passage.hpp>
#include <stickslip/geometry/pose.hpp>
#include <stickslip/geometry/tool.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/policy/model.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <list>
#include <string>
#include <vector>

namespace stickslip {

/// A side of the body in contact with one rigid tool: memory of its nodes and the loop over them.
template <class Model, class Friction_ = typename Model::Friction>
class ContactPair : public ContactRecord<Model::Kinematics::dim> {
 public:
  using Friction = Friction_;
  using Enforcement = typename Model::Enforcement;
  using Tool = ToolOf<Model>;
  static constexpr int dim = Model::Kinematics::dim;
  static_assert(RigidTool<Tool, dim>,
                "stickslip: the bundle's Tool does not meet RigidTool of its dimension; see docs/policies.md, section "
                "Tool.");
  using Memory = NodeMemory<Real, dim, Enforcement, Friction>;
  using Matrix = SparseMatrix<matrix_storage<Model>>;
  static constexpr bool with_friction = Friction::active;
  static constexpr bool remembers = !std::is_empty_v<Memory>;
  /// Whether steps take several passes for this pair.
  static constexpr bool passes = is_augmented<Enforcement> || friction_is_iterated<Friction>;
  /// Whether the bound lags behind the pressure, and can be told what to see.
  static constexpr bool lags = friction_lags<Friction>;
  /// Whether passes bring the bound up to date.
  static constexpr bool iterates = friction_is_iterated<Friction>;
  /// Whether the friction law looks at the area that a node carries.
  static constexpr bool takes_area = [] {
    if constexpr (with_friction)
      return depends_on_area<typename Friction::Law>();
    else
      return false;
  }();
  /// Whether what the tangent lacks is found out by probes of the residual.
  static constexpr bool probed = friction_is_symmetrised<Friction>;
  /// Bytes that a contact node keeps for one state (there are two: converged and trial).
  static constexpr std::size_t bytes_per_node = remembers ? sizeof(Memory) : 0;

  template <class MeshType>
  ContactPair(const Contact<Model, Friction>& contact, const MeshType& mesh,
              const typename Model::Kinematics& kinematics)
      : ContactRecord<dim>(contact.name, contact.side, contact.motion, mesh.side(contact.side).nodes),
        tool_(contact.tool),
        friction_(contact.friction),
        enforcement_(contact.enforcement),
        start_depth_(contact.start_depth),
        weight_(nodes_.size(), 0.0),
        pressures_(nodes_.size()),
        blur_(nodes_.size(), 0.0),
        stiffness_(nodes_.size(), 0.0) {
    if (tool_.empty()) this->refuse("the tool has no surface");
    if (!(start_depth_ >= 0)) this->refuse("start_depth must not be negative");
    if constexpr (requires { enforcement_.validate(); }) enforcement_.validate();
    if constexpr (with_friction)
      if constexpr (requires { friction_.validate(); }) friction_.validate();
    if constexpr (with_friction)
      if (!(enforcement_.stick_stiffness(1) > 0)) this->refuse("friction needs a positive tangential stiffness");
    if constexpr (remembers) {
      committed_.resize(nodes_.size());
      trial_.resize(nodes_.size());
    }
    if constexpr (is_augmented<Enforcement>) stiffened_ = 1;
    if constexpr (with_friction) turning_.resize(nodes_.size());
    if constexpr (passes || lags) renewed_.resize(nodes_.size());
    if constexpr (lags) {
      felt_.setZero(static_cast<Index>(nodes_.size()));
      changes_ = felt_;
      own_.pressure.resize(nodes_.size(), 0.0);
      own_.change = own_.pressure;
    }
    spacing_ = spacings(mesh, this->side_);
    weigh(mesh, kinematics);
  }

  const Tool& tool() const { return tool_; }
  const Enforcement& enforcement() const { return enforcement_; }

  void connect(const Dofs& equations, const Matrix& matrix) {
    slots_.clear();
    for (const Index n : nodes_) slots_.push_back(matrix.map(equations, components(n)));
    if constexpr (keeps_couplings<Model>) {
      equations_.clear();
      for (const Index n : nodes_) {
        equations_.push_back(components(n));
        for (Index& e : equations_.back()) e = equations.equation(e);
      }
    }
  }

  /// Whether the penalties are in parts of the body's stiffness, which `measure` must tell before the first assembly.
  bool needs_stiffness() const { return enforcement_.per == PenaltyPer::stiffness; }
  /// Takes the body's stiffness at the nodes from its tangent: the mean over the free components; where a node has
  /// none, the mean over the side.
  void measure(const Dofs& equations, const Matrix& tangent) {
    Real sum = 0;
    Index found = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      Real trace = 0;
      Index free = 0;
      for (const Index c : components(nodes_[k]))
        if (const Index e = equations.equation(c); e != Dofs::constrained) {
          trace += tangent.diagonal(e);
          ++free;
        }
      weight_[k] = free > 0 && trace > 0 ? trace / free : 0;
      sum += weight_[k];
      found += weight_[k] > 0 ? 1 : 0;
    }
    if (found == 0) this->refuse("the body has no stiffness at any of its nodes; give the penalty another unit");
    for (Real& w : weight_)
      if (w == 0) w = sum / found;
  }

  static std::array<Index, static_cast<std::size_t>(dim)> components(Index node) {
    std::array<Index, static_cast<std::size_t>(dim)> c;
    for (std::size_t i = 0; i < c.size(); ++i) c[i] = node * dim + static_cast<Index>(i);
    return c;
  }

  /// The warning that nodes are too far apart for the tool, three times its smallest size: they may step over it. Empty
  /// where they are not, or the tool does not tell its size.
  std::string warning_of_size() const {
    if constexpr (requires { tool_.smallest_size(); }) {
      const Real size = tool_.smallest_size(), spacing = *std::min_element(spacing_.begin(), spacing_.end());
      if (size < spacing / 3)
        return "contact \"" + name_ + "\": the tool's smallest size, " + brief(size) +
               ", is less than a third of the distance of the nodes of side \"" + this->side_ + "\", " +
               brief(spacing) + ": they may step over it or snap around it";
    }
    return "";
  }

  /// Takes the positions at `time` for the start of sliding. Throws std::invalid_argument where the tool is nowhere, or
  /// nodes lie deeper inside it than their neighbours are away: a tool the wrong way round, or one that ends too early,
  /// so that nodes past its end lie behind it.
  template <class MeshType>
  void start(const MeshType& mesh, const Field& u, Real time) {
    const rigid::Pose<dim> pose = motion_.at(time);
    if (const Trouble t = stretched(pose)) this->refuse(describe(t.cause));
    std::size_t worst = 0;
    Real excess = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const SurfacePoint<Real, dim> at = seen_from_tool(mesh, u, pose, nodes_[k]);
      if (!std::isfinite(at.gap)) this->refuse("the tool's position or the distance to it is not finite at the start");
      states_[k].gap = at.gap;
      if constexpr (with_friction) committed_[k].friction.place = at.place;
      if (const Real e = -at.gap - std::max(spacing_[k], start_depth_) * (1 + 1e-9); e > excess) worst = k, excess = e;
    }
    if (excess > 0)
      this->refuse("node " + std::to_string(nodes_[worst]) + " starts " + brief(-states_[worst].gap) +
                   " deep inside the tool, and its next neighbour is " + brief(spacing_[worst]) +
                   " away: the tool is the wrong way round (the body must be on the left of a chain, or where normals "
                   "point), or ends too early; for so deep a fit set start_depth");
    if constexpr (passes || lags) begin_passes();
  }

  /// Begins an iteration: the pressures of the converged state become variables of their own.
  void begin_iteration() {
    pressures_.begin();
    if constexpr (with_friction) {
      std::fill(turning_.begin(), turning_.end(), Turning{});
      catches_ = false;
    }
    if constexpr (probed) start_.probing = false;
    if constexpr (lags)
      if (own_.taken) set_out_from_known();
  }
  /// Makes the pressures follow the change du of the displacements, and close a share of their defects.
  void follow(const Field& du, Real closing) {
    for (std::size_t k = 0; k < nodes_.size(); ++k) pressures_.follow(k, at_node<dim>(du, nodes_[k]), closing);
    if constexpr (with_friction) turn(closing == 0);
    if constexpr (lags)
      if (closing != 0) look_ahead();
  }
  void move(Real length) { pressures_.move(length); }

  /// Square of the norm of what the round-off of the gaps makes of the pressures, where of the body's stiffness at a
  /// node no more than that share answers [force^2].
  Real blurred(Real share) const {
    Real square = 0, softest = std::numeric_limits<Real>::infinity();
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (trial_states_[k].touching && stiffness_[k] > 0) softest = std::min(softest, stiffness_[k]);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (trial_states_[k].touching)
        square += std::pow(std::min(pressures_[k].slope.norm(), share * softest) * blur_[k], 2);
    return square;
  }
  /// The largest stiffness of sticking at any node; 0 without friction [force / length].
  Real stickiest() const {
    Real largest = 0;
    if constexpr (with_friction)
      for (const Real w : weight_) largest = std::max(largest, enforcement_.stick_stiffness(w));
    return largest;
  }
  /// The larger of the stiffnesses of contact and sticking at any node [force / length].
  Real stiffest() const {
    Real largest = stickiest();
    for (const Real w : weight_) largest = std::max(largest, enforcement_.normal_force(Real(-1), w, {}).d_gap);
    return largest;
  }
  Real openness() const { return pressures_.openness(); }

  /// Adds contact forces and their tangent at the nodal displacements u and `time`. With `excess`, at the pressures of
  /// the iteration, and it takes the forces that closing their defects adds. If `smooth`, the tangent is the normal
  /// part alone.
  template <class MeshType, class Couplings>
  Trouble assemble(const MeshType& mesh, const Field& u, Real time, Real dt, const Field* driven, Field& forces,
                   Field* excess, Matrix& matrix, [[maybe_unused]] Couplings& couplings, bool smooth = false) {
    const rigid::Pose<dim> pose = motion_.at(time);
    if (const Trouble t = stretched(pose)) return t;
    trial_summary_ = {};
    if constexpr (lags) dt_ = dt;
    [[maybe_unused]] bool followed = false;
    if constexpr (with_friction) followed = follows_ && time == along_.end();
    trial_force_.setZero();
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const Index n = nodes_[k];
      SurfacePoint<Real, dim> at = seen_from_tool(mesh, u, pose, n);
      if (!std::isfinite(at.gap)) return {Cause::not_finite, {Place::Kind::contact_node, n}};
      Memory old{};
      if constexpr (remembers) old = start_of_pass(k, dt);
      Vec<Real, place_components<dim>> slipped = Vec<Real, place_components<dim>>::Zero();
      if constexpr (with_friction) slipped = moved<Real, dim>(tool_, at.place, old.friction.place);
      const Real settled = settled_pressure(enforcement_, weight_[k], at, old);
      const Real pressure = excess ? pressures_[k].value : settled;
      [[maybe_unused]] FollowedSlide<dim> way;
      if constexpr (with_friction)
        if (followed && (settled > 0 || pressure > 0)) {
          way = follow_slide<dim>(tool_, along_, departures_[k], own_way(mesh, u, k), at, old.friction.traction,
                                  old.friction.place, enforcement_.stick_stiffness(weight_[k]));
          if (!way.finite) return {Cause::not_finite, {Place::Kind::contact_node, n}};
          slipped = way.slide;
          old.friction.traction = way.traction;
        }
      if constexpr (with_friction && dim == 3)
        if (settled > 0 || pressure > 0) add_curvature_of_place(tool_, on_tool(mesh, u, pose, n), at);
      const auto node = contact_node<Real, dim>(enforcement_, friction_, Friction{}, weight_[k], at, slipped, old,
                                                pressure, dt, area(k), excess && held(k, pressure));
      if (node.cause != Cause::none) return {node.cause, {Place::Kind::contact_node, n}};
      if constexpr (remembers) trial_[k] = node.memory;
      if constexpr (lags)
        if (node.touching && takes_own(k, dt))  // what it remembers of the steps before stays the base of its trend
          trial_[k].friction.pressure =
              Friction::Pressure::advance(node.pressure.value, committed_[k].friction.pressure, dt);

      ContactNodeState<dim>& state = trial_states_[k];
      state.gap = at.gap;
      state.touching = node.touching;
      state.sliding = node.sliding;
      state.force.setZero();
      state.pressure = node.touching ? node.pressure.value : 0;
      trial_summary_.stored += 0.5 * std::abs(state.pressure * state.gap - states_[k].pressure * states_[k].gap);
      pressures_[k] = node.pressure;
      if constexpr (with_friction) {
        if (excess && !probing()) {
          Turning& t = turning_[k];
          t.held = turned(k) && node.sliding;
          t.now = node.slides;
          t.turned = t.turned || t.now.dot(t.before) < 0;
          t.pressed = t.pressed || settled > 0;
        }
        state.slip = node.memory.friction.slip;
        trial_summary_.max_slip = std::max(trial_summary_.max_slip, state.slip);
      }
      if (!node.touching) continue;
      if constexpr (with_friction)
        if (followed) {
          const Real turn = turn_of_slide<dim>(way, node.sliding, node.bound, enforcement_.stick_stiffness(weight_[k]),
                                               1e-3 * spacing_[k], own_way(mesh, u, k).norm());
          if (turn > trial_summary_.turn) {
            trial_summary_.turn = turn;
            turned_most_ = n;
          }
        }
      state.force = product(pose.rotation, node.force);
      Mat<Real, dim> whole = node.stiffness;
      add(whole, node.coupling);
      if (smooth) whole = scaled(product_transposed(at.normal, at.normal), at.normal.dot(product(whole, at.normal)));
      whole = turned_into_space(pose, whole);
      if (!is_finite(state.force) || !is_finite(whole)) return {Cause::not_finite, {Place::Kind::contact_node, n}};
      add_at_node(forces, n, state.force);
      if (excess) {
        pressures_[k].slope = product(pose.rotation, node.pressure.slope);
        pressures_[k].excess = product(pose.rotation, node.pressure.excess);
        blur_[k] = blur(at_node<dim>(u, n), mesh.nodes[static_cast<std::size_t>(n)], pose, at);
        pressures_[k].forget(4 * blur_[k] * pressures_[k].slope.norm());
        stiffness_[k] = matrix.template largest_diagonal<dim>(slots_[k]);  // of the body: contact is still to be added
        add_at_node(*excess, n, pressures_[k].excess);
        if constexpr (with_friction) add_at_node(*excess, n, product(pose.rotation, node.beyond));
      }
      if (driven) add_at_node(forces, n, product(whole, at_node<dim>(*driven, n)));
      if constexpr (keeps_couplings<Model>) {
        const Mat<Real, dim> symmetric = smooth ? whole : turned_into_space(pose, node.stiffness);
        matrix.add(slots_[k], symmetric);
        if (node.sliding) couplings.add(equations_[k], minus(whole, symmetric));
      } else {
        matrix.add(slots_[k], whole);
      }

      add(trial_force_, state.force);
      ++trial_summary_.touching;
      trial_summary_.sliding += node.sliding ? 1 : 0;
      trial_summary_.max_penetration = std::max(trial_summary_.max_penetration, -at.gap);
      trial_summary_.bound += node.bound;
      trial_summary_.lag += std::abs(node.lag);
      if (states_[k].touching) trial_summary_.swing += node.lag;
      trial_summary_.dissipated += node.dissipated;
      trial_summary_.missed += node.missed;
    }
    return {};
  }

  /// Sets out on a step from the displacements `from` at the time `begin` to the time `end`: over one in which the tool
  /// turns, or moves to and fro, the nodes' places on it are followed (theory.md, section 4.7).
  template <class MeshType>
  Trouble set_out(const MeshType& mesh, const Field& from, Real begin, Real end) requires with_friction {
    along_.take(motion_, begin, end);
    follows_ = along_.turns();
    for (std::size_t i = 0; i < along_.size(); ++i)
      if (const Trouble t = stretched(along_[i].pose)) return t;
    if (!along_.resolved()) return {Cause::slide_turns, {Place::Kind::contact_node, nodes_[0]}};
    if (follows_) depart(mesh, from);
    return {};
  }
  /// Whether the places of the step must be followed though they were not: the tool, which moves on straight, has
  /// turned its normal under a node that slides by more than 0.4 rad to the displacements `to` of the last assembly.
  /// From now on they are.
  template <class MeshType>
  bool must_follow(const MeshType& mesh, const Field& from, const Field& to) requires(with_friction&& dim == 3) {
    if (follows_) return false;
    const rigid::Pose<dim>&first = along_[0].pose, last = along_[along_.size() - 1].pose;
    for (std::size_t k = 0; k < nodes_.size() && !follows_; ++k) {
      if (!trial_states_[k].sliding) continue;
      const Vec<Real, dim> before = distance_to<Real, dim>(tool_, on_tool(mesh, from, first, nodes_[k])).normal,
                           now = distance_to<Real, dim>(tool_, on_tool(mesh, to, last, nodes_[k])).normal;
      follows_ = contraction(before, now) < 0.92;
    }
    if (!follows_) return false;
    along_.divide(motion_, 16);
    depart(mesh, from);
    return true;
  }
  /// Whether this pair is what the step cannot follow.
  bool turned_too_far() const requires with_friction { return !along_.resolved() || trial_summary_.turn > 1; }
  /// Refuses a step over which a node's slide has turned by more than the step can tell (theory.md, eq. 4.25).
  Trouble slide_turned() const requires with_friction {
    if (!turned_too_far()) return {};
    return {Cause::slide_turns, {Place::Kind::contact_node, turned_most_}};
  }

  /// Whether a node has gone through the tool on its way from the converged displacements `from` at the time `begin` to
  /// those of the last assembly, `to` at the time `end` (theory.md, eq. 4.19-4.21).
  template <class MeshType>
  Trouble passed_through(const MeshType& mesh, const Field& from, const Field& to, Real begin, Real end) {
    if (!along_.are_of(begin, end)) along_.take(motion_, begin, end);
    if (!along_.resolved()) return {Cause::slide_turns, {Place::Kind::contact_node, nodes_[0]}};
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const Index n = nodes_[k];
      const Vec<Real, dim> u = at_node<dim>(from, n);
      Vec<Real, dim> x = mesh.nodes[static_cast<std::size_t>(n)];
      add(x, u);
      rigid::Passage<dim, Tool> passed(tool_, along_, 0.1 * spacing_[k]);
      const Cause cause =
          passed(x, minus(at_node<dim>(to, n), u), states_[k].gap, trial_states_[k].gap, trial_states_[k].touching);
      if (cause != Cause::none) return {cause, {Place::Kind::contact_node, n}};
    }
    return {};
  }

  /// Goes back to the multipliers and the bounds of the converged state, where the passes of a step begin. `start` and
  /// `commit` do so; a step that is given up needs it.
  void begin_passes() requires(passes || lags) {
    renewed_ = committed_;
    if constexpr (lags) {
      own_.taken = true;
      own_.of_all = false;
      std::fill(own_.pressure.begin(), own_.pressure.end(), 0.0);
    }
    if constexpr (iterates) relaxation_ = {};
    if constexpr (is_augmented<Enforcement>) {
      for (Real& w : weight_) w /= stiffened_;
      stiffened_ = 1;
    }
  }
  /// Starts the next pass from where the last one ended: its tractions for multipliers, its pressures in the bounds.
  /// Only the places and the slid distances stay those of the converged state.
  void renew() requires passes {
    if constexpr (iterates) {
      relaxation_.next(changes());
      see(relaxation_.share);
    }
    if constexpr (is_augmented<Enforcement>)
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        renewed_[k].enforcement = trial_[k].enforcement;
        if constexpr (with_friction) {
          renewed_[k].friction.traction = trial_[k].friction.traction;
          turning_[k].stuck = trial_states_[k].touching && !trial_states_[k].sliding;
        }
      }
  }
  /// Goes a smaller part of the way of the last `renew`, where that has led to a step without a solution; false when
  /// there is nothing left of it.
  bool hold_back() requires iterates {
    if (!relaxation_.hold_back()) return false;
    see(relaxation_.share);
    return true;
  }

  /// Norm of the differences of the pressures and those that the bounds saw [force].
  Real bound_change() requires lags { return changes().norm(); }
  /// How much of the last change of its bound a pressure may answer with, for the lag to settle [-].
  static constexpr Real stable_below() requires lags { return Friction::Pressure::stable_below; }
  /// Makes the bounds see a share of the last `bound_change`.
  void probe(Real share) requires lags { see(share); }
  /// Goes back from a probe to the bounds of the step.
  void end_probe() requires lags {
    renewed_ = committed_;
    own_.taken = true;
  }
  /// Adds up what pressures were found, of all nodes and of those whose bounds no step before knows one for [force].
  void add_up(Real& all, Real& first) const requires lags {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      all += found(k);
      if (own_.taken && !own_.of_all && takes_own(k, dt_)) first += found(k);
    }
  }
  /// Makes the bounds of the latter see the pressures found.
  void see_first_contacts() requires lags {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (own_.taken && !own_.of_all && takes_own(k, dt_)) own_.pressure[k] = found(k);
  }
  /// Makes an iteration that has begun linearise nodes as sticking whose pressure it loses though their gaps ask for
  /// one. If `sticking`, it sets out from nodes that all stick, and lagging bounds are, until `begin_passes`, of the
  /// step's own pressures.
  void retry(bool sticking) requires with_friction {
    catches_ = true;
    if (!sticking) return;
    for (Turning& t : turning_) t.stuck = true;
    if constexpr (lags) own_.of_all = true;
  }
  /// Square of the norm of what the pressures have changed by since the last `bound_change` [force^2].
  Real answer_squared() const requires lags {
    Real square = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const auto i = static_cast<Index>(k);
      square += std::pow(found(k) - felt_[i] - changes_[i], 2);
    }
    return square;
  }

  /// How far the last pass was from what another one would give: the largest gap of a pressed node, and the largest
  /// reversible slide of a sticking one, over the distance of neighbouring nodes; and the lag of the bounds. In
  /// dynamics a `motion` of the step takes that distance's place, within limits (theory.md, eq. 4.18a).
  Real unsettled([[maybe_unused]] Real motion = std::numeric_limits<Real>::infinity()) const requires passes {
    Real largest = 0;
    if constexpr (is_augmented<Enforcement>)
      for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const ContactNodeState<dim>& state = trial_states_[k];
        if (!state.touching) continue;
        const Real length = std::clamp(100 * motion, 0.01 * spacing_[k], spacing_[k]);
        largest = std::max(largest, std::abs(state.gap) / length);
        if constexpr (with_friction)
          if (!state.sliding)
            largest = std::max(largest, (trial_[k].friction.traction - renewed_[k].friction.traction).norm() /
                                            (enforcement_.stick_stiffness(weight_[k]) * length));
      }
    if constexpr (iterates)
      if (trial_summary_.bound > 0) largest = std::max(largest, trial_summary_.lag / trial_summary_.bound);
    return largest;
  }
  /// Largest motion of a node against the tool between two states [length].
  template <class MeshType>
  Real largest_motion(const MeshType& mesh, const Field& from, const Field& to, Real begin, Real end) const {
    const rigid::Pose<dim> before = motion_.at(begin), after = motion_.at(end);
    Real largest = 0;
    for (const Index n : nodes_)
      largest = std::max(largest, minus(on_tool(mesh, to, after, n), on_tool(mesh, from, before, n)).norm());
    return largest;
  }

  /// Makes the velocities of pressed nodes persist in contact (theory.md, eq. 7.13 to 7.14), after a step from the
  /// converged displacements `from` and velocities `before` at the time `begin` to those of the last assembly, `to`,
  /// and `velocity` at the time `end`.
  template <class MeshType>
  void persist(const MeshType& mesh, const Dofs& dofs, const Field& from, const Field& to, Real begin, Real end,
               const Field& before, const Field& mass, Field& velocity) const {
    const std::array<rigid::Pose<dim>, 3> poses{motion_.at(begin), motion_.at(0.5 * (begin + end)), motion_.at(end)};
    const Real dt = end - begin;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const ContactNodeState<dim>& state = trial_states_[k];
      if (!(state.pressure > 0)) continue;
      const Index n = nodes_[k];
      // Where the step began and where it ended, on the tool.
      const Vec<Real, dim> y0 = on_tool(mesh, from, poses[0], n), y1 = on_tool(mesh, to, poses[2], n);
      const auto normal_at = [&](const rigid::Pose<dim>& pose, const Vec<Real, dim>& y) {
        return product(pose.rotation, distance_to<Real, dim>(tool_, y).normal);
      };
      const Vec<Real, dim> n0 = normal_at(poses[0], y0), n1 = normal_at(poses[2], y1);
      const PlaceVelocity<dim> tool(poses, y1, dt);
      Vec<Real, dim> mean = minus(at_node<dim>(to, n), at_node<dim>(from, n));
      mean /= dt;
      const Vec<Real, dim> v0 = minus(at_node<dim>(before, n), tool.start);
      Vec<Real, dim> v1 = minus(at_node<dim>(velocity, n), tool.end);
      if (states_[k].pressure > 0) {
        const Real lasting = std::min(1.0, states_[k].pressure / state.pressure);
        const Vec<Real, dim> turn =
            scaled(minus(halfway<dim>(n0, n1, state.force), state.force), -lasting * dt / mass[n]);
        const Vec<Real, dim> led = minus(scaled(minus(mean, tool.mean), Real(2)), v0);  // that the motion asks for
        const Real limit = std::max(contraction(v0, v0), contraction(led, led));
        add_free<dim>(velocity, dofs, n, scaled(turn, share_within(v1, turn, limit)));
        v1 = minus(at_node<dim>(velocity, n), tool.end);
      }
      const Real rate0 = contraction(n0, minus(at_node<dim>(before, n), PlaceVelocity<dim>(poses, y0, dt).start)),
                 rate1 = contraction(n1, v1);
      const Real kept = persistent(rate0, rate1, (state.gap - states_[k].gap) / dt);
      if (kept != rate1) push<dim>(velocity, dofs, n, n1, kept - rate1);
      if constexpr (with_friction)
        if (!state.sliding) {
          const auto along = [&](const Vec<Real, dim>& v) {
            return Vec<Real, dim>(minus(v, scaled(n1, contraction(n1, v))));
          };
          const Vec<Real, dim> t1 = along(v1);
          const Vec<Real, dim> change = minus(persistent<dim>(along(v0), t1, along(minus(mean, tool.mean))), t1);
          const Real amount = change.norm();
          if (amount > 0) push<dim>(velocity, dofs, n, scaled(change, 1 / amount), amount);
        }
    }
  }

  /// Stiffens the enforcement, where the passes do not settle quickly enough.
  void stiffen(Real factor) requires(is_augmented<Enforcement>) {
    for (Real& w : weight_) w *= factor;
    stiffened_ *= factor;
  }

  /// Energy that penetration and sticking store at the converged state, where the enforcement tells it.
  Real stored_energy() const requires requires(const Enforcement& e) { e.energy(Real(), Real()); }
  {
    Real sum = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!states_[k].touching) continue;
      sum += enforcement_.energy(states_[k].gap, weight_[k]);
      if constexpr (with_friction)
        sum += 0.5 * committed_[k].friction.traction.squaredNorm() / enforcement_.stick_stiffness(weight_[k]);
    }
    return sum;
  }

  /// Makes the memory and the forces of the last assembly the converged ones.
  void commit() {
    if constexpr (remembers) std::swap(committed_, trial_);
    std::swap(states_, trial_states_);
    pressures_.commit();
    summary_ = trial_summary_;
    force_ = trial_force_;
    if constexpr (is_augmented<Enforcement>) stiffened_ = 1;  // what a converged step took stays
    if constexpr (passes || lags) begin_passes();
  }

  /// The converged state. The weights are part of it: they were measured at the start, and passes may stiffen them.
  void serialize(Archive& archive) {
    const std::string at = "contact " + name_ + ", ";
    archive.same(at + "side", this->side_);
    archive(at + "nodes", states_);
    archive(at + "weights", weight_);
    pressures_.serialize(archive, at + "pressures");
    if constexpr (remembers) archive(at + "memory", committed_);
    archive(at + "force", force_);
    archive(at + "summary", summary_);
    if constexpr (passes || lags)
      if (archive.gives()) begin_passes();
  }

 private:
  using ContactRecord<dim>::name_, ContactRecord<dim>::motion_, ContactRecord<dim>::nodes_, ContactRecord<dim>::states_,
      ContactRecord<dim>::trial_states_, ContactRecord<dim>::summary_, ContactRecord<dim>::trial_summary_,
      ContactRecord<dim>::force_, ContactRecord<dim>::trial_force_;

  template <class MeshType>
  static Vec<Real, dim> on_tool(const MeshType& mesh, const Field& u, const rigid::Pose<dim>& pose, Index node) {
    Vec<Real, dim> x = mesh.nodes[static_cast<std::size_t>(node)];
    add(x, at_node<dim>(u, node));
    return pose.on_tool(x);
  }
  // Where a step that is followed departs from, and by how much a node has gone since.
  template <class MeshType>
  void depart(const MeshType& mesh, const Field& from) requires with_friction {
    departures_.resize(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      departures_[k] = {.x = mesh.nodes[static_cast<std::size_t>(nodes_[k])], .touching = states_[k].touching};
      add(departures_[k].x, at_node<dim>(from, nodes_[k]));
    }
  }
  template <class MeshType>
  Vec<Real, dim> own_way(const MeshType& mesh, const Field& u, std::size_t k) const requires with_friction {
    Vec<Real, dim> x = mesh.nodes[static_cast<std::size_t>(nodes_[k])];
    add(x, at_node<dim>(u, nodes_[k]));
    return minus(x, departures_[k].x);
  }
  static Mat<Real, dim> turned_into_space(const rigid::Pose<dim>& pose, const Mat<Real, dim>& stiffness) {
    return product_transposed(product(pose.rotation, stiffness), pose.rotation);
  }
  // A pose that is finite but does not move the tool as a rigid body would; what is not finite tells its node.
  Trouble stretched(const rigid::Pose<dim>& pose) const {
    if (pose.rigid() || !pose.finite()) return {};
    return {Cause::not_rigid, {Place::Kind::contact_node, nodes_[0]}};
  }
  // Distance, and the place where friction asks for it.
  template <class MeshType>
  SurfacePoint<Real, dim> seen_from_tool(const MeshType& mesh, const Field& u, const rigid::Pose<dim>& pose,
                                         Index node) const {
    const Vec<Real, dim> x = on_tool(mesh, u, pose, node);
    SurfacePoint<Real, dim> at = distance_to<Real, dim>(tool_, x);
    if constexpr (with_friction && dim == 3) add_place(x, at);
    return at;
  }

  // The pressures that the last pass found, less those that its bounds saw.
  const Field& changes() requires lags {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const auto i = static_cast<Index>(k);
      felt_[i] = Friction::Pressure::pressure(found(k), start_of_pass(k, dt_).friction.pressure, dt_);
      changes_[i] = found(k) - felt_[i];
    }
    return changes_;
  }
  // The pressure of the last assembly.
  Real found(std::size_t k) const { return trial_states_[k].touching ? pressures_[k].value : 0; }
  // Makes the bounds see the pressures a part of the way from those that they saw to those that were found.
  void see(Real share) requires lags {
    own_.taken = false;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const auto i = static_cast<Index>(k);
      renewed_[k].friction.pressure = Friction::Pressure::seeing(std::max(0.0, felt_[i] + share * changes_[i]));
    }
  }

  // Round-off of a gap [length]: that of the largest numbers that it is the difference of.
  static Real blur(const Vec<Real, dim>& u, const Vec<Real, dim>& X, const rigid::Pose<dim>& pose,
                   const SurfacePoint<Real, dim>& at) {
    Real reach = std::max(X.norm() + u.norm(), pose.translation.norm());
    // To the tool's centre; the curvature of a plane is round-off itself.
    if (const Real bend = at.hess_gap.norm(); bend * reach > 1e-8) reach = std::max(reach, 1 / bend);
    return std::numeric_limits<Real>::epsilon() * reach;
  }

  Memory start_of_pass(std::size_t k, [[maybe_unused]] Real dt) const requires remembers {
    if constexpr (passes || lags) {
      Memory memory = renewed_[k];
      if constexpr (lags)
        if (takes_own(k, dt)) memory.friction.pressure = Friction::Pressure::seeing(own_.pressure[k]);
      return memory;
    } else {
      return committed_[k];
    }
  }

  // Whether the node's bound is that of the step's own pressure: no step before knows one (theory.md, section 5.4).
  bool takes_own(std::size_t k, Real dt) const requires lags {
    return own_.taken &&
           (own_.of_all || !(Friction::Pressure::pressure(Real(0), committed_[k].friction.pressure, dt) > 0));
  }
  // Begins the step's own pressures with those of the last one, of which there are none at a first contact.
  void set_out_from_known() requires lags {
    for (std::size_t k = 0; k < nodes_.size(); ++k) own_.pressure[k] = states_[k].pressure;
    own_.looks = 0;
  }
  // Takes the pressures that the iteration is led to into the bounds, where they all are of the step's own. Where they
  // do not settle with the iteration, they stay as they are after some of it.
  void look_ahead() requires lags {
    if (!own_.taken || !own_.of_all || own_.looks == most_looks) return;
    // Aitken's share of the way, as between passes (5.30): what friction does to its own pressure may be more than
    // that.
    Real product = 0, square = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!takes_own(k, dt_)) continue;
      const Real last = own_.change[k];
      own_.change[k] = std::max(0.0, pressures_.ahead(k)) - own_.pressure[k];
      product += last * (own_.change[k] - last);
      square += std::pow(own_.change[k] - last, 2);
    }
    if (own_.looks < 2)
      own_.share = 1;
    else if (square > 0)
      own_.share = std::clamp(-own_.share * product / square, Real(0.05), Real(2));
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      if (!takes_own(k, dt_)) continue;
      own_.pressure[k] = std::max(0.0, own_.pressure[k] + own_.share * own_.change[k]);
    }
    ++own_.looks;
  }

  // Goes on to the next search along a solution. A probe of the tangent sees the nodes as they were where the search
  // set out, which is what the matrix is made of.
  void turn(bool probe) requires with_friction {
    if constexpr (probed) {
      (probe ? turning_ : start_.turning) = probe ? start_.turning : turning_;
      start_.probing = probe;
    }
    if (probe) return;
    for (Turning& t : turning_) {
      if (t.held) t.now.setZero();
      t = {.before = t.now, .now = t.now, .again = t.again || t.turned, .lost = t.lost || t.pressed};
    }
  }
  bool probing() const {
    if constexpr (probed) return start_.probing;
    return false;
  }

  // Whether the search along a solution has been at a place where the node slides the other way (theory.md, eq. 6.11).
  bool turned([[maybe_unused]] std::size_t k) const {
    if constexpr (with_friction)
      return turning_[k].turned && turning_[k].again;
    else
      return false;
  }

  // Whether a sliding node is linearised as one that sticks: it turned to and fro, or the iteration has led its
  // pressure to nothing where its gap asks for one; or no pressure has been seen yet that its bound could be of
  // (theory.md, section 5.4).
  bool held(std::size_t k, Real pressure) const {
    if constexpr (with_friction)
      if (turning_[k].stuck || (catches_ && turning_[k].lost && !(pressure > 0))) return true;
    return turned(k);
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
    const PenaltyPer per = enforcement_.per;
    if (per == PenaltyPer::node) std::fill(weight_.begin(), weight_.end(), 1.0);
    if (per == PenaltyPer::unit_depth)
      std::fill(weight_.begin(), weight_.end(),
                Model::Kinematics::hoop ? 2 * pi : kinematics.measure(mesh.nodes[static_cast<std::size_t>(nodes_[0])]));
    if (per == PenaltyPer::area) weight_ = nodal_areas(mesh, kinematics, this->side_);
    if constexpr (takes_area) areas_ = nodal_areas(mesh, kinematics, this->side_);
  }

  // Where a node slides to in an iteration.
  struct Turning {
    Vec<Real, place_components<dim>> before = Vec<Real, place_components<dim>>::Zero();  // where the search set out
    Vec<Real, place_components<dim>> now = Vec<Real, place_components<dim>>::Zero();
    bool turned = false, again = false, held = false;  // in this search, in an earlier one
    bool pressed = false, lost = false;                // its gap asked for a pressure, in an earlier iteration
    bool stuck = false;                                // where the iteration sets out
  };

  // The step's own pressures, for bounds that have none of an earlier step.
  static constexpr int most_looks = 14;
  struct Own {
    std::vector<Real> pressure{}, change{};  // that the bounds take [force]
    Real share = 1;
    int looks = 0;      // at the iteration's pressures so far
    bool taken = true;  // until passes or a probe say what the bounds see
    bool of_all = false;
  };

  Tool tool_;
  [[no_unique_address]] Only<with_friction, typename Friction::Law, Contact<Model, Friction>> friction_;
  Enforcement enforcement_;
  Real start_depth_;  // that nodes may lie inside the tool at the start
  std::vector<Real> weight_;
  [[no_unique_address]] Only<takes_area, std::vector<Real>, Model> areas_;
  StiffRelations<dim> pressures_;
  std::vector<Real> blur_, stiffness_;  // of touching nodes in the last assembly: of their gaps, of the body there
  struct Start {                        // of a search
    std::vector<Turning> turning{};
    bool probing = false;
  };
  [[no_unique_address]] Only<with_friction, std::vector<Turning>, struct TurningTag> turning_;
  [[no_unique_address]] Only<probed, Start, struct StartTag> start_{};
  [[no_unique_address]] Only<with_friction, bool, struct CatchesTag> catches_{};  // nodes that lose their pressure
  [[no_unique_address]] Only<remembers, std::vector<Memory>, ContactPair> committed_;
  [[no_unique_address]] Only<remembers, std::vector<Memory>, ContactSummary> trial_;
  [[no_unique_address]] Only<passes || lags, std::vector<Memory>, Friction> renewed_;  // where the present pass starts
  std::vector<Real> spacing_;
  rigid::PosesAlong<dim> along_;  // a step
  [[no_unique_address]] Only<with_friction, std::vector<Departure<dim>>, struct DepartureTag>
      departures_;                                                                  // of a step that is followed
  [[no_unique_address]] Only<with_friction, bool, struct FollowTag> follows_{};     // whether this one is
  [[no_unique_address]] Only<with_friction, Index, struct TurnTag> turned_most_{};  // the node of trial_summary_.turn
  [[no_unique_address]] Only<iterates, Relaxation, Memory> relaxation_;
  [[no_unique_address]] Only<is_augmented<Enforcement>, Real, struct StiffenedTag>
      stiffened_;                                         // by how much in this step
  [[no_unique_address]] Only<lags, Field, Matrix> felt_;  // pressures that the bounds of the last pass saw
  [[no_unique_address]] Only<lags, Field, struct ChangesTag> changes_;  // and what it found, less these
  [[no_unique_address]] Only<lags, Real, struct StepTag> dt_{};         // of the last assembly
  [[no_unique_address]] Only<lags, Own, struct OwnTag> own_{};
  std::vector<std::array<Index, static_cast<std::size_t>(Matrix::block_entries(dim))>> slots_;
  using NodeEquations = std::vector<std::array<Index, static_cast<std::size_t>(dim)>>;
  [[no_unique_address]] Only<keeps_couplings<Model>, NodeEquations, Tool> equations_;
};

namespace detail {
// A list: its pairs stay where they are, and growing it takes no code that moves them.
template <class Model, class Friction>
using PairList = std::list<ContactPair<Model, Friction>>;
}  // namespace detail

/// The pairs that the contacts of a bundle become.
template <class Model>
using ContactPairs = typename detail::ContactLists<Model, typename Model::Friction, detail::PairList>::type;

}  // namespace stickslip
