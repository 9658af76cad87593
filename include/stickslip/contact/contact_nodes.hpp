// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/nodal.hpp>
#include <stickslip/contact/contact_record.hpp>
#include <stickslip/contact/node_measures.hpp>
#include <stickslip/contact/persistency.hpp>
#include <stickslip/contact/slip_path.hpp>
#include <stickslip/geometry/tunnelling_check.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace stickslip {

/// The nodes of a contact side against their tool, whatever the laws: where they are, and how they move over a step.
template <int dim_, class Tool, bool with_friction, bool takes_area>
class ContactNodes : public ContactRecord<dim_> {
 public:
  static constexpr int dim = dim_;
  static constexpr int components = dim;  ///< of displacement that act on a node's gap and place
  using Point = Vec<Real, dim>;
  using Pose = rigid::Pose<dim>;

  const Tool& tool() const { return tool_; }

  /// The warning that nodes are more than three times farther apart than the tool's smallest size: they may step over
  /// it. Empty where they are not, or the tool does not tell its size.
  [[gnu::cold]] std::string warning_of_size() const {
    if constexpr (requires { tool_.smallest_size(); }) {
      const Real size = tool_.smallest_size(), spacing = measures_.smallest_spacing();
      if (size < spacing / 3)
        return joined({"contact \"", name_, "\": the tool's smallest size, ", brief(size),
                       ", is less than a third of the distance of the nodes of side \"", this->side_, "\", ",
                       brief(spacing), ": they may step over it or snap around it"});
    }
    return "";
  }

  /// Begins a step from the displacements `from`: where the tool turns on the way, or moves to and fro, the nodes' slip
  /// paths are followed (theory.md, section 4.7).
  Failure begin_step(const Field& from, Real begin, Real end) requires with_friction {
    along_.take(motion_, begin, end);
    for (std::size_t i = 0; i < along_.size(); ++i)
      if (const Failure f = not_rigid(along_[i].pose)) return f;
    if (!along_.resolved()) return too_far(nodes_[0]);
    follow_paths(from, along_.turns());
    return {};
  }
  /// Whether the slip paths of the step must be followed though they were not: the tool, which does not turn, has
  /// turned its normal under a node that slides by more than 0.4 rad to the displacements `to` of the last evaluation.
  /// From now on they are.
  bool must_follow(const Field& from, const Field& to) requires(with_friction&& dim == 3) {
    if (paths_.followed()) return false;
    const Pose &first = along_[0].pose, &last = along_[along_.size() - 1].pose;
    bool turned = false;
    for (std::size_t k = 0; k < nodes_.size() && !turned; ++k)
      turned = states_.trial(k).sliding && contraction(closest(first.on_tool(position(from, k))).normal,
                                                       closest(last.on_tool(position(to, k))).normal) < 0.92;
    if (!turned) return false;
    along_.divide(motion_, 16);
    follow_paths(from, true);
    return true;
  }
  /// Whether a slip path of the last evaluation turns by more than the step can resolve (theory.md, eq. 4.26).
  bool slip_turns_too_far() const requires with_friction { return !along_.resolved() || trial_summary_.turn > 1; }
  Failure slip_turned() const requires with_friction {
    return slip_turns_too_far() ? too_far(turned_most_) : Failure{};
  }

  /// Whether a node has gone through the tool between the converged displacements `from` at the time `begin` and those
  /// of the last evaluation, `to` at the time `end` (theory.md, eq. 4.20-4.22).
  Failure check_tunnelling(const Field& from, const Field& to, Real begin, Real end) {
    if (!along_.are_of(begin, end)) along_.take(motion_, begin, end);
    if (!along_.resolved()) return too_far(nodes_[0]);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      rigid::TunnellingCheck<dim, Tool> passed(tool_, along_, 0.1 * measures_.spacing(k));
      const FailureCause cause =
          passed(position(from, k), minus(at_node<dim>(to, nodes_[k]), at_node<dim>(from, nodes_[k])),
                 states_.converged(k).gap, states_.trial(k).gap, this->touches(k));
      if (cause != FailureCause::none) return {cause, {Location::Kind::contact_node, nodes_[k]}};
    }
    return {};
  }
  /// Largest motion of a node against the tool between two states [length].
  Real largest_motion(const Field& from, const Field& to, Real begin, Real end) const {
    const Pose before = motion_.at(begin), after = motion_.at(end);
    Real largest = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      largest = std::max(largest, minus(after.on_tool(position(to, k)), before.on_tool(position(from, k))).norm());
    return largest;
  }
  /// Makes the velocities of pressed nodes persist in contact over the step from `begin` to `end` (see persist).
  void persist_velocities(const IndexMap& dofs, const Field& from, const Field& to, Real begin, Real end,
                          const Field& before, const Field& mass, Field& velocity) const {
    const std::array<Pose, 3> poses{motion_.at(begin), motion_.at(0.5 * (begin + end)), motion_.at(end)};
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (const Index n = nodes_[k]; states_.trial(k).pressure > 0)
        persist<dim>(tool_, poses, end - begin, dofs, n, X_[static_cast<std::size_t>(n)], states_.converged(k),
                     states_.trial(k), with_friction, from, to, before, mass[n], velocity);
  }

 protected:
  using Record = ContactRecord<dim>;
  using Record::name_, Record::motion_, Record::nodes_, Record::states_, Record::trial_summary_;

  // Throws std::invalid_argument, naming the contact, for parameters that cannot be.
  template <class Description, class BodiesType>
  ContactNodes(const Description& contact, const BodiesType& bodies)
      : Record(contact.name, contact.side, contact.motion, bodies.side_nodes(contact.side)),
        tool_(contact.tool),
        X_(bodies.positions()),
        start_depth_(contact.start_depth),
        measures_(bodies.with_side(contact.side, [&](const auto& body, const std::string& own) {
          return NodeMeasures<dim, takes_area>(body.mesh(), body.kinematics(), own, contact.enforcement.per);
        })) {
    if (tool_.empty()) this->refuse("the tool has no surface");
    if (!(start_depth_ >= 0)) this->refuse("start_depth must not be negative");
  }

  void serialize_measures(Archive& archive, const std::string& name) { measures_.serialize(archive, name); }
  // Measure behind a unit of penalty at a node.
  Real weight(std::size_t k) const { return measures_.tributary()[k]; }
  Real converged_weight(std::size_t k) const { return weight(k); }
  // What of a change of the displacements acts on a node.
  Point change_at(std::size_t k, const Field& du) const { return at_node<dim>(du, nodes_[k]); }
  // The closest points to the nodes where they are at the start. Throws std::invalid_argument where the tool has no
  // position, or nodes lie deeper inside it than their neighbours are away: the tool is the wrong way round, or ends
  // too early.
  [[gnu::cold]] std::vector<SurfacePoint<Real, dim>> start_points(const Field& u, Real time) const {
    std::vector<SurfacePoint<Real, dim>> points;
    const Pose pose = motion_.at(time);
    if (const Failure f = not_rigid(pose)) this->refuse(describe(f.cause));
    std::size_t worst = 0;
    Real excess = 0, depth = 0;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const SurfacePoint<Real, dim> at = closest(pose.on_tool(position(u, k)));
      if (!std::isfinite(at.gap)) this->refuse("the tool's position or the distance to it is not finite at the start");
      points.push_back(at);
      const Real e = -at.gap - std::max(measures_.spacing(k), start_depth_) * (1 + 1e-9);
      if (e > excess) worst = k, excess = e, depth = -at.gap;
    }
    if (excess > 0)
      this->refuse(
          joined({"node ", std::to_string(nodes_[worst]), " starts ", brief(depth),
                  " deep inside the tool, and its next neighbour is ", brief(measures_.spacing(worst)),
                  " away: the tool is the wrong way round (the body must be on the left of a chain, or where normals "
                  "point), or ends too early; for so deep a fit set start_depth"}));
    return points;
  }
  // A node in space.
  Point position(const Field& u, std::size_t k) const {
    Point x = X_[static_cast<std::size_t>(nodes_[k])];
    add(x, at_node<dim>(u, nodes_[k]));
    return x;
  }
  // The closest point of the tool, in its frame; its surface coordinate where friction needs it.
  SurfacePoint<Real, dim> closest(const Point& x) const {
    SurfacePoint<Real, dim> at = distance_to<Real, dim>(tool_, x);
    if constexpr (with_friction && dim == 3) add_surface_coordinate(x, at);
    return at;
  }
  // A pose that is finite but does not move the tool as a rigid body would; one that is not finite names its node.
  Failure not_rigid(const Pose& pose) const {
    if (pose.rigid() || !pose.finite()) return {};
    return {FailureCause::not_rigid, {Location::Kind::contact_node, nodes_[0]}};
  }
  void note_turn(Real turn, Index node) {
    if (!(turn > trial_summary_.turn)) return;
    trial_summary_.turn = turn;
    turned_most_ = node;
  }

  Tool tool_;
  const std::vector<Point>& X_;  // reference positions of all nodes
  Real start_depth_;             // that nodes may lie inside the tool at the start
  NodeMeasures<dim, takes_area> measures_;
  rigid::PosesAlong<dim> along_;  // a step
  [[no_unique_address]] StoredIf<with_friction, SlipPaths<dim>, ContactNodes> paths_;

 private:
  static Failure too_far(Index node) { return {FailureCause::slide_turns, {Location::Kind::contact_node, node}}; }
  void follow_paths(const Field& from, bool follow) requires with_friction {
    paths_.begin(follow, states_.converged(), [&](std::size_t k) { return position(from, k); });
  }
  Index turned_most_ = -1;  // the node of trial_summary_.turn
};

}  // namespace stickslip
