// SPDX-License-Identifier: BSL-1.0
#pragma once

/// What a policy says it is, by `using Role = stickslip::role::Material;` and the like. Matching signatures do not
/// imply matching meaning, so every contract asks for its role by name.
namespace stickslip::role {

struct Kinematics {};
struct Element {};
struct Material {};
struct Hardening {};
struct Friction {};
struct PressureSource {};
struct Enforcement {};
struct TimeIntegration {};
struct Damping {};
struct Surfaces {};
struct LinearSolver {};

}  // namespace stickslip::role
