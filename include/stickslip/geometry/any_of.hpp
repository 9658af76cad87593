// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/surface_point.hpp>

#include <concepts>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

namespace stickslip::rigid {

/// One tool of several kinds: for scenes whose contacts differ in the kind of tool. Made of any of them; answers as the
/// one that it holds. The choice is a switch over the kinds; no function is virtual.
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

  /// The surface seen from x, a point in the tool's frame.
  template <class S>
  Distance<S, 3> distance(const Vec<S, 3>& x) const {
    return std::visit([&](const auto& tool) -> Distance<S, 3> { return tool.distance(x); }, tool_);
  }

  /// Smallest size that nodes should resolve; infinite for a tool that does not tell [length].
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

  /// The tool itself, if it is of the kind `Tool`; null if not.
  template <class Tool>
  const Tool* as() const {
    return std::get_if<Tool>(&tool_);
  }

 private:
  std::variant<Tools...> tool_;
};

}  // namespace stickslip::rigid
