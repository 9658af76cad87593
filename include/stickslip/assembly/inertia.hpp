// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/body.hpp>
#include <stickslip/base/nodal.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace stickslip {

/// Mass, velocity and acceleration of a body, and the weights of its time scheme (theory.md, section 7). Exists only in
/// bundles with inertia.
template <class BodyType, class Policy>
class InertiaForcesOf {
 public:
  using Matrix = typename BodyType::Matrix;
  using Element = typename BodyType::Element;
  static constexpr int dim = BodyType::dim;
  static constexpr int nodes = Element::nodes;

  InertiaForcesOf(const BodyType& body, const Policy& policy) : body_(body), policy_(policy) {
    const auto rule = Element::Cell::quadrature();
    mass_.reserve(body.mesh().cells.size());
    for (Index e = 0; e < body.mesh().cell_count(); ++e) {
      Mat<Real, nodes> m = Mat<Real, nodes>::Zero();
      for (std::size_t p = 0; p < rule.size(); ++p) {
        const Vec<Real, nodes> N = Element::Cell::shape(rule[p].xi);
        add(m, product_transposed(N, N), policy.density * body.geometry(e)[p].weight);
      }
      if (policy.lumped)
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b < nodes; ++b)
            if (a != b) m(a, a) += std::exchange(m(a, b), 0.0);
      mass_.push_back(m);
    }
    const Index components = body.mesh().node_count() * dim;
    for (Field* f : {&velocity_, &acceleration_, &start_, &old_forces_, &force_, &trial_acceleration_, &work_})
      f->setZero(components);
  }

  /// Makes the mass matrix in the pattern of the system's.
  void connect(const Matrix& matrix) {
    matrix_ = matrix;
    matrix_.set_zero();
    Mat<Real, nodes * dim> block;
    for (Index e = 0; e < body_.mesh().cell_count(); ++e) {
      block.setZero();
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b)
          for (int i = 0; i < dim; ++i) block(a * dim + i, b * dim + i) = mass_[static_cast<std::size_t>(e)](a, b);
      matrix_.add(body_.slots(e), block);
    }
  }

  /// The step of size dt that starts from the converged displacements u.
  void begin(const Field& u, Real dt) {
    start_ = u;
    dt_ = dt;
  }

  /// Displacements after dt at the acceleration of the start: the guess of the step.
  void predict(Field& u) const { u = start_ + dt_ * velocity_ + 0.5 * dt_ * dt_ * acceleration_; }

  /// Turns forces at the end of the step into the balance of the scheme: `forces` (internal + contact - external, by
  /// component) and `matrix` (their derivative) become the generalised-alpha residual and tangent (eq. 7.3, 7.5).
  void apply(const Field& u, const Field& forces, Field& balance, Matrix& matrix) {
    const TimeScheme& s = policy_.scheme;
    force_ = forces;
    trial_acceleration_ = (u - start_ - dt_ * velocity_) / (s.beta * dt_ * dt_) - (0.5 / s.beta - 1) * acceleration_;
    work_ = (1 - s.alpha_m) * trial_acceleration_ + s.alpha_m * acceleration_;
    balance = (1 - s.alpha_f) * forces + s.alpha_f * old_forces_;
    add_product(work_, balance);
    matrix.combine(1 - s.alpha_f, matrix_, (1 - s.alpha_m) / (s.beta * dt_ * dt_));
  }

  /// Largest entry of what `apply` adds to the tangent [force / length].
  Real stiffness() const {
    return (1 - policy_.scheme.alpha_m) / (policy_.scheme.beta * dt_ * dt_) * matrix_.largest();
  }

  /// Makes the state of the last `apply` the converged one.
  void commit() {
    const TimeScheme& s = policy_.scheme;
    velocity_ += dt_ * ((1 - s.gamma) * acceleration_ + s.gamma * trial_acceleration_);
    acceleration_.swap(trial_acceleration_);
    old_forces_.swap(force_);
  }

  /// Consistent start: accelerations that balance `forces` at the lumped mass; constrained components start with none.
  void start(const Dofs& dofs, const Field& forces) {
    old_forces_ = forces;
    work_.setOnes();
    Field lumped = Field::Zero(work_.size());
    add_product(work_, lumped);
    for (Index c = 0; c < dofs.components(); ++c)
      acceleration_[c] = dofs.equation(c) == Dofs::constrained ? 0 : -forces[c] / lumped[c];
  }

  /// target += M field.
  void add_product(const Field& field, Field& target) const {
    for (Index e = 0; e < body_.mesh().cell_count(); ++e) {
      const auto& cell = body_.mesh().cells[static_cast<std::size_t>(e)];
      const Mat<Real, nodes>& m = mass_[static_cast<std::size_t>(e)];
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b)
          for (int i = 0; i < dim; ++i)
            target[cell[static_cast<std::size_t>(a)] * dim + i] +=
                m(a, b) * field[cell[static_cast<std::size_t>(b)] * dim + i];
    }
  }

  /// Local error of the last converged step by component: (beta - 1/6) dt^2 (a_{n+1} - a_n) (eq. 7.8), its largest norm
  /// over the nodes [length]. Call it after `apply`, before `commit`.
  Real local_error() const {
    Real largest = 0;
    for (Index n = 0; n < body_.mesh().node_count(); ++n)
      largest = std::max(largest, minus(at_node<dim>(trial_acceleration_, n), at_node<dim>(acceleration_, n)).norm());
    return std::abs(policy_.scheme.beta - Real(1) / 6) * dt_ * dt_ * largest;
  }

  /// The converged state.
  void serialize(Archive& archive) {
    archive("velocity", velocity_);
    archive("acceleration", acceleration_);
    archive("forces at the last step", old_forces_);
  }

  Real kinetic_energy() const {
    Field momentum = Field::Zero(velocity_.size());
    add_product(velocity_, momentum);
    return 0.5 * velocity_.dot(momentum);
  }
  const Field& velocity() const { return velocity_; }
  Field& velocity() { return velocity_; }
  const Field& acceleration() const { return acceleration_; }
  const TimeScheme& scheme() const { return policy_.scheme; }

 private:
  const BodyType& body_;
  Policy policy_;
  std::vector<Mat<Real, nodes>> mass_;  // of an element, between nodes: the same for every component
  Matrix matrix_;
  Field velocity_, acceleration_, start_, old_forces_, force_, trial_acceleration_, work_;
  Real dt_ = 0;
};

/// The inertia of a bundle; bundles that differ in contact or solver share it.
template <class Model>
using InertiaForces = InertiaForcesOf<Body<Model>, typename Model::Inertia>;

}  // namespace stickslip
