// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/history.hpp>
#include <stickslip/base/relaxation.hpp>
#include <stickslip/base/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stickslip {

// The memory that contact nodes have where an outer iteration starts: its multipliers and slip bounds are numbers
// within it. One of three, by what the model asks for.

/// A step of one outer iteration starts from the converged state.
template <class Memory>
class StartsConverged {
 public:
  explicit StartsConverged(std::size_t) {}
  void reset(const History<Memory>&) {}
  template <class States>
  void begin_iteration(const States&) {}
  template <class Predicted>
  void predict(Predicted&&, const History<Memory>&) {}
  Memory at(std::size_t k, const History<Memory>& history) const { return history.converged(k); }
  const Memory& advance(std::size_t, const Memory& memory, bool, Real, const History<Memory>&, Real) const {
    return memory;
  }
};

/// Multipliers that outer iterations bring to their values.
template <class Memory>
class StartsAugmented : public StartsConverged<Memory> {
 public:
  explicit StartsAugmented(std::size_t nodes) : StartsConverged<Memory>(nodes), nodes_(nodes) {}
  /// Goes back to the converged state.
  void reset(const History<Memory>& history) {
    if constexpr (History<Memory>::stored) nodes_ = history.converged();
  }
  Memory at(std::size_t k, const History<Memory>&) const { return nodes_[k]; }
  Memory& operator[](std::size_t k) { return nodes_[k]; }
  const Memory& operator[](std::size_t k) const { return nodes_[k]; }

 private:
  std::vector<Memory> nodes_;
};

/// Slip bounds that lag behind the pressure (theory.md, section 5.4): of an earlier state where there is one, of the
/// step's own pressure at a first contact, and of what a probe or an outer iteration sets.
template <class Memory, class Pressure>
class StartsLagged : public StartsAugmented<Memory> {
 public:
  explicit StartsLagged(std::size_t nodes) : StartsAugmented<Memory>(nodes) {
    lag_increment_.setZero(static_cast<Index>(nodes));
    bound_pressure_ = own_change_ = own_pressure_ = lag_increment_;
    own_relaxation_.next(own_change_);  // makes room, for within an iteration nothing is allocated
  }
  void reset(const History<Memory>& history) {
    StartsAugmented<Memory>::reset(history);
    uses_own_ = true;
    own_of_all_ = false;
    own_pressure_.setZero();
    relaxation_.restart();
  }
  /// The step's own pressures begin with those of the last step; there are none at a first contact.
  template <class States>
  void begin_iteration(const States& converged) {
    if (!uses_own_) return;
    for (std::size_t k = 0; k < converged.size(); ++k) own_pressure_[static_cast<Index>(k)] = converged[k].pressure;
    looks_ = 0;
  }
  /// Takes the pressures that the iteration predicts into the bounds that are of the step's own pressure (theory.md,
  /// eq. 5.11). Where they do not settle with the iteration, they stay as they are after some of it.
  template <class Predicted>
  void predict(Predicted&& predicted, const History<Memory>& history) {
    if (!uses_own_ || looks_ == most_looks) return;
    for (Index i = 0; i < own_pressure_.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      own_change_[i] = uses_own(k, history) ? std::max(0.0, predicted(k)) - own_pressure_[i] : 0;
    }
    // The change of a node's pressure by its own friction may be more than the friction (eq. 5.32).
    if (looks_ < 2) own_relaxation_.restart();
    own_relaxation_.next(own_change_);
    for (Index i = 0; i < own_pressure_.size(); ++i)
      own_pressure_[i] = std::max(0.0, own_pressure_[i] + own_relaxation_.omega * own_change_[i]);
    ++looks_;
  }
  Memory at(std::size_t k, const History<Memory>& history) const {
    Memory memory = (*this)[k];
    if (uses_own(k, history)) memory.friction.pressure = Pressure::from_pressure(own_pressure_[static_cast<Index>(k)]);
    return memory;
  }
  /// The memory at the end of the step. That of a node with a bound of the step's own goes on from the converged one.
  Memory advance(std::size_t k, Memory memory, bool touching, Real pressure, const History<Memory>& history,
                 Real dt) const {
    if (touching && uses_own(k, history))
      memory.friction.pressure = Pressure::advance(pressure, history.converged(k).friction.pressure, dt);
    return memory;
  }

  /// Makes all bounds of the step be of its own pressures, until the next `reset`.
  void use_own_of_all() { own_of_all_ = true; }

  /// Differences of the nodes' pressures and those that their bounds are of; `pressure(k)` is the present one.
  template <class Current>
  const Field& lag_increment(Current&& pressure, const History<Memory>& history, Real dt) {
    for (Index i = 0; i < lag_increment_.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      bound_pressure_[i] = Pressure::pressure(pressure(k), at(k, history).friction.pressure, dt);
      lag_increment_[i] = pressure(k) - bound_pressure_[i];
    }
    return lag_increment_;
  }
  /// Makes the bounds those of the pressures a part of the last `lag_increment` on.
  void set_bound_pressure(Real part) {
    uses_own_ = false;
    for (Index i = 0; i < lag_increment_.size(); ++i)
      (*this)[static_cast<std::size_t>(i)].friction.pressure =
          Pressure::from_pressure(std::max(0.0, bound_pressure_[i] + part * lag_increment_[i]));
  }
  /// Goes back from a probe to the bounds of the step.
  void end_probe(const History<Memory>& history) {
    StartsAugmented<Memory>::reset(history);
    uses_own_ = true;
  }
  /// Square of the norm of what the pressures have changed by since the last `lag_increment` [force^2].
  template <class Current>
  Real pressure_response_squared(Current&& pressure) const {
    Real square = 0;
    for (Index i = 0; i < lag_increment_.size(); ++i)
      square += std::pow(pressure(static_cast<std::size_t>(i)) - bound_pressure_[i] - lag_increment_[i], 2);
    return square;
  }

  /// Takes the next outer iteration's bounds, by Aitken's relaxation of the last `lag_increment`.
  void relax() {
    relaxation_.next(lag_increment_);
    set_bound_pressure(relaxation_.omega);
  }
  /// Goes a smaller part of the way of the last `relax`; false when there is nothing left of it.
  bool backtrack() {
    if (!relaxation_.backtrack()) return false;
    set_bound_pressure(relaxation_.omega);
    return true;
  }

 private:
  static constexpr int most_looks = 14;

  // At a first contact there is no converged pressure: none is foretold even for a step without duration.
  bool uses_own(std::size_t k, const History<Memory>& history) const {
    return uses_own_ && (own_of_all_ || !(Pressure::pressure(Real(0), history.converged(k).friction.pressure, 0) > 0));
  }

  Field bound_pressure_, lag_increment_;  // that the last bounds are of [force], and what the pressures exceed it by
  Field own_pressure_, own_change_;       // of the step [force]
  Relaxation own_relaxation_, relaxation_;
  int looks_ = 0;         // at the iteration's pressures so far
  bool uses_own_ = true;  // until an outer iteration or a probe sets the bounds
  bool own_of_all_ = false;
};

}  // namespace stickslip
