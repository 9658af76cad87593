// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/dofs/index_map.hpp>
#include <stickslip/geometry/pose.hpp>
#include <stickslip/geometry/surface_point.hpp>
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
/// (theory.md, eq. 7.15).
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
/// (eta of eq. 7.15).
template <int dim>
Real share_within(const Vec<Real, dim>& v, const Vec<Real, dim>& change, Real limit) {
  const Real a = contraction(change, change), b = contraction(v, change),
             room = std::max(Real(0), limit - contraction(v, v));
  if (!(a > 0)) return 0;
  return std::clamp((-b + std::sqrt(b * b + a * room)) / a, Real(0), Real(1));
}

/// Adds to the free components of a node's velocity.
template <int dim>
void add_free(Field& velocity, const IndexMap& dofs, Index node, const Vec<Real, dim>& change) {
  for (int i = 0; i < dim; ++i)
    if (dofs.equation(node * dim + i) != IndexMap::constrained) velocity[node * dim + i] += change[i];
}

/// Changes a node's velocity by `amount` along a direction, through its free components alone. Where these have next to
/// no part in the direction nothing is done: the tool works on the support.
template <int dim>
void push(Field& velocity, const IndexMap& dofs, Index node, Vec<Real, dim> direction, Real amount) {
  for (int i = 0; i < dim; ++i)
    if (dofs.equation(node * dim + i) == IndexMap::constrained) direction[i] = 0;
  const Real part = contraction(direction, direction);
  if (part < 0.01) return;
  for (int i = 0; i < dim; ++i) direction[i] *= amount / part;
  add_at_node(velocity, node, direction);
}

/// Makes the velocity of a pressed node persist in contact (theory.md, eq. 7.13 to 7.15), after a step from the
/// converged displacements `from` and velocities `before` to the displacements `to` and `velocity`. X is the node's
/// reference position, `old` and `now` are its states at both ends; `poses` are the tool's at the start, halfway and at
/// the end of the step. Without `friction` the tangential velocity stays as it is.
template <int dim, class Tool, class State>
void persist(const Tool& tool, const std::array<rigid::Pose<dim>, 3>& poses, Real dt, const IndexMap& dofs, Index n,
             const Vec<Real, dim>& X, const State& old, const State& now, bool friction, const Field& from,
             const Field& to, const Field& before, Real mass, Field& velocity) {
  const auto on_tool = [&](const rigid::Pose<dim>& pose, const Field& u) {
    Vec<Real, dim> x = X;
    add(x, at_node<dim>(u, n));
    return pose.on_tool(x);
  };
  // Where the step began and where it ended, on the tool.
  const Vec<Real, dim> y0 = on_tool(poses[0], from), y1 = on_tool(poses[2], to);
  const auto normal_at = [&](const rigid::Pose<dim>& pose, const Vec<Real, dim>& y) {
    return product(pose.rotation, distance_to<Real, dim>(tool, y).normal);
  };
  const Vec<Real, dim> n0 = normal_at(poses[0], y0), n1 = normal_at(poses[2], y1);
  const PlaceVelocity<dim> of_tool(poses, y1, dt);
  Vec<Real, dim> mean = minus(at_node<dim>(to, n), at_node<dim>(from, n));
  mean /= dt;
  const Vec<Real, dim> v0 = minus(at_node<dim>(before, n), of_tool.start);
  Vec<Real, dim> v1 = minus(at_node<dim>(velocity, n), of_tool.end);
  if (old.pressure > 0) {
    const Real lasting = std::min(1.0, old.pressure / now.pressure);
    const Vec<Real, dim> turn = scaled(minus(halfway<dim>(n0, n1, now.force), now.force), -lasting * dt / mass);
    const Vec<Real, dim> led = minus(scaled(minus(mean, of_tool.mean), Real(2)), v0);  // that the motion asks for
    const Real limit = std::max(contraction(v0, v0), contraction(led, led));
    add_free<dim>(velocity, dofs, n, scaled(turn, share_within(v1, turn, limit)));
    v1 = minus(at_node<dim>(velocity, n), of_tool.end);
  }
  const Real rate0 = contraction(n0, minus(at_node<dim>(before, n), PlaceVelocity<dim>(poses, y0, dt).start)),
             rate1 = contraction(n1, v1);
  const Real kept = persistent(rate0, rate1, (now.gap - old.gap) / dt);
  if (kept != rate1) push<dim>(velocity, dofs, n, n1, kept - rate1);
  if (!friction || now.sliding) return;
  const auto along = [&](const Vec<Real, dim>& v) { return Vec<Real, dim>(minus(v, scaled(n1, contraction(n1, v)))); };
  const Vec<Real, dim> t1 = along(v1);
  const Vec<Real, dim> change = minus(persistent<dim>(along(v0), t1, along(minus(mean, of_tool.mean))), t1);
  const Real amount = change.norm();
  if (amount > 0) push<dim>(velocity, dofs, n, scaled(change, 1 / amount), amount);
}

}  // namespace stickslip
