// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/body/body.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <vector>

namespace stickslip {

/// Mass, velocity and acceleration of a body, its damping, and the weights of its time scheme (theory.md, section 7).
/// Exists only in models with inertia. Forces are of two kinds: smooth ones, of the body and of loads, which are
/// averaged over a step and make the acceleration; and those of contact, which are impulses at its end and stay out of
/// it (eq. 7.11, 7.12).
template <class BodyType, class Policy, class Damping, bool with_contact>
class InertiaForcesOf {
 public:
  using Matrix = typename BodyType::Matrix;
  using Element = typename BodyType::Element;
  static constexpr int dim = BodyType::dim;
  static constexpr int nodes = Element::nodes;
  static constexpr bool damped = Damping::active;
  /// Whether the matrix of the body has a weight of its own.
  static constexpr bool weighs_body = with_contact || damped;
  /// The nodes of contact sides: true where a node is one.
  using ContactNodes = std::vector<bool>;

  InertiaForcesOf(const BodyType& body, const Policy& policy, const Damping& damping, const ContactNodes& touches)
      : body_(body), policy_(policy), damping_(damping) {
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
      if constexpr (with_contact) release(m, e, touches);
      mass_.push_back(m);
    }
    const Index components = body.mesh().node_count() * dim;
    for (Field* f : {&velocity_, &acceleration_, &start_, &old_forces_, &force_, &trial_acceleration_, &work_})
      f->setZero(components);
    if constexpr (damped) old_internal_.setZero(components);
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

  /// Weight omega of the forces of contact at the end of a step in the balance (eq. 7.12); without contact that of the
  /// body's.
  Real contact_share() const {
    if constexpr (with_contact) return (1 - policy_.scheme.alpha_m) / (2 * policy_.scheme.beta);
    return 1 - policy_.scheme.alpha_f;
  }
  /// Weight of the derivative of the internal forces over that of contact forces.
  Real body_share() const {
    Real weight = 1 - policy_.scheme.alpha_f;
    if constexpr (damped) weight += damping_.tau / dt_;
    return weight / contact_share();
  }

  /// Largest entry of what `apply` adds to the tangent [force / length].
  Real stiffness() const {
    return (1 - policy_.scheme.alpha_m) / (policy_.scheme.beta * dt_ * dt_) * matrix_.largest();
  }

  /// Turns forces at the end of the step into the balance of the scheme (eq. 7.12). `balance` holds the forces of
  /// contact, and `matrix`, where there is one, their derivative and `body_share` times that of the internal forces.
  /// These become residual and tangent.
  void apply(const Field& u, const Field& internal, const Field& external, Field& balance, Matrix* matrix) {
    const TimeScheme& s = policy_.scheme;
    force_ = internal - external;
    trial_acceleration_ = (u - start_ - dt_ * velocity_) / (s.beta * dt_ * dt_) - (0.5 / s.beta - 1) * acceleration_;
    work_ = (1 - s.alpha_m) * trial_acceleration_ + s.alpha_m * acceleration_;
    balance = contact_share() * balance + (1 - s.alpha_f) * force_ + s.alpha_f * old_forces_;
    if constexpr (damped) balance += damping_.tau / dt_ * (internal - old_internal_);  // (7.16)
    add_product(work_, balance);
    if (matrix) matrix->combine(contact_share(), matrix_, (1 - s.alpha_m) / (s.beta * dt_ * dt_));
  }

  /// Makes the state of the last `apply`, at the displacements u, the converged one. Free nodes of contact sides take
  /// the impulse of the forces `contact` as a change of their velocity, and none of it as acceleration (eq. 7.11).
  void commit([[maybe_unused]] const IndexMap& dofs, [[maybe_unused]] const Field& u,
              [[maybe_unused]] const Field& internal, [[maybe_unused]] const Field& contact) {
    const TimeScheme& s = policy_.scheme;
    if constexpr (damped) {
      dissipated_ = damping_.tau / dt_ * (internal - old_internal_).dot(u - start_);
      old_internal_ = internal;
    }
    if constexpr (with_contact) {
      work_ = velocity_;
      for_each_impulse(dofs, contact, [&](Index component, Real c) {
        trial_acceleration_[component] += c / (2 * s.beta);
        velocity_[component] -= dt_ * c;
      });
    }
    velocity_ += dt_ * ((1 - s.gamma) * acceleration_ + s.gamma * trial_acceleration_);
    acceleration_.swap(trial_acceleration_);
    old_forces_.swap(force_);
  }

  /// Consistent start: accelerations that balance the smooth forces at the lumped mass; constrained components start
  /// with none.
  void start(const IndexMap& dofs, const Field& internal, const Field& external) {
    old_forces_ = internal - external;
    if constexpr (damped) old_internal_ = internal;
    work_.setOnes();
    Field lumped = Field::Zero(work_.size());
    add_product(work_, lumped);
    for (Index c = 0; c < dofs.components(); ++c)
      acceleration_[c] = dofs.equation(c) == IndexMap::constrained ? 0 : -old_forces_[c] / lumped[c];
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
  /// over the nodes [length]; the impulses of `contact` are no error of the motion between them. Call it after `apply`,
  /// before `commit`.
  Real local_error([[maybe_unused]] const IndexMap& dofs, [[maybe_unused]] const Field& contact) {
    work_ = trial_acceleration_ - acceleration_;
    if constexpr (with_contact)
      for_each_impulse(dofs, contact,
                       [&](Index component, Real c) { work_[component] += c / (2 * policy_.scheme.beta); });
    Real largest = 0;
    for (Index n = 0; n < body_.mesh().node_count(); ++n) largest = std::max(largest, at_node<dim>(work_, n).norm());
    return std::abs(policy_.scheme.beta - Real(1) / 6) * dt_ * dt_ * largest;
  }

  /// The converged state.
  void serialize(Archive& archive) {
    archive("velocity", velocity_);
    archive("acceleration", acceleration_);
    archive("smooth forces at the last step", old_forces_);
    if constexpr (damped) archive("internal forces at the last step", old_internal_);
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

  /// Displacements at the start of the step that was committed last, and until the next begins the velocities there.
  const Field& start_of_step() const { return start_; }
  const Field& velocity_before() const requires with_contact { return work_; }
  /// Masses of the nodes of contact sides, by node; 0 elsewhere.
  const Field& contact_mass() const requires with_contact { return contact_mass_; }
  /// What damping has taken in that step [energy].
  Real dissipated() const requires damped { return dissipated_; }

 private:
  // Lumps the rows of contact nodes (eq. 7.10): an impulse at one stays there. Adds to the nodes' own masses.
  void release(Mat<Real, nodes>& m, Index e, const ContactNodes& touches) requires with_contact {
    if (contact_mass_.size() == 0) contact_mass_.setZero(body_.mesh().node_count());
    const auto& cell = body_.mesh().cells[static_cast<std::size_t>(e)];
    const auto touching = [&](int a) { return touches[static_cast<std::size_t>(cell[static_cast<std::size_t>(a)])]; };
    for (int a = 0; a < nodes; ++a) {
      if (!touching(a)) continue;
      for (int b = 0; b < nodes; ++b)
        if (a != b) {
          m(a, a) += std::exchange(m(a, b), 0.0);
          m(b, b) += std::exchange(m(b, a), 0.0);
        }
    }
    for (int a = 0; a < nodes; ++a)
      if (touching(a)) contact_mass_[cell[static_cast<std::size_t>(a)]] += m(a, a);
  }

  // Calls visit(component, c) for the free components of contact nodes, c = force / mass of the node.
  template <class Visit>
  void for_each_impulse(const IndexMap& dofs, const Field& contact, Visit&& visit) const requires with_contact {
    for (Index n = 0; n < contact_mass_.size(); ++n)
      if (contact_mass_[n] > 0)
        for (Index k = n * dim; k < (n + 1) * dim; ++k)
          if (contact[k] != 0 && dofs.equation(k) != IndexMap::constrained) visit(k, contact[k] / contact_mass_[n]);
  }

  const BodyType& body_;
  Policy policy_;
  [[no_unique_address]] Damping damping_;
  std::vector<Mat<Real, nodes>> mass_;  // of an element, between nodes: the same for every component
  Matrix matrix_;
  Field velocity_, acceleration_, start_, old_forces_, force_, trial_acceleration_, work_;
  [[no_unique_address]] StoredIf<with_contact, Field, BodyType> contact_mass_;  // by node: m_c, 0 off contact sides
  [[no_unique_address]] StoredIf<damped, Field, Policy> old_internal_;
  [[no_unique_address]] StoredIf<damped, Real, Matrix> dissipated_{};
  Real dt_ = 0;
};

/// Without inertia: the forces balance as they are.
struct NoInertiaForces {
  template <class Matrix>
  void connect(const Matrix&) {}
  static constexpr Real contact_share() { return 1; }
};

/// The inertia of a model; models that differ in friction or solver share it.
template <class Model>
using InertiaForces = std::conditional_t<
    has_inertia<Model>,
    InertiaForcesOf<Body<Model>, typename Model::TimeIntegration, DampingOf<Model>, has_contact<Model>>,
    NoInertiaForces>;

}  // namespace stickslip
