// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <stickslip/linear_solver/eigen_direct.hpp>

#include <doctest/doctest.h>

namespace scene {

/// Speed of the tool that the block is on.
constexpr Real speed = 2;

/// A block on a flat tool that slides along, pressed more and more. Force on the tool at the end.
template <class F>
V sliding_block(const typename F::Law& law, Index steps, Real growth,
                std::function<void(const StepReport&, const V&)> look = {}) {
  using M = Model<EigenDirect, F>;
  Contact<M> contact{.side = "bottom",
                     .tool = rigid::line({0, 0}, {1, 0}),
                     .motion = [](Real t) { return V(speed * t, 0); },
                     .friction = law,
                     .enforcement = {.normal = 1e5, .tangential = 2e4}};
  Problem<M> p({.body = mesh::rectangle({.size = {4, 2}, .cells = {4, 2}}),
                .material = material<Hencky>(),
                .contacts = {contact}});
  p.hold("top", 0).drive("top", 1, [growth](Real t) { return -0.02 - growth * t * (1 + 0.5 * t); });
  auto march = p.march({.end = 1, .steps = steps, .tolerance = 1e-10});
  for (const auto& step : march)
    if (look) look(step, p.contact_force("bottom"));
  CHECK(bool(march.outcome()));
  return p.contact_force("bottom");
}

}  // namespace scene
