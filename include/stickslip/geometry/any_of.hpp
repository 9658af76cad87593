// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>

#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

namespace stickslip::rigid {

/// A tool of one of several types, for scenes with different tools. Constructed from any of them; calls are forwarded
/// to the held tool by std::visit, without virtual functions.
template <class... Tools>
class AnyOf {
 public:
  template <class Tool>
    requires(std::same_as<std::remove_cvref_t<Tool>, Tools> || ...)
  AnyOf(
      Tool&& tool)  // NOLINT(google-explicit-constructor, bugprone-forwarding-reference-overload): takes the kinds only
      : tool_(std::forward<Tool>(tool)) {}

  bool empty() const {
    return std::visit([](const auto& tool) { return tool.empty(); }, tool_);
  }

  /// Signed distance at x and its derivatives, in the tool's frame.
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    return std::visit([&](const auto& tool) -> Distance<S, 3> { return tool.distance(x); }, tool_);
  }

  /// Smallest feature size that nodes should resolve [length]; infinite for a tool without `smallest_size`.
  Real smallest_size() const {
    return std::visit(
        [](const auto& tool) {
          if constexpr (requires { tool.smallest_size(); })
            return Real(tool.smallest_size());
          else
            return std::numeric_limits<Real>::infinity();
        },
        tool_);
  }

  /// The held tool if it is a `Tool`, else null.
  template <class Tool>
  const Tool* as() const {
    return std::get_if<Tool>(&tool_);
  }

 private:
  std::variant<Tools...> tool_;
};

}  // namespace stickslip::rigid
