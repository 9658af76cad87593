// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/stored_if.hpp>
#include <stickslip/base/types.hpp>

#include <cstddef>
#include <vector>

namespace stickslip {

/// What Newton's method learns of the contact nodes' friction within an iteration: a node that slides to and fro from
/// one search to the next is linearised as one that sticks (theory.md, section 6.4), and so is a node that sticks at
/// the start of the iteration. `m` surface coordinates; `probed` where Newton's method probes the residual.
template <int m, bool probed>
class SlipReversals {
 public:
  explicit SlipReversals(std::size_t nodes) : nodes_(nodes) {}

  void begin_iteration() {
    nodes_.assign(nodes_.size(), SlipReversal{});
    sticks_where_pressure_is_lost_ = false;
    if constexpr (probed) start_.probing = false;
  }
  /// Makes the iteration linearise nodes as sticking that lose their pressure though their gaps ask for one; with
  /// `all`, it starts with every node sticking.
  void retry(bool all) {
    sticks_where_pressure_is_lost_ = true;
    if (all)
      for (SlipReversal& node : nodes_) node.stuck = true;
  }
  void set_stuck(std::size_t k, bool stuck) { nodes_[k].stuck = stuck; }

  /// Goes on to the next search along a solution. A probe of the tangent sees the nodes as they were where the search
  /// began, which is what the matrix is made of.
  void next_search(bool probe) {
    if constexpr (probed) {
      (probe ? nodes_ : start_.nodes) = probe ? start_.nodes : nodes_;
      start_.probing = probe;
    }
    if (probe) return;
    for (SlipReversal& node : nodes_) {
      if (node.held) node.now.setZero();
      node = {
          .before = node.now, .now = node.now, .again = node.again || node.turned, .lost = node.lost || node.pressed};
    }
  }
  /// Notes the friction force of a node at an iterate, and whether its gap asks for a pressure.
  void note(std::size_t k, const Vec<Real, m>& friction_force, bool sliding, bool pressed) {
    if (probing()) return;
    SlipReversal& node = nodes_[k];
    node.sticks = sticks_;
    node.held = reversed(k) && sliding;
    node.now = friction_force;
    node.turned = node.turned || node.now.dot(node.before) < 0;
    node.pressed = node.pressed || pressed;
  }
  /// Whether a sliding node at a pressure is linearised as one that sticks: it slides to and fro, or the iteration has
  /// led its pressure to zero where its gap asks for one, or no pressure is known yet for its slip bound.
  /// An evaluation `again` at the same iterate finds the same.
  bool sticks(std::size_t k, Real pressure, bool again) {
    const SlipReversal& node = nodes_[k];
    sticks_ = again ? node.sticks
                    : node.stuck || (sticks_where_pressure_is_lost_ && node.lost && !(pressure > 0)) || reversed(k);
    return sticks_;
  }

 private:
  struct SlipReversal {
    Vec<Real, m> before = Vec<Real, m>::Zero();  // friction force where the search began
    Vec<Real, m> now = Vec<Real, m>::Zero();
    bool turned = false, again = false, held = false;  // in this search, in an earlier one
    bool pressed = false, lost = false;                // its gap asked for a pressure, in an earlier search
    bool stuck = false;                                // where the iteration begins
    bool sticks = false;                               // in the last evaluation
  };
  // Whether the search has been at a place where the node slides the other way (theory.md, eq. 6.14).
  bool reversed(std::size_t k) const { return nodes_[k].turned && nodes_[k].again; }
  bool probing() const {
    if constexpr (probed) return start_.probing;
    return false;
  }

  std::vector<SlipReversal> nodes_;
  bool sticks_where_pressure_is_lost_ = false;
  bool sticks_ = false;  // the node that is being evaluated
  struct Start {
    std::vector<SlipReversal> nodes{};
    bool probing = false;
  };
  [[no_unique_address]] StoredIf<probed, Start, SlipReversals> start_{};
};

/// Without friction nothing slides to and fro.
struct NoSlipReversals {
  explicit NoSlipReversals(std::size_t) {}
  void begin_iteration() {}
  void next_search(bool) {}
  bool sticks(std::size_t, Real, bool) const { return false; }
};

}  // namespace stickslip
