// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/dofs.hpp>
#include <stickslip/base/nodal.hpp>
#include <stickslip/geometry/pose.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace stickslip {

/// Velocities of a place that is fixed to a tool, over a step: at its start and its end, to second order by the poses
/// at both and halfway, and the mean. A tool that keeps its velocity has one.
template <int dim>
struct PlaceVelocity {
  Vec<Real, dim> start, end, mean;

  PlaceVelocity(const std::array<rigid::Pose<dim>, 3>& poses, const Vec<Real, dim>& on_tool, Real dt) {
    const Vec<Real, dim> x0 = poses[0].in_space(on_tool), x1 = poses[1].in_space(on_tool),
                         x2 = poses[2].in_space(on_tool);
    for (int i = 0; i < dim; ++i) {
      mean[i] = (x2[i] - x0[i]) / dt;
      const Real bend = 2 * (x2[i] - 2 * x1[i] + x0[i]) / dt;
      start[i] = mean[i] - bend;
      end[i] = mean[i] + bend;
    }
  }
};

/// Normal velocity of a pressed node after a step, against the tool (theory.md, eq. 7.13): where the step turned it
/// round or more than doubled it, the value between the one that the step left and its mean that has the least energy.
inline Real persistent(Real before, Real after, Real mean) {
  if (!(2 * before * after < after * after)) return after;
  return std::clamp(Real(0), std::min(after, mean), std::max(after, mean));
}
/// The same of the tangential velocity of a sticking node: the shortest vector between the two (eq. 7.14).
template <int dim>
Vec<Real, dim> persistent(const Vec<Real, dim>& before, const Vec<Real, dim>& after, const Vec<Real, dim>& mean) {
  if (!(2 * contraction(before, after) < contraction(after, after))) return after;
  const Vec<Real, dim> way = minus(mean, after);
  const Real length2 = contraction(way, way);
  Vec<Real, dim> shortest = after;
  if (length2 > 0) add(shortest, way, std::clamp(-contraction(after, way) / length2, Real(0), Real(1)));
  return shortest;
}

/// A force on a surface whose normal the step turned from n0 to n1, as it stood halfway: turned back by half the angle
/// (theory.md, eq. 7.13a).
/// At an edge, where the normal jumps, it has no way to turn.
template <int dim>
Vec<Real, dim> halfway(const Vec<Real, dim>& n0, const Vec<Real, dim>& n1, const Vec<Real, dim>& force) {
  if (contraction(n0, n1) < 0.8) return force;
  Vec<Real, dim> middle = n0;
  add(middle, n1);
  middle /= middle.norm();
  Vec<Real, dim> sum = middle, turned = force;
  add(sum, n1);
  add(turned, sum, -contraction(sum, force) / (1 + contraction(middle, n1)));
  add(turned, middle, 2 * contraction(n1, force));
  return turned;
}

/// The share of a change of velocity v that leaves v^2 at no more than the larger of its value and `limit`
/// (eta of eq. 7.13a).
template <int dim>
Real share_within(const Vec<Real, dim>& v, const Vec<Real, dim>& change, Real limit) {
  const Real a = contraction(change, change), b = contraction(v, change),
             room = std::max(Real(0), limit - contraction(v, v));
  if (!(a > 0)) return 0;
  return std::clamp((-b + std::sqrt(b * b + a * room)) / a, Real(0), Real(1));
}

/// Adds to the free components of a node's velocity.
template <int dim>
void add_free(Field& velocity, const Dofs& dofs, Index node, const Vec<Real, dim>& change) {
  for (int i = 0; i < dim; ++i)
    if (dofs.equation(node * dim + i) != Dofs::constrained) velocity[node * dim + i] += change[i];
}

/// Changes a node's velocity by `amount` along a direction, through its free components alone. Where these have next to
/// no part in the direction nothing is done: the tool works on the support.
template <int dim>
void push(Field& velocity, const Dofs& dofs, Index node, Vec<Real, dim> direction, Real amount) {
  for (int i = 0; i < dim; ++i)
    if (dofs.equation(node * dim + i) == Dofs::constrained) direction[i] = 0;
  const Real part = contraction(direction, direction);
  if (part < 0.01) return;
  for (int i = 0; i < dim; ++i) direction[i] *= amount / part;
  add_at_node(velocity, node, direction);
}

}  // namespace stickslip
