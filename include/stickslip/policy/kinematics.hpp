// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/role.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <concepts>

namespace stickslip {

/// How the displacement, of a section or in space, becomes a deformation gradient, and what volume stands behind it.
/// docs/policies.md, section Kinematics.
template <class K>
concept KinematicsPolicy = requires(const K& kinematics, const Vec<Real, K::dim>& X) {
  requires std::same_as<typename K::Role, role::Kinematics>;
  requires std::same_as<decltype(K::hoop), const bool>;
  requires K::TensorPattern::dim == K::dim;
  { kinematics.volume_factor(X) } -> std::same_as<Real>;
};

}  // namespace stickslip
