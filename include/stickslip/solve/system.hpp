// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/vector_space.hpp>
#include <stickslip/body/bodies.hpp>
#include <stickslip/body/inertia_forces.hpp>
#include <stickslip/contact/contact_pair.hpp>
#include <stickslip/dofs/linear_constraint.hpp>
#include <stickslip/dofs/prescribed.hpp>
#include <stickslip/dofs/term.hpp>
#include <stickslip/solve/timings.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <vector>

namespace stickslip {

/// Nodal forces of an evaluation, by component [force].
struct NodalForces {
  Field internal, contact, external;
  Field balance;   ///< their sum, inertia included: what does not balance
  Field residual;  ///< the balance of the unknowns
  Real norm = 0;   ///< of the residual; within an iteration see System::Iterate::evaluate
  /// Of the last commit: force of a support on the body, inertia included; zero to the tolerance at free components.
  /// With generalised-alpha it is that of the balance, between the start and the end of the step.
  Field reaction;

  /// What the residual is measured against: the largest of the norms of the internal, contact and external forces,
  /// those at supports included (theory.md, eq. 6.2).
  template <VectorSpace Space>
  Real scale(const Space& space) const {
    return std::max({space.norm(internal), space.norm(contact), space.norm(external)});
  }
};

/// A linear constraint between components: u_dependent = sum of weight * u_master + offset(time).
struct LinearConstraint {
  IndexMap::Dependent dependent;
  std::function<Real(Real)> offset{};  ///< [length]; none: zero
};

namespace detail {
// What of a system depends on no model: the unknowns, supports and loads, and the sums of the forces by component.
class Balance {
 protected:
  template <class BodiesType>
  [[gnu::cold]] Balance(const BodiesType& bodies, const std::vector<SideValue>& driven,
                        const std::vector<SideValue>& loads, const std::vector<LinearConstraint>& constraints,
                        Index components)
      : prescribed_(BodiesType::dim, bodies.extent()) {
    for (const SideValue& d : driven) prescribed_.drive(d, bodies.side_nodes(d.side));
    for (const SideValue& l : loads) prescribed_.load(l, bodies.side_nodes(l.side), bodies.side_areas(l.side));
    number(constraints, components);
  }

  // The numbering in which forces and stiffness are assembled: that of the unknowns, unless linear constraints are
  // condensed.
  bool condenses() const { return !dofs_.dependents().empty(); }
  const IndexMap& assembled() const { return condenses() ? assembled_ : dofs_; }

  // The balance of the contact forces, or, without inertia, of all forces at `time`.
  Failure sum_up(Real time, bool with_inertia, const Field* constraint_force) {
    forces_.external.setZero();
    if (const Failure f = prescribed_.add_loads(time, forces_.external)) return f;
    if (with_inertia)
      forces_.balance = forces_.contact;
    else
      forces_.balance = forces_.internal + forces_.contact - forces_.external;
    if (constraint_force) forces_.balance += *constraint_force;
    return {};
  }
  // The residual and its norm.
  Failure take_residual() {
    dofs_.gather(forces_.balance, forces_.residual);
    forces_.norm = space_.norm(forces_.residual);
    return std::isfinite(forces_.norm) ? Failure{} : Failure{FailureCause::not_finite, {}};
  }
  // The merit of an iterate (theory.md, eq. 6.13), with the `share` of the constraint forces in the residual.
  Real take_merit(Real share, Real constraints) {
    dofs_.gather(constraint_force_, open_);
    open_ = forces_.residual - share * open_;
    const Real imbalance = space_.norm(open_);
    forces_.norm = std::max({forces_.norm, imbalance, share * space_.norm(constraint_force_)});
    return std::hypot(imbalance, share * std::sqrt(space_.sum(constraints)));
  }
  // The reactions of the state that is committed; a support takes the force of contact itself.
  void take_reactions(Real contact_share) {
    forces_.reaction = forces_.balance;
    if (const Real share = contact_share - 1; share != 0)
      for (Index c = 0; c < dofs_.components(); ++c)
        if (dofs_.supported(c)) forces_.reaction[c] -= share * forces_.contact[c];
  }

  [[no_unique_address]] SerialSpace space_{};
  IndexMap dofs_;
  IndexMap assembled_;  // with linear constraints
  Prescribed prescribed_;
  NodalForces forces_;
  Field constraint_force_;  // that closing the condensed unknowns' constraints adds, by component
  Field open_;              // the residual without it

 private:
  [[gnu::cold]] void number(const std::vector<LinearConstraint>& constraints, Index components) {
    for (const auto& [dependent, offset] : constraints) prescribed_.constrain(dependent, offset);
    dofs_ = prescribed_.unknowns_of(components);
    if (condenses()) assembled_ = prescribed_.unknowns_of(components, true);
    for (Field* f : {&forces_.internal, &forces_.contact, &forces_.external, &forces_.balance, &forces_.reaction,
                     &constraint_force_})
      f->setZero(components);
    forces_.residual.setZero(dofs_.unknowns());
    open_ = forces_.residual;
  }
};
}  // namespace detail

/// The matrix of a system.
struct SystemTangent {
  SparseView stored;  ///< as it stands: its pattern, and the tangent of the last evaluation that was asked for one
  bool current;       ///< whether that is the tangent of the last evaluation
  Index revision;     ///< another one when the pattern has changed and the solver must analyse again

  /// The tangent of the last evaluation; it must have one.
  const SparseView& view() const {
    assert(current &&
           "System::tangent needs an evaluation with Want::tangent, or Iterate::add_tangent, as the last one");
    return stored;
  }
};

/// The discrete balance of a scene: residual and tangent as a function of the nodal displacements (theory.md, eq. 1.1),
/// the sum of its terms: bodies, contact pairs and inertia. What a model does not have is an empty term.
template <class Model>
class System : detail::Balance {
  static_assert(CheckModel<Model>::ok);

 public:
  using BodiesType = Bodies<Model>;
  using Matrix = typename BodiesType::Matrix;
  using Pairs = StoredIf<has_contact<Model>, ContactPairs<Model>, Matrix>;
  using Inertia = InertiaForces<Model>;
  using Space = SerialSpace;
  static constexpr int dim = Model::Kinematics::dim;
  static constexpr bool weighs_body = has_inertia<Model> && (has_contact<Model> || has_damping<Model>);
  class Iterate;

  /// `revision` tells systems of one scene apart, for those who keep what they made of its pattern.
  System(BodiesType& bodies, Pairs& pairs, Inertia& inertia, const std::vector<SideValue>& driven,
         const std::vector<SideValue>& loads, Index revision = 1, TermsOf<Model>* terms = nullptr,
         const std::vector<LinearConstraint>& constraints = {})
      : Balance(bodies, driven, loads, constraints, components_of(bodies, terms)),
        bodies_(bodies),
        pairs_(pairs),
        inertia_(inertia),
        terms_(terms),
        pattern_revision_(revision) {
    if (stores_couplings<Model> && condenses())
      throw std::invalid_argument(
          "linear constraint: a solver that corrects a symmetric factor for sliding nodes takes none; take a general "
          "solver");
    if constexpr (has_contact<Model>) {
      closing_.force.setZero(dofs_.components());
      closing_.right_hand_side.setZero(dofs_.unknowns());
    }
    connect();
  }

  const IndexMap& dofs() const { return dofs_; }
  /// Takes the norms and products of vectors by component or unknown, for all who solve for them.
  const Space& space() const { return space_; }
  /// The matrix, and what is known of it.
  SystemTangent tangent() const {
    if (condenses()) return {condensed_.view(), has_tangent_, pattern_revision_};
    SparseView view = matrix_.view();
    view.corrections = couplings_.view();
    return {view, has_tangent_, pattern_revision_};
  }
  /// Supports and loads.
  const Prescribed& prescribed() const { return prescribed_; }
  BodiesType& bodies() { return bodies_; }
  Pairs& pairs() { return pairs_; }
  const Pairs& pairs() const { return pairs_; }

  /// Prepares an attempt at a step from the converged displacements u at `time`, which is guessed to end at `guess`:
  /// where a term's stencils have changed, the pattern is made anew.
  void update(const Field& u, Real time, const Field& guess) {
    const Stopwatch watch(timings.update);
    bool changed = false;
    for_each_term([&](auto& term) { changed = term.update(u, time) || changed; });
    for_each_contact(pairs_, [&](auto& pair) { changed = pair.update(u, guess) || changed; });
    if (!changed) return;
    ++pattern_revision_;
    connect();
  }
  void update(const Field& u, Real time) { update(u, time, u); }
  /// Takes the displacements u at `time` for a start: positions on the tools, penalties in parts of the body's
  /// stiffness, and accelerations that balance the forces. Throws std::invalid_argument where contacts cannot start.
  Failure start(const Field& u, Real time) {
    for_each_contact(pairs_, [&](auto& pair) { pair.start(u, time); });
    update(u, time);
    if (const Failure f = compute_penalties(u, false)) return f;
    if constexpr (has_inertia<Model>) {
      if (const Failure f = assemble({u, time, 0, Want::tangent, nullptr, false, nullptr, matrix_, couplings_}))
        return f;
      inertia_.start(dofs_, forces_.internal, forces_.external);
    }
    return {};
  }
  /// Evaluates the residual, and the tangent where it is wanted, at the displacements u, `time` and the increment dt
  /// that leads there. Within an iteration, use the Iterate instead.
  Failure evaluate(const Field& u, Real time, Real dt, Want want = Want::tangent) {
    plain_ = true;
    return evaluate({u, time, dt, want, nullptr, false, nullptr, matrix_, couplings_});
  }
  /// Those of the last evaluation.
  const NodalForces& forces() const { return forces_; }
  /// What the tangent's solution is of: the residual, with what closing stiff contact takes beyond the constraint
  /// forces (theory.md, eq. 6.22).
  const Field& right_hand_side() const {
    if constexpr (has_contact<Model>)
      if (closing_.any) return closing_.right_hand_side;
    return forces_.residual;
  }
  /// Whether there is such contact in the last evaluation: then its pressures have more digits than the gaps.
  bool closes_stiff_contact() const {
    if constexpr (has_contact<Model>) return closing_.any;
    return false;
  }
  /// Bound of the residual that round-off alone leaves: the largest stiffness of the body and of sticking times the
  /// extent of the coordinates (theory.md, eq. 6.3).
  Real roundoff(const Field& u) const {
    const Real moved = space_.max(u.head(bodies_.node_count() * dim).template lpNorm<Eigen::Infinity>()),
               extent = bodies_.extent();
    Real force = (stiffness_ + inertia_stiffness_) * (exact_strains && !has_contact<Model> ? moved : moved + extent);
    Real sticking = 0;
    for_each_contact(pairs_, [&](const auto& pair) { sticking = std::max(sticking, pair.largest_sticking()); });
    force += space_.max(sticking) * (moved + extent);
    return 16 * std::numeric_limits<Real>::epsilon() * force * std::sqrt(space_.sum(Real(dofs_.unknowns())));
  }

  /// Largest entry of the body's tangent at the displacements u [force / length]; 0 where it has none. Spoils the last
  /// evaluation.
  Real body_stiffness(const Field& u) { return evaluate_body(u) ? 0 : matrix_.largest(); }

  /// Makes the state of the last evaluation, at the displacements u, the converged one.
  void commit([[maybe_unused]] const Field& u, [[maybe_unused]] Real time, [[maybe_unused]] Real dt) {
    if constexpr (has_inertia<Model>) {
      inertia_.commit(dofs_, u, forces_.internal, forces_.contact);
      if constexpr (has_contact<Model>)
        for_each_contact(pairs_, [&](const auto& pair) {
          pair.persist_velocities(dofs_, inertia_.start_of_step(), u, time - dt, time, inertia_.velocity_before(),
                                  inertia_.contact_mass(), inertia_.velocity());
        });
    }
    commit();
  }
  /// The same of what has no velocity: the memory of points and contact nodes.
  void commit() {
    assert(evaluated_ && "System::commit needs a System::evaluate without failure since the last commit");
    evaluated_ = false;
    take_reactions(inertia_.contact_share());
    bodies_.commit();
    for_each_term([](auto& term) { term.commit(); });
    for_each_contact(pairs_, [](auto& pair) { pair.commit(); });
  }

  Timings timings;

 private:
  // Makes the pattern, and the terms' maps into it.
  [[gnu::cold]] void connect() {
    const IndexMap& dofs = assembled();
    SparsityPattern pattern(dofs, matrix_storage<Model>);
    bodies_.couple(pattern);
    for_each_term([&](const auto& term) { term.couple(pattern); });
    for_each_contact(pairs_, [&](const auto& pair) { pair.couple(pattern); });
    matrix_ = Matrix(pattern);
    bodies_.connect(dofs, matrix_);
    std::size_t nodes = 0, entries = 0;
    for_each_contact(pairs_, [&](auto& pair) {
      pair.connect(dofs, matrix_);
      nodes += pair.nodes().size();
      entries += pair.coupling_entries();
    });
    couplings_.reserve(nodes, entries);
    inertia_.connect(matrix_);
    if (condenses()) condensed_.build(matrix_.view(), dofs, dofs_);
  }
  static Index components_of(const BodiesType& bodies, [[maybe_unused]] const TermsOf<Model>* terms) {
    Index components = bodies.node_count() * dim;
    if constexpr (std::tuple_size_v < TermsOf < Model >>> 0)
      std::apply([&](const auto&... term) { ((components += term.unknowns()), ...); }, *terms);
    return components;
  }
  template <class Visit>
  void for_each_term(Visit&& visit) const {
    if constexpr (std::tuple_size_v < TermsOf < Model >>> 0)
      std::apply([&](auto&... terms) { (visit(terms), ...); }, *terms_);
  }
  using Couplings = std::conditional_t<stores_couplings<Model>, NodeCouplings, NoNodeCouplings>;
  using EvaluationType = Evaluation<Matrix, Couplings>;

  // Tells contacts whose penalties are in parts of the body's stiffness what that is at the displacements u; if `all`
  // is false, those that know one already as well.
  Failure compute_penalties(const Field& u, bool missing_only) {
    bool needed = false;
    const auto needs = [&](const auto& pair) {
      return missing_only ? pair.needs_stiffness() : pair.in_parts_of_stiffness();
    };
    for_each_contact(pairs_, [&](const auto& pair) { needed = needed || needs(pair); });
    if (!needed) return {};
    if (const Failure f = evaluate_body(u)) return f;
    for_each_contact(pairs_, [&](auto& pair) {
      if (needs(pair)) pair.compute_penalties(assembled(), matrix_);
    });
    return {};
  }

  Failure evaluate_body(const Field& u) {
    has_tangent_ = evaluated_ = false;
    forces_.internal.setZero();
    matrix_.set_zero();
    return bodies_.evaluate(EvaluationType{u, 0, 0, Want::tangent, nullptr, false, nullptr, matrix_, couplings_},
                            forces_.internal);
  }
  Failure evaluate(const EvaluationType& ev) {
    if (const Failure f = compute_penalties(ev.u, true)) return f;
    has_tangent_ = evaluated_ = false;
    if constexpr (has_contact<Model>) closing_.any = false;
    for_each_contact(pairs_, [](auto& pair) { pair.discard_trial(); });
    if (const Failure f = assemble(ev)) return f;
    if constexpr (has_inertia<Model>) {
      const Stopwatch watch(timings.assembly);
      inertia_.apply(ev.u, forces_.internal, forces_.external, forces_.balance,
                     ev.want == Want::residual ? nullptr : &matrix_);
      couplings_.scale(inertia_.contact_share());
    }
    if (const Failure f = take_residual()) return f;
    if (ev.want != Want::residual && condenses()) condensed_.condense(matrix_.view());
    has_tangent_ = ev.want != Want::residual;
    evaluated_ = true;
    return {};
  }

  // Internal, contact and external forces by component, their balance and its derivative; with inertia, what its
  // balance is made of (InertiaForces::apply).
  Failure assemble(const EvaluationType& ev) {
    const bool with_tangent = ev.want != Want::residual;
    forces_.internal.setZero();
    forces_.contact.setZero();
    if (with_tangent) {
      matrix_.set_zero();
      couplings_.clear();
    }
    {
      const Stopwatch watch(timings.assembly);
      if (const Failure f = bodies_.evaluate(ev, forces_.internal)) return f;
      if (with_tangent && !measured_) measure_stiffness();
      Failure failure;
      for_each_term([&](auto& term) {
        if (!failure) failure = term.evaluate(ev, assembled(), forces_.internal);
      });
      if (failure) return failure;
      if constexpr (weighs_body)
        if (ev.dt > 0) {
          if (with_tangent) matrix_.scale(inertia_.body_share());
          if (ev.constraint_force) *ev.constraint_force *= inertia_.body_share();
        }
    }
    {
      const Stopwatch watch(timings.contact);
      Failure failure;
      if (with_tangent && ev.constraint_force) for_each_contact(pairs_, [&](auto& pair) { pair.measure_body(ev); });
      for_each_contact(pairs_, [&](auto& pair) {
        if (!failure) failure = pair.evaluate(ev, forces_.contact);
      });
      if (failure) return failure;
    }
    return sum_up(ev.time, has_inertia<Model>, ev.constraint_force);
  }
  void close_stiff_contact() requires has_contact<Model> {
    for_each_contact(pairs_, [&](const auto& pair) { closing_.any = closing_.any || pair.relaxed(); });
    if (!closing_.any) return;
    closing_.force.setZero();
    for_each_contact(pairs_, [&](const auto& pair) { pair.add_closing_forces(closing_.force); });
    dofs_.gather(closing_.force, closing_.right_hand_side);
    closing_.right_hand_side = forces_.residual + inertia_.contact_share() * closing_.right_hand_side;
  }
  // The stiffnesses that round-off meets, once an iteration.
  void measure_stiffness() {
    measured_ = true;
    stiffness_ = space_.max(matrix_.largest());
  }
  template <class... Types>
  static constexpr bool take_deformation(BodyTypes<Types...>) {
    return (takes_deformation<typename Types::Material, typename Model::Kinematics::TensorPattern> && ...);
  }
  static constexpr bool exact_strains = take_deformation(BodyTypesOf<Model>{});

  BodiesType& bodies_;
  Pairs& pairs_;
  Inertia& inertia_;
  TermsOf<Model>* terms_;  // null where there are none
  Matrix matrix_;
  CondensedMatrix<matrix_storage<Model>> condensed_;
  [[no_unique_address]] Couplings couplings_;
  Real stiffness_ = 0, inertia_stiffness_ = 0;  // of the body and of its inertia [force / length]
  bool measured_ = false;                       // whether they are those of this iteration
  struct Closing {
    Field force{}, right_hand_side{};
    bool any = false;  // in the last evaluation
  };
  [[no_unique_address]] StoredIf<has_contact<Model>, Closing, System> closing_{};  // of stiff contact, in an iteration
  bool has_tangent_ = false, evaluated_ = false;
  bool plain_ = false;  // the condensed unknowns were overwritten by an evaluation outside the iteration
  Index pattern_revision_;
};

/// An iterate of Newton's method: the condensed unknowns have values of their own beside the displacements. It begins
/// at the converged state; unless it is accepted, multipliers and slip bounds go back to that with it.
template <class Model>
class System<Model>::Iterate {
 public:
  explicit Iterate(System& system) : system_(system) { restart(); }
  Iterate(const Iterate&) = delete;
  Iterate& operator=(const Iterate&) = delete;
  ~Iterate() {
    if (!accepted_) for_each_contact(system_.pairs_, [](auto& pair) { pair.reset_augmentations(); });
  }
  /// Begins again at the converged state's values of the condensed unknowns.
  void restart() {
    system_.measured_ = system_.plain_ = false;
    system_.inertia_stiffness_ = 0;
    system_.bodies_.begin_iteration();
    system_.for_each_term([](auto& term) { term.begin_iteration(); });
    for_each_contact(system_.pairs_, [](auto& pair) { pair.begin_iteration(); });
  }
  /// The same, with nodes linearised as sticking that the last try has lost; with all of them where `sticking`.
  void retry(bool sticking) {
    restart();
    for_each_friction(system_.pairs_, [&](auto& pair) { pair.retry(sticking); });
  }
  System& system() { return system_; }
  /// Adds `share` of the last converged increment to the bodies' condensed unknowns. Inertia keeps their paths smooth.
  void extrapolate(Real share) { system_.bodies_.extrapolate(share, has_inertia<Model>); }

  /// Evaluates the system at the displacements u and the condensed unknowns: the residual is the one to first order
  /// after their constraints are closed (theory.md, eq. 6.11), its norm the largest of those with the constraints
  /// closed and open and of the forces between the two, at supports as well (theory.md, eq. 6.2). With `driven`, also
  /// after those further increments of constrained components.
  Failure evaluate(const Field& u, Real time, Real dt, Want want = Want::tangent, const Field* driven = nullptr) {
    return evaluate(u, time, dt, want, driven, false);
  }
  /// Evaluates the same iterate again, to have its tangent as well.
  Failure add_tangent(const Field& u, Real time, Real dt) {
    return evaluate(u, time, dt, Want::tangent, nullptr, true);
  }
  /// What a search along a linear solution must lower: the norm of the imbalance, with the constraint forces weighted
  /// (theory.md, eq. 6.13).
  Real merit() const { return merit_; }
  /// Predicts the condensed unknowns after the change du of the displacements, with a fraction of their constraint
  /// residuals closed.
  void predict(const Field& du, Real fraction = 1) {
    system_.bodies_.predict(du, fraction);
    system_.for_each_term([&](auto& term) { term.predict(du, fraction); });
    for_each_contact(system_.pairs_, [&](auto& pair) { pair.predict(du, fraction); });
  }
  /// Takes a part of the change of the last `predict`.
  void set_step(Real length) {
    system_.bodies_.set_step(length);
    system_.for_each_term([&](auto& term) { term.set_step(length); });
    for_each_contact(system_.pairs_, [&](auto& pair) { pair.set_step(length); });
  }
  /// Keeps the multipliers and bounds that were reached; the state is to be committed.
  void accept() { accepted_ = true; }

 private:
  Failure evaluate(const Field& u, Real time, Real dt, Want want, const Field* driven, bool again) {
    assert(!system_.plain_ && "Iterate::evaluate needs Iterate::restart after a System::evaluate within the iteration");
    System& s = system_;
    s.constraint_force_.setZero();
    if constexpr (has_inertia<Model>)
      if (!(s.inertia_stiffness_ > 0)) s.inertia_stiffness_ = s.inertia_.stiffness();
    if (const Failure f = s.evaluate({u, time, dt, want, driven, again, &s.constraint_force_, s.matrix_, s.couplings_,
                                      s.inertia_stiffness_ / s.inertia_.contact_share()}))
      return f;
    if constexpr (has_contact<Model>) s.close_stiff_contact();
    Real constraints = s.bodies_.constraint_merit();
    s.for_each_term([&](const auto& term) { constraints += term.constraint_merit(); });
    if constexpr (weighs_body) constraints *= std::pow(s.inertia_.body_share(), 2);
    for_each_contact(s.pairs_, [&](const auto& pair) { constraints += pair.constraint_merit(); });
    merit_ = s.take_merit(s.inertia_.contact_share(), constraints);
    return {};
  }

  System& system_;
  Real merit_ = 0;
  bool accepted_ = false;
};

}  // namespace stickslip
