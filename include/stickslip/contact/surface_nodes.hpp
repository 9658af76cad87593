// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/outcome.hpp>
#include <stickslip/contact/contact_record.hpp>
#include <stickslip/contact/node_measures.hpp>
#include <stickslip/contact/persistency.hpp>
#include <stickslip/contact/surface_points.hpp>
#include <stickslip/dofs/sparsity_pattern.hpp>
#include <stickslip/geometry/surface_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace stickslip {

/// The nodes of a slave side against a master side, whatever the laws. A node's gap and slip are means over the points
/// of the facets around it, weighted with its shape function; their gradients reach the nodes of all facets that these
/// points may meet (theory.md, eq. 4.37).
template <class Kinematics, bool with_friction, bool takes_area>
class SurfaceNodes : public ContactRecord<Kinematics::dim> {
 public:
  static constexpr int dim = Kinematics::dim;
  static_assert(dim == 2, "stickslip: contact between surfaces is there in the plane and in axisymmetry alone.");
  static constexpr int places = surface_coordinates<dim>;
  static constexpr int components = 1 + places;  ///< gap and place
  using Point = Vec<Real, dim>;
  using Points = SurfacePoints<Kinematics>;

  const Points& points() const { return points_; }
  /// Whether the surface is in contact with itself.
  bool self() const { return points_.self(); }
  std::string warning_of_size() const { return ""; }

  /// Makes points and stencils for a step from the displacements u that is guessed to end at `guess`. True where the
  /// stencils have changed since the matrix was connected.
  bool update(const Field& u, const Field& guess) {
    points_.update(u, guess);
    const std::size_t count = points_.point_count();
    at_.resize(count);
    slip_.resize(count);
    slave_facet_.resize(count);
    for (std::size_t f = 0; f < points_.slave().size(); ++f)
      for (std::size_t q = 0; q < points_.points(f).size(); ++q) slave_facet_[points_.first_point(f) + q] = f;
    stale_ = make_stencils() || stale_;
    return stale_;
  }
  void couple(SparsityPattern& pattern) const {
    std::vector<Index> components_of_node;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      components_of_node.clear();
      for (const Index n : stencil(k))
        for (int i = 0; i < dim; ++i) components_of_node.push_back(n * dim + i);
      pattern.couple(components_of_node);
    }
  }

  Failure begin_step(const Field&, Real, Real) requires with_friction { return {}; }
  static constexpr bool slip_turns_too_far() requires with_friction { return false; }
  static Failure slip_turned() requires with_friction { return {}; }
  /// Largest motion of the surfaces against each other between two states [length].
  Real largest_motion(const Field& from, const Field& to, Real, Real) const {
    return points_.relative_motion(from, to);
  }
  /// Whether a node has gone through the other surface between two states (theory.md, eq. 4.43 and 4.44).
  Failure check_tunnelling(const Field& from, const Field& to, Real, Real) const {
    const Index node = points_.passed(from, to);
    if (node == Surface::none) return {};
    return {FailureCause::tunnelled, {Location::Kind::contact_node, node}};
  }
  /// Makes the velocities of both surfaces persist at pressed nodes over a step: their rates of gap and, where they
  /// stick, of slip (theory.md, eq. 4.45).
  void persist_velocities(const IndexMap& dofs, const Field& from, const Field& to, Real begin, Real end,
                          const Field& before, const Field& mass, Field& velocity) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const ContactNodeState<dim>& now = states_.trial(k);
      if (!(now.pressure > 0)) continue;
      persist(k, gap_gradient_, dofs, from, to, end - begin, before, mass, velocity);
      if constexpr (with_friction)
        if (!now.sliding) persist(k, slip_gradient_, dofs, from, to, end - begin, before, mass, velocity);
    }
  }
  /// Calls visit(node) for the nodes of both surfaces that touch; with `ever` for those that could. Of a surface on
  /// itself there are none.
  template <class Visit>
  void for_each_held(bool ever, Visit&& visit) const {
    if (self()) return;  // it bears nothing but itself
    if (ever) {
      for (const Surface* surface : {&points_.slave(), &points_.master()})
        for (const Index n : surface->nodes()) visit(n);
      return;
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      if (this->touches(k))
        for (std::size_t i = stencil_start_[k]; i < stencil_start_[k + 1]; ++i)
          if (gap_gradient_[i].squaredNorm() > 0) visit(stencil_[i]);
  }

 protected:
  using Record = ContactRecord<dim>;
  using Record::name_, Record::nodes_, Record::states_, Record::trial_summary_;
  using Closest = typename Points::Closest;
  static constexpr std::size_t no_place = static_cast<std::size_t>(-1);

  // Throws std::invalid_argument, naming the contact, for parameters that cannot be.
  template <class Description, class BodiesType>
  SurfaceNodes(const Description& contact, const BodiesType& bodies)
      : Record(contact.name.empty() ? contact.side + " on " + contact.against : contact.name, contact.side, {},
               bodies.side_nodes(contact.side)),
        against_(contact.against),
        start_depth_(contact.start_depth),
        measures_(bodies.with_side(contact.side,
                                   [&](const auto& body, const std::string& own) {
                                     return NodeMeasures<dim, takes_area>(body.mesh(), body.kinematics(), own,
                                                                          contact.enforcement.per);
                                   })),
        area_(bodies.side_areas(contact.side)),
        points_(surface(bodies, contact.side), surface(bodies, contact.against), contact.side == contact.against,
                bodies.with_side(contact.side, [](const auto& body, const std::string&) { return body.kinematics(); })),
        place_(static_cast<std::size_t>(bodies.node_count()), no_place),
        coverage_(nodes_.size(), 0.0),
        converged_coverage_(coverage_),
        covered_(coverage_),
        followed_(coverage_),
        gap_(covered_),
        node_slip_(covered_),
        means_(nodes_.size()),
        extent_(bodies.extent()) {
    if (!(start_depth_ >= 0)) this->refuse("start_depth must not be negative");
    points_.allow(start_depth_);
    if (!self() && share_a_body(bodies, contact.side, contact.against))
      this->refuse(
          "sides \"" + contact.side + "\" and \"" + contact.against +
          "\" are of one body, or of bodies that share nodes: join them to one side that is in contact with itself");
    for (std::size_t k = 0; k < nodes_.size(); ++k) place_[static_cast<std::size_t>(nodes_[k])] = k;
    stencil_start_.assign(nodes_.size() + 1, 0);
  }

  void serialize_measures(Archive& archive, const std::string& name) {
    measures_.serialize(archive, name);
    archive.check_equal(name + ", against", against_);
    archive(name + ", coverage", converged_coverage_);
  }
  // Measure behind a unit of penalty at a node, of the part of its area that faces the master (eq. 4.38).
  Real weight(std::size_t k) const { return measures_.tributary()[k] * coverage_[k]; }
  // The same at the converged state.
  Real converged_weight(std::size_t k) const { return measures_.tributary()[k] * converged_coverage_[k]; }
  void commit_positions() { converged_coverage_ = coverage_; }
  // Reference area that it carries, of the part that faces the master.
  Real area(std::size_t k) const { return measures_.area(k) * coverage_[k]; }
  // What of a change of the displacements acts on a node: the changes of gap and place, to first order.
  Vec<Real, components> change_at(std::size_t k, const Field& du) const {
    Vec<Real, components> change = Vec<Real, components>::Zero();
    for (std::size_t i = stencil_start_[k]; i < stencil_start_[k + 1]; ++i)
      for (int c = 0; c < dim; ++c) {
        const Real d = du[stencil_[i] * dim + c];
        change[0] += gap_gradient_[i][c] * d;
        if constexpr (with_friction) change[1] += slip_gradient_[i][c] * d;
      }
    return change;
  }
  std::span<const Index> stencil(std::size_t k) const {
    return {stencil_.data() + stencil_start_[k], stencil_start_[k + 1] - stencil_start_[k]};
  }

  // The gaps of the nodes where they are at the start, with points made for it. Throws std::invalid_argument where a
  // node lies deeper than its neighbours are away.
  [[gnu::cold]] std::vector<SurfacePoint<Real, dim>> start_points(const Field& u, Real) {
    if (const auto [node, depth] = points_.deepest_start(u); depth > std::max(points_.largest_length(), start_depth_))
      this->refuse(joined({"node ", std::to_string(node), " starts ", brief(depth),
                           " deep inside the other body, more than a facet's length; for so deep a fit set "
                           "start_depth"}));
    update(u, u);
    take_positions(u);
    std::vector<SurfacePoint<Real, dim>> points(nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      points[k].gap = gap_[k];
      const Real depth = -gap_[k];
      if (depth > std::max(measures_.spacing(k), start_depth_) * (1 + 1e-9))
        this->refuse(joined({"node ", std::to_string(nodes_[k]), " starts ", brief(depth),
                             " deep inside the other surface, and its next neighbour is ", brief(measures_.spacing(k)),
                             " away; for so deep a fit set start_depth"}));
    }
    return points;
  }

  // Takes the positions of all points, and the nodes' gaps and slips from them.
  bool take_positions(const Field& u) {
    covered_.assign(nodes_.size(), 0.0);
    gap_.assign(nodes_.size(), 0.0);
    node_slip_.assign(nodes_.size(), 0.0);
    followed_.assign(nodes_.size(), 0.0);
    deepest_ = 0;
    bool finite = true;
    for (std::size_t q = 0; q < at_.size(); ++q) {
      const std::size_t f = slave_facet_[q];
      const SurfacePointOf& point = points_.points(f)[q - points_.first_point(f)];
      at_[q] = points_.closest(u, f, point.eta);
      if (at_[q].facet == Surface::none) continue;
      finite = finite && std::isfinite(at_[q].foot.gap());
      deepest_ = std::max(deepest_, -at_[q].foot.gap());
      slip_[q].followed = false;
      slip_[q].way = 0;
      if constexpr (with_friction) slip_[q].followed = points_.slip(point, at_[q], slip_[q].way);
      for_each_share(q, [&](std::size_t k, Real share) {
        covered_[k] += share;
        gap_[k] += share * at_[q].foot.gap();
        if (!slip_[q].followed) return;
        followed_[k] += share;
        node_slip_[k] += share * slip_[q].way;
      });
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      coverage_[k] = faces(k) ? std::min(Real(1), covered_[k] / area_[k]) : 0;
      gap_[k] = faces(k) ? gap_[k] / covered_[k] : std::numeric_limits<Real>::infinity();
      node_slip_[k] = slides(k) ? node_slip_[k] / followed_[k] : 0;
    }
    return finite;
  }
  // Whether a node faces the master at all, and whether it did so when the step began; its gap, and its slip since.
  bool faces(std::size_t k) const { return covered_[k] > 1e-9 * area_[k]; }
  bool slides(std::size_t k) const { return followed_[k] > 1e-9 * area_[k]; }
  Real gap(std::size_t k) const { return gap_[k]; }
  Vec<Real, places> slip(std::size_t k) const { return Vec<Real, places>(node_slip_[k]); }
  // Parts of a share in the means of gap and slip of a node.
  Real gap_part(std::size_t k, Real share) const { return share / covered_[k]; }
  Real slip_part(std::size_t q, std::size_t k, Real share) const {
    return slip_[q].followed && slides(k) ? share / followed_[k] : 0;
  }
  // Round-off of a gap at the displacements u.
  Real gap_roundoff(const Field& u) const {
    return std::numeric_limits<Real>::epsilon() * (extent_ + u.template lpNorm<Eigen::Infinity>());
  }
  // Makes the gradients of the nodes' gaps and slips; `wanted(k)` says of which.
  template <class Wanted>
  void take_gradients(Wanted&& wanted) {
    for (auto& g : gap_gradient_) g.setZero();
    for (auto& m : means_) m = {};
    if constexpr (with_friction)
      for (auto& g : slip_gradient_) g.setZero();
    for_each_point([&](std::size_t q, const Closest& at, const std::array<Index, 4>& nodes) {
      for_each_share(q, [&](std::size_t k, Real share) {
        if (!wanted(k)) return;
        const Real of_gap = gap_part(k, share);
        [[maybe_unused]] const Real of_slip = slip_part(q, k, share);
        means_[k].stretch += of_slip * (at.foot.stretch() > 0 ? at.foot.stretch() : 1);
        for (std::size_t p = 0; p < nodes.size(); ++p) {
          const std::size_t i = entry(k, nodes[p]);
          const Point normal = at.foot.gap_gradient(p);
          add(gap_gradient_[i], normal, of_gap);
          if (p < 2) add(means_[k].normal, normal, of_gap);
          if constexpr (with_friction)
            if (of_slip > 0) {
              const Point along = at.foot.place_gradient(p);
              add(slip_gradient_[i], along, of_slip);
              if (p < 2) add(means_[k].along, along, of_slip);
            }
        }
      });
    });
  }
  // Calls visit(q, closest, nodes of its stencil) for the points with a foot.
  template <class Visit>
  void for_each_point(Visit&& visit) const {
    for (std::size_t q = 0; q < at_.size(); ++q) {
      if (at_[q].facet == Surface::none) continue;
      const auto& s = points_.slave().facet(slave_facet_[q]);
      const auto& m = points_.master().facet(static_cast<std::size_t>(at_[q].facet));
      visit(q, at_[q], std::array<Index, 4>{s[0], s[1], m[0], m[1]});
    }
  }
  // Calls visit(k, weight times shape function) for the two nodes that share a point, or for the tip that it is.
  template <class Visit>
  void for_each_share(std::size_t q, Visit&& visit) const {
    const std::size_t f = slave_facet_[q];
    const SurfacePointOf& point = points_.points(f)[q - points_.first_point(f)];
    if (point.tip != Surface::none) return visit(place_[static_cast<std::size_t>(point.tip)], point.weight);
    const auto& ends = points_.slave().facet(f);
    if (points_.counts(f, 0)) visit(place_[static_cast<std::size_t>(ends[0])], point.weight * (1 - point.eta));
    if (points_.counts(f, 1)) visit(place_[static_cast<std::size_t>(ends[1])], point.weight * point.eta);
  }
  // Where a node is in the stencil of contact node k.
  std::size_t entry(std::size_t k, Index node) const {
    std::size_t i = stencil_start_[k];
    while (stencil_[i] != node) ++i;
    return i;
  }

  std::size_t first_entry(std::size_t k) const { return stencil_start_[k]; }
  // Derivatives of a node's gap and slip by a component of its stencil, counted over all stencils.
  Real gap_slope(std::size_t i) const { return gap_gradient_[i / dim][static_cast<int>(i % dim)]; }
  Real slip_slope(std::size_t i) const { return slip_gradient_[i / dim][static_cast<int>(i % dim)]; }
  // Adds the forces at the nodes of all facets that tractions along the gap and the slip of a node are.
  void scatter(std::size_t k, Real normal, const Vec<Real, places>& along, Field& field) const {
    for (std::size_t i = stencil_start_[k]; i < stencil_start_[k + 1]; ++i) {
      Point f = scaled(gap_gradient_[i], normal);
      if constexpr (with_friction) add(f, slip_gradient_[i], along[0]);
      add_at_node<dim>(field, stencil_[i], f);
    }
  }
  // The same as one force on the master.
  Point force(std::size_t k, Real normal, const Vec<Real, places>& along) const {
    Point f = scaled(means_[k].normal, normal);
    if constexpr (with_friction) add(f, means_[k].along, along[0]);
    return f;
  }
  // Length of the master in the metric of the places over its present one, a mean at a node.
  Real stretch(std::size_t k) const { return slides(k) ? means_[k].stretch : 1; }

  struct PointSlip {
    Real way = 0;
    bool followed = false;
  };
  struct Means {
    Point normal = Point::Zero(), along = Point::Zero();
    Real stretch = 0;
  };
  std::string against_;
  Real start_depth_;
  NodeMeasures<dim, takes_area> measures_;
  std::vector<Real> area_;  // of the nodes, in the reference configuration
  Points points_;
  std::vector<std::size_t> place_;  // of a node of the scene among the contact nodes
  // Of the nodes in the last evaluation: the parts of their areas that face the master (and the converged ones), the
  // measures of these and of what slides on it, gaps and slips.
  std::vector<Real> coverage_, converged_coverage_, covered_, followed_, gap_, node_slip_;
  std::vector<Means> means_;  // over the points of a node
  Real extent_;               // of the bodies
  std::vector<Closest> at_;
  std::vector<PointSlip> slip_;
  std::vector<std::size_t> slave_facet_;  // of a point
  std::vector<std::size_t> stencil_start_;
  std::vector<Index> stencil_;
  std::vector<Point> gap_gradient_, slip_gradient_;  // by entry of a stencil
  Real deepest_ = 0;                                 // of a point
  bool stale_ = true;                                // the stencils, for the matrix

 private:
  // Changes the velocity by an impulse along a gradient, so that its rate persists.
  void persist(std::size_t k, const std::vector<Point>& gradient, const IndexMap& dofs, const Field& from,
               const Field& to, Real dt, const Field& before, const Field& mass, Field& velocity) const {
    Real rate0 = 0, rate1 = 0, mean = 0, response = 0;
    for_each_component(k, [&](std::size_t i, Index node, int c) {
      const Index at = node * dim + c;
      const Real slope = gradient[i][c];
      rate0 += slope * before[at];
      rate1 += slope * velocity[at];
      mean += slope * (to[at] - from[at]) / dt;
      if (dofs.equation(at) != IndexMap::constrained && mass[node] > 0) response += slope * slope / mass[node];
    });
    const Real change = persistent(rate0, rate1, mean) - rate1;
    if (change == 0 || !(response > 0)) return;
    for_each_component(k, [&](std::size_t i, Index node, int c) {
      if (dofs.equation(node * dim + c) != IndexMap::constrained && mass[node] > 0)
        velocity[node * dim + c] += change / response * gradient[i][c] / mass[node];
    });
  }
  // Calls visit(entry, node, component) over the stencil of a node.
  template <class Visit>
  void for_each_component(std::size_t k, Visit&& visit) const {
    for (std::size_t i = stencil_start_[k]; i < stencil_start_[k + 1]; ++i)
      for (int c = 0; c < dim; ++c) visit(i, stencil_[i], c);
  }
  template <class BodiesType>
  static bool share_a_body(const BodiesType& bodies, const std::string& a, const std::string& b) {
    const auto first = [&](const std::string& side) {
      return bodies.with_side(side, [](const auto& body, const std::string&) { return body.first_node(); });
    };
    return first(a) == first(b);
  }
  template <class BodiesType>
  static Surface surface(const BodiesType& bodies, const std::string& side) {
    return bodies.with_side(side, [&](const auto& body, const std::string& own) {
      auto facets = body.mesh().side(own).facets;
      if (facets.empty())
        throw std::invalid_argument("surface contact: side \"" + side + "\" has no facets to touch with");
      for (auto& facet : facets)
        for (Index& n : facet) n += body.first_node();
      return Surface(std::move(facets), bodies.positions(), side);
    });
  }
  bool make_stencils() {
    const std::vector<std::size_t> old_start = stencil_start_;
    const std::vector<Index> old = stencil_;
    std::vector<std::vector<Index>> reached(nodes_.size());
    for (std::size_t f = 0; f < points_.slave().size(); ++f) {
      if (points_.candidates(f).empty()) continue;
      for (const Index end : points_.slave().facet(f)) {
        auto& list = reached[place_[static_cast<std::size_t>(end)]];
        for (const Index n : points_.slave().facet(f)) list.push_back(n);
        for (const std::size_t g : points_.candidates(f))
          for (const Index n : points_.master().facet(g)) list.push_back(n);
      }
    }
    stencil_.clear();
    for (std::size_t k = 0; k < reached.size(); ++k) {
      std::sort(reached[k].begin(), reached[k].end());
      reached[k].erase(std::unique(reached[k].begin(), reached[k].end()), reached[k].end());
      stencil_.insert(stencil_.end(), reached[k].begin(), reached[k].end());
      stencil_start_[k + 1] = stencil_.size();
    }
    gap_gradient_.assign(stencil_.size(), Point::Zero());
    if constexpr (with_friction) slip_gradient_.assign(stencil_.size(), Point::Zero());
    return stencil_ != old || stencil_start_ != old_start;
  }
};

}  // namespace stickslip
