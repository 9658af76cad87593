// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/stored_if.hpp>

#include <cassert>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// Memory of many points: of the converged state, and of the trial that the last evaluation made. A trial that is not
/// committed costs nothing to undo; `commit` needs one. An empty `T` takes no byte.
template <class T, bool stored_ = !std::is_empty_v<T>>
class History {
 public:
  static constexpr bool stored = stored_;

  explicit History(std::size_t count = 0) {
    if constexpr (stored) {
      converged_.resize(count);
      trial_.resize(count);
    }
  }
  /// The converged memory of a point.
  decltype(auto) converged(std::size_t k) const {
    if constexpr (stored)
      return static_cast<const T&>(converged_[k]);
    else
      return T{};
  }
  /// The trial memory of a point.
  decltype(auto) trial(std::size_t k) const {
    if constexpr (stored)
      return static_cast<const T&>(trial_[k]);
    else
      return T{};
  }
  void set_trial([[maybe_unused]] std::size_t k, [[maybe_unused]] const T& value) {
    if constexpr (stored) {
      trial_[k] = value;
      has_trial_ = true;
    }
  }
  /// Makes the trial the converged memory.
  void commit() {
    if constexpr (stored) {
      assert((has_trial_ || converged_.empty()) && "History::commit needs History::set_trial since the last commit");
      std::swap(converged_, trial_);
      has_trial_ = false;
    }
  }

  /// The converged memory of all points.
  const std::vector<T>& converged() const requires stored_ { return converged_; }
  void serialize([[maybe_unused]] Archive& archive, [[maybe_unused]] const std::string& name) {
    if constexpr (stored) archive(name, converged_);
  }

 private:
  [[no_unique_address]] StoredIf<stored, std::vector<T>, History> converged_;
  [[no_unique_address]] StoredIf<stored, std::vector<T>, struct TrialTag> trial_;
  [[no_unique_address]] StoredIf<stored, bool, struct HasTrialTag> has_trial_{};
};

}  // namespace stickslip
