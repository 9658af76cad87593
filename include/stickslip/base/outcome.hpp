// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/types.hpp>

#include <string>

namespace stickslip {

/// Why a computation stopped short of its end.
enum class FailureCause {
  none,              ///< it did not
  element_inverted,  ///< a deformation gradient with no positive determinant
  not_finite,        ///< a NaN or an infinity in a residual, a tangent, a load or a tool's position
  not_rigid,         ///< a tool's pose whose rotation stretches or mirrors it
  material_failed,   ///< a material's own iteration did not converge
  friction_failed,   ///< a friction law's slip did not converge, or it softens faster than its stiffness can follow
  singular_matrix,   ///< the factorisation met a zero pivot: a rigid-body mode or a limit point
  unsupported,       ///< a rigid-body motion that no support and no tool resists
  slides,            ///< nothing but friction holds the body, and it is not enough
  contradicting_supports,  ///< two supports that prescribe different values of one component
  not_converged,           ///< the iteration limit was reached
  outer_failed,   ///< the outer iterations of a step, each converged, did not settle: multipliers or a lagging bound
  lag_unstable,   ///< a bound that lags changes its own pressure by more than it lags: no step is small enough
  slide_turns,    ///< a tool turned, or moved to and fro, by more than a node's slide over the step can follow
  tunnelled,      ///< a node's way over the step led through a tool, whose force it never felt
  energy_gained,  ///< the time scheme has made energy, beyond the limit that was asked for
  stalled,        ///< no step along the Newton direction lowers the residual
  digits_lost,    ///< round-off leaves of the forces less than the tolerance asks for
};

/// The sentence part that names a cause.
inline const char* describe(FailureCause cause) {
  switch (cause) {
    case FailureCause::none:
      return "nothing";
    case FailureCause::element_inverted:
      return "an element turned inside out";
    case FailureCause::not_finite:
      return "a value was not finite";
    case FailureCause::not_rigid:
      return "a tool's rotation was not one: it stretches or mirrors the tool";
    case FailureCause::material_failed:
      return "a material's return map did not converge";
    case FailureCause::friction_failed:
      return "a friction law's slip could not be found";
    case FailureCause::singular_matrix:
      return "the tangent matrix is singular";
    case FailureCause::unsupported:
      return "nothing holds the body: no support and no tool resists a rigid-body motion of it";
    case FailureCause::slides:
      return "nothing but friction holds the body, and it slides";
    case FailureCause::contradicting_supports:
      return "two supports contradict each other";
    case FailureCause::not_converged:
      return "the Newton iteration did not converge within its limit";
    case FailureCause::outer_failed:
      return "the passes over the step did not settle";
    case FailureCause::lag_unstable:
      return "the friction bound's lag feeds back on the pressure and grows from step to step, whatever their "
             "size; take the current pressure";
    case FailureCause::slide_turns:
      return "a tool turned, or moved to and fro, within the step by more than a node's slide can follow";
    case FailureCause::tunnelled:
      return "a node went through a tool or a surface within the step";
    case FailureCause::energy_gained:
      return "the time scheme has gained energy out of nothing";
    case FailureCause::stalled:
      return "the Newton iteration stalled";
    case FailureCause::digits_lost:
      return "round-off leaves of the forces less than the tolerance asks for";
  }
  return "an unknown cause";
}

/// Where in the model a failure arose.
struct Location {
  enum class Kind { nowhere, element, node, contact_node };
  Kind kind = Kind::nowhere;
  Index number = -1;
};

/// A failure below the level of a step: what happened, and where. Kernels return it; they neither throw nor print.
struct Failure {
  FailureCause cause = FailureCause::none;
  Location location{};
  explicit operator bool() const { return cause != FailureCause::none; }
};

/// How a run ended. True when it reached its end; otherwise step, time, place and cause of the failure, and what was
/// tried against it. The last converged state is in the problem still.
struct [[nodiscard]] Outcome {
  Failure failure{};
  Index step = 0;       ///< number of the step that failed, from 1
  Real time = 0;        ///< the last converged time
  Real tried_step = 0;  ///< the smallest time increment that was tried
  Index attempts = 0;   ///< attempts at the failed step
  std::string
      detail{};  ///< what of the scene is concerned, by name: a contact, a part of the body; empty if nothing is

  explicit operator bool() const { return failure.cause == FailureCause::none; }

  /// One sentence for a person.
  std::string message() const {
    if (*this) return "completed";
    std::string text =
        "step " + std::to_string(step) + " after time " + brief(time) + " failed: " + describe(failure.cause);
    if (failure.location.kind == Location::Kind::element)
      text += " (element " + std::to_string(failure.location.number) + ")";
    if (failure.location.kind == Location::Kind::node)
      text += " (node " + std::to_string(failure.location.number) + ")";
    if (failure.location.kind == Location::Kind::contact_node)
      text += " (contact node " + std::to_string(failure.location.number) + ")";
    if (!detail.empty()) text += ": " + detail;
    if (attempts == 0) return text;
    return text + "; tried " + std::to_string(attempts) + " times down to a time increment of " + brief(tried_step);
  }
};

}  // namespace stickslip
