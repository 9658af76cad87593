// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/body/bodies.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <cmath>
#include <list>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace stickslip {

namespace detail {
template <template <class> class T, class Model>
struct Lazy {
  using type = T<Model>;
};
template <class T>
struct Constant {
  using type = T;
};
}  // namespace detail

/// The masses of a body's elements, between nodes: the same for every component.
template <class Body>
class ElementMasses {
 public:
  static constexpr int dim = Body::dim;
  static constexpr int nodes = Body::Element::nodes;

  ElementMasses(const Body& body, Real density, bool lumped) : body_(body) {
    const auto rule = Body::Element::Cell::quadrature();
    mass_.reserve(body.mesh().cells.size());
    for (Index e = 0; e < body.mesh().cell_count(); ++e) {
      Mat<Real, nodes> m = Mat<Real, nodes>::Zero();
      const auto X = body.coordinates(e);
      for (std::size_t p = 0; p < rule.size(); ++p) {
        const Vec<Real, nodes> N = Body::Element::Cell::shape(rule[p].xi);
        const Real volume = point_geometry<typename Body::Kinematics, typename Body::Element::Cell>(
                                body.kinematics(), X, rule[p].xi, rule[p].weight)
                                .weight;
        add(m, product_transposed(N, N), density * volume);
      }
      if (lumped)
        for (int a = 0; a < nodes; ++a)
          for (int b = 0; b < nodes; ++b)
            if (a != b) m(a, a) += std::exchange(m(a, b), 0.0);
      mass_.push_back(m);
    }
  }
  /// Lumps the rows of contact nodes (eq. 7.10): an impulse at one stays there. Adds to the nodes' own masses.
  void lump(const std::vector<bool>& touches, Field& contact_mass) {
    for (Index e = 0; e < body_.mesh().cell_count(); ++e) {
      Mat<Real, nodes>& m = mass_[static_cast<std::size_t>(e)];
      const auto touching = [&](int a) { return touches[static_cast<std::size_t>(node(e, a))]; };
      for (int a = 0; a < nodes; ++a) {
        if (!touching(a)) continue;
        for (int b = 0; b < nodes; ++b)
          if (a != b) {
            m(a, a) += std::exchange(m(a, b), 0.0);
            m(b, b) += std::exchange(m(b, a), 0.0);
          }
      }
      for (int a = 0; a < nodes; ++a)
        if (touching(a)) contact_mass[node(e, a)] += m(a, a);
    }
  }
  /// Adds them to a matrix in the pattern of the system's.
  template <class Matrix>
  void add_to(Matrix& matrix) const {
    Mat<Real, nodes * dim> block;
    for (Index e = 0; e < body_.mesh().cell_count(); ++e) {
      block.setZero();
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b)
          for (int i = 0; i < dim; ++i) block(a * dim + i, b * dim + i) = mass_[static_cast<std::size_t>(e)](a, b);
      matrix.add(body_.slots(e), block);
    }
  }
  /// target += M field.
  void add_product(const Field& field, Field& target) const {
    for (Index e = 0; e < body_.mesh().cell_count(); ++e) {
      const Mat<Real, nodes>& m = mass_[static_cast<std::size_t>(e)];
      for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < nodes; ++b)
          for (int i = 0; i < dim; ++i) target[node(e, a) * dim + i] += m(a, b) * field[node(e, b) * dim + i];
    }
  }

 private:
  Index node(Index e, int a) const {
    return body_.first_node() + body_.mesh().cells[static_cast<std::size_t>(e)][static_cast<std::size_t>(a)];
  }
  const Body& body_;
  std::vector<Mat<Real, nodes>> mass_;
};

namespace detail {
template <class Model, class List>
struct MassLists;
template <class Model, class... Types>
struct MassLists<Model, BodyTypes<Types...>> {
  using type = std::tuple<std::list<ElementMasses<BodyOfType<Model, Types>>>...>;
};
}  // namespace detail

/// Mass, velocity and acceleration of the bodies, their damping, and the weights of its time scheme (theory.md, section
/// 7). Exists only in models with inertia. Forces are of two kinds: smooth ones, of the body and of loads, which are
/// averaged over a step and make the acceleration; and those of contact, which are impulses at its end and stay out of
/// it (eq. 7.11, 7.12).
template <class Model>
class InertiaTerm {
 public:
  using Matrix = typename Bodies<Model>::Matrix;
  using Policy = typename Model::TimeIntegration;
  using Damping = DampingOf<Model>;
  static constexpr int dim = Model::Kinematics::dim;
  static constexpr bool with_contact = has_contact<Model>, damped = Damping::active;
  /// Whether the matrix of the bodies has a weight of its own.
  static constexpr bool weighs_body = with_contact || damped;

  /// `touches` says of every node whether it is one of a contact side; `components` is the length of fields.
  InertiaTerm(const Bodies<Model>& bodies, const Policy& policy, const Damping& damping,
              const std::vector<bool>& touches, Index components)
      : policy_(policy), damping_(damping) {
    if constexpr (with_contact) contact_mass_.setZero(bodies.node_count());
    std::size_t k = 0;
    bodies.for_each([&](const auto& body) {
      auto& list = std::get<std::list<ElementMasses<std::remove_cvref_t<decltype(body)>>>>(masses_);
      list.emplace_back(body, bodies.density(k++), policy.lumped);
      if constexpr (with_contact) list.back().lump(touches, contact_mass_);
    });
    for (Field* f : {&velocity_, &acceleration_, &start_, &old_forces_, &force_, &trial_acceleration_, &work_})
      f->setZero(components);
    if constexpr (damped) old_internal_.setZero(components);
  }

  /// Makes the mass matrix in the pattern of the system's.
  void connect(const Matrix& matrix) {
    matrix_ = matrix;
    matrix_.set_zero();
    for_each_mass([&](const auto& masses) { masses.add_to(matrix_); });
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
      acceleration_[c] = dofs.supported(c) || !(lumped[c] > 0) ? 0 : -old_forces_[c] / lumped[c];
  }

  /// target += M field.
  void add_product(const Field& field, Field& target) const {
    for_each_mass([&](const auto& masses) { masses.add_product(field, target); });
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
    for (Index n = 0; n < work_.size() / dim; ++n) largest = std::max(largest, at_node<dim>(work_, n).norm());
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
  template <class Visit>
  void for_each_mass(Visit&& visit) const {
    std::apply([&](const auto&... lists) { (visit_list(lists, visit), ...); }, masses_);
  }
  template <class List, class Visit>
  static void visit_list(const List& list, Visit& visit) {
    for (const auto& masses : list) visit(masses);
  }
  // Calls visit(component, c) for the free components of contact nodes, c = force / mass of the node.
  template <class Visit>
  void for_each_impulse(const IndexMap& dofs, const Field& contact, Visit&& visit) const requires with_contact {
    for (Index n = 0; n < contact_mass_.size(); ++n)
      if (contact_mass_[n] > 0)
        for (Index k = n * dim; k < (n + 1) * dim; ++k)
          if (contact[k] != 0 && dofs.equation(k) != IndexMap::constrained) visit(k, contact[k] / contact_mass_[n]);
  }

  typename detail::MassLists<Model, BodyTypesOf<Model>>::type masses_;
  Policy policy_;
  [[no_unique_address]] Damping damping_;
  Matrix matrix_;
  Field velocity_, acceleration_, start_, old_forces_, force_, trial_acceleration_, work_;
  [[no_unique_address]] StoredIf<with_contact, Field, Bodies<Model>>
      contact_mass_;  // by node: m_c, 0 off contact sides
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

/// The inertia of a model.
template <class Model>
using InertiaForces = typename std::conditional_t<has_inertia<Model>, detail::Lazy<InertiaTerm, Model>,
                                                  detail::Constant<NoInertiaForces>>::type;

}  // namespace stickslip
