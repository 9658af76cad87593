// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/body.hpp>
#include <stickslip/assembly/contact_pair.hpp>
#include <stickslip/assembly/inertia.hpp>
#include <stickslip/assembly/prescribed.hpp>
#include <stickslip/assembly/rigid_motions.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace stickslip {

/// Wall time spent so far [s].
struct Timings {
  Real assembly = 0;       ///< body and scatter
  Real contact = 0;        ///< closest points, contact and friction
  Real factorization = 0;  ///< numeric and, once, symbolic
  Real solve = 0;          ///< forward and backward substitution
  Real estimates = 0;      ///< of the mesh's error
};

/// Adds the time of a scope to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(Real& counter) : counter_(counter), begin_(std::chrono::steady_clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { counter_ += std::chrono::duration<Real>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  Real& counter_;
  std::chrono::steady_clock::time_point begin_;
};

/// The discrete balance of a scene: residual and tangent as a function of the nodal displacements (theory.md, eq. 1.1).
/// Pattern, scatter maps and work space are made once, in the constructor.
template <class Model>
class System {
  static_assert(CheckModel<Model>::ok);

 public:
  using BodyType = Body<Model>;
  using Matrix = typename BodyType::Matrix;
  static constexpr int dim = Model::Kinematics::dim;
  static constexpr bool with_contact = has_contact<Model>;
  static constexpr bool with_passes = takes_passes<Model>();
  static constexpr bool with_lag = has_lag<Model>();
  using Pairs = Only<with_contact, ContactPairs<Model>, Matrix>;

  static constexpr bool with_inertia = has_inertia<Model>;
  using Inertia = Only<with_inertia, InertiaForces<Model>, Body<Model>>;
  static constexpr bool weighs_body = with_inertia && (with_contact || has_damping<Model>);

  System(BodyType& body, Pairs& pairs, Inertia& inertia, const std::vector<SideValue>& driven,
         const std::vector<SideValue>& loads)
      : body_(body), pairs_(pairs), inertia_(inertia), extent_(body.mesh().extent()) {
    const Index components = body.mesh().node_count() * dim;
    for (const SideValue& d : driven) prescribed_.drive(d, body.mesh().side(d.side).nodes);
    for (const SideValue& l : loads)
      prescribed_.load(l, body.mesh().side(l.side).nodes, nodal_areas(body.mesh(), body.kinematics(), l.side));
    dofs_ = prescribed_.unknowns_of(components);
    SparsityPattern pattern(dofs_, BodyType::storage);
    body.couple(pattern);
    matrix_.build(pattern);
    body.connect(dofs_, matrix_);
    if constexpr (with_contact) {
      std::size_t nodes = 0;
      for_each_contact(pairs, [&](auto& pair) {
        pair.connect(dofs_, matrix_);
        nodes += pair.nodes().size();
      });
      if constexpr (keeps_couplings<Model>) couplings_.reserve(nodes);
    }
    if constexpr (with_inertia) inertia.connect(matrix_);
    for (Field* f : {&internal_, &contact_, &external_, &balance_, &excess_}) f->setZero(components);
    residual_.setZero(dofs_.unknowns());
    open_ = residual_;
  }

  const Dofs& dofs() const { return dofs_; }
  SparseView matrix() const {
    SparseView view = matrix_.view();
    if constexpr (keeps_couplings<Model>) view.corrections = couplings_.view();
    return view;
  }
  /// Increases when the pattern changes and the solver must analyse again.
  Index pattern_revision() const { return pattern_revision_; }

  /// Sets the driven and held components of a nodal field to their values at `time`.
  Trouble impose(Real time, Field& u) const { return prescribed_.impose(time, u); }

  /// Evaluates residual and tangent at the displacements u, `time` and the increment dt that leads there.
  Trouble evaluate(const Field& u, Real time, Real dt) { return evaluate(u, time, dt, nullptr, nullptr); }

  /// The same within an iteration, at the variables of the stiff relations: the residual is the one to first order
  /// after their defects are closed (theory.md, eq. 6.7). With `driven`, also after those further increments of
  /// constrained components.
  Trouble iterate(const Field& u, Real time, Real dt, const Field* driven = nullptr) {
    excess_.setZero();
    if (const Trouble t = evaluate(u, time, dt, driven, &excess_)) return t;
    const Real share = end_share();
    dofs_.gather(excess_, open_);
    open_ = residual_ - share * open_;
    const Real imbalance = open_.norm();
    Real openness = body_.openness();
    if constexpr (weighs_body) openness *= std::pow(inertia_.body_share(), 2);
    if constexpr (with_contact) for_each_contact(pairs_, [&](const auto& pair) { openness += pair.openness(); });
    norm_ = std::max({norm_, imbalance, share * excess_.norm()});
    merit_ = std::hypot(imbalance, share * std::sqrt(openness));
    return {};
  }
  /// Begins an iteration at the converged state's values of the stiff relations.
  void begin_iteration() {
    body_.begin_iteration();
    if constexpr (with_contact) for_each_contact(pairs_, [](auto& pair) { pair.begin_iteration(); });
  }
  /// Makes the stiff relations' variables follow the change du of the displacements that a linear solution gave, and
  /// close their defects, or a share of them.
  void follow(const Field& du, Real closing = 1) {
    body_.follow(du, closing);
    if constexpr (with_contact) for_each_contact(pairs_, [&](auto& pair) { pair.follow(du, closing); });
  }
  /// Goes to a part of the changes of the last `follow`.
  void move(Real length) {
    body_.move(length);
    if constexpr (with_contact) for_each_contact(pairs_, [&](auto& pair) { pair.move(length); });
  }
  /// What a search along a linear solution must lower: the norm of the imbalance, open defects softened (eq. 6.9).
  Real merit() const { return merit_; }

  /// Gives the body the accelerations that balance the forces at the start of a run.
  Trouble start(const Field& u, Real time) requires with_inertia {
    if (const Trouble t = assemble(u, time, 0, nullptr, nullptr)) return t;
    smooth_ = internal_ - external_;
    inertia_.start(dofs_, smooth_, internal_);
    return {};
  }
  /// Local error of the time scheme in the step that the last evaluation converged in (theory.md, eq. 7.8) [length].
  Real local_error() requires with_inertia { return inertia_.local_error(dofs_, contact_); }

  /// Goes back to the converged state's multipliers and bounds, after passes that are given up.
  void begin_passes() requires(with_passes || with_lag) {
    for_each_contact(pairs_, [](auto& pair) {
      using Pair = std::remove_reference_t<decltype(pair)>;
      if constexpr (Pair::passes || Pair::lags) pair.begin_passes();
    });
  }
  /// Goes a smaller part of the way of the last `renew`; false when there is nothing left of it, or no bound to renew.
  bool hold_back() requires with_passes {
    bool held = false;
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (std::remove_reference_t<decltype(pair)>::iterates) held = pair.hold_back() || held;
    });
    return held;
  }
  /// Norm of the differences of the pressures and those that lagging bounds saw [force].
  Real bound_change() requires with_lag {
    Real square = 0;
    for_each_lag([&](auto& pair) { square += std::pow(pair.bound_change(), 2); });
    return std::sqrt(square);
  }
  /// The least feedback at which the lag of a pair no longer settles [-].
  Real stable_below() requires with_lag {
    Real least = std::numeric_limits<Real>::infinity();
    for_each_lag([&](auto& pair) { least = std::min(least, pair.stable_below()); });
    return least;
  }
  /// Makes lagging bounds see a share of the last `bound_change`; `begin_passes` takes that back.
  void probe(Real share) requires with_lag {
    for_each_lag([&](auto& pair) { pair.probe(share); });
  }
  /// Norm of what the pressures have changed by since the last `bound_change` [force].
  Real answer() requires with_lag {
    Real square = 0;
    for_each_lag([&](auto& pair) { square += pair.answer_squared(); });
    return std::sqrt(square);
  }
  /// Starts the next pass from where the last one ended.
  void renew() requires with_passes {
    for_each_pass([](auto& pair) { pair.renew(); });
  }
  /// How far the last pass was from what another one would give [-]; see ContactPair. It leads from the converged
  /// displacements `from` at the time `begin` to `to` at the time `end`.
  Real unsettled([[maybe_unused]] const Field& from, [[maybe_unused]] const Field& to, [[maybe_unused]] Real begin,
                 [[maybe_unused]] Real end) requires with_passes {
    Real largest = 0;
    for_each_pass([&](auto& pair) {
      if constexpr (with_inertia && is_augmented<typename Model::Enforcement>)
        largest = std::max(largest, pair.unsettled(pair.largest_motion(body_.mesh(), from, to, begin, end)));
      else
        largest = std::max(largest, pair.unsettled());
    });
    return largest;
  }
  /// Stiffens the enforcement by a factor, where it has multipliers: they settle sooner.
  void stiffen(Real factor) requires with_passes {
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (is_augmented<typename Model::Enforcement>) pair.stiffen(factor);
    });
  }

  /// Tells contacts whose penalties are in parts of the body's stiffness what that is, at the displacements u.
  Trouble measure(const Field& u) requires with_contact {
    bool needed = false;
    for_each_contact(pairs_, [&](const auto& pair) { needed = needed || pair.needs_stiffness(); });
    if (!needed) return {};
    internal_.setZero();
    matrix_.set_zero();
    if (const Trouble t = body_.assemble(u, 0, nullptr, internal_, nullptr, matrix_)) return t;
    for_each_contact(pairs_, [&](auto& pair) {
      if (pair.needs_stiffness()) pair.measure(dofs_, matrix_);
    });
    return {};
  }

  /// Residual of the unknowns in the last evaluation [force].
  const Field& residual() const { return residual_; }
  /// Its norm; within an iteration the largest of those with the stiff relations' defects closed and open and of the
  /// forces between the two, at supports as well (theory.md, eq. 6.2).
  Real residual_norm() const { return norm_; }
  /// What the residual is measured against: the largest of the norms of the internal, contact and external nodal
  /// forces, those at supports included (theory.md, eq. 6.2).
  Real force_scale() const { return std::max({internal_.norm(), contact_.norm(), external_.norm()}); }
  /// Largest coordinate of the body as it was [length].
  Real extent() const { return extent_; }
  /// Residual that round-off alone leaves: the largest stiffness times the extent of the coordinates (theory.md, eq.
  /// 6.2). Without it a body that only moves, free of stress, would never be in balance.
  Real roundoff(const Field& u) const {
    Real extent = u.lpNorm<Eigen::Infinity>();
    if constexpr (with_contact) extent += extent_;
    return 16 * std::numeric_limits<Real>::epsilon() * matrix_.largest() * extent * std::sqrt(Real(dofs_.unknowns()));
  }
  /// Force of a support on the body, by nodal component, inertia included; zero to the tolerance at free components.
  /// With generalised-alpha it is that of the balance, between the start and the end of the step.
  Real reaction(Index component) const {
    Real force = balance_[component];
    if constexpr (with_inertia &&
                  with_contact)  // a support takes contact's force itself, not its weight in the balance
      if (dofs_.equation(component) == Dofs::constrained) force -= (end_share() - 1) * contact_[component];
    return force;
  }
  /// Nodal forces of the last evaluation by component [force].
  const Field& internal() const { return internal_; }
  const Field& contact() const { return contact_; }
  const Field& external() const { return external_; }

  /// Adds the loads at a time to a nodal field.
  Trouble add_loads(Real time, Field& forces) const { return prescribed_.add_loads(time, forces); }

  /// What all contact pairs did in the last evaluation.
  ContactSummary contact_summary() const {
    ContactSummary sum;
    if constexpr (with_contact) for_each_contact(pairs_, [&](const auto& pair) { sum.merge(pair.summary()); });
    return sum;
  }

  /// Whether nothing resists some rigid-body motion at the displacements u: no support, and not the tangent of the last
  /// evaluation. With `moved`, whether besides that displacement has a part in it: what balance leaves open.
  bool moves_freely(const Field& u, const Field* moved = nullptr) const {
    const RigidMotions<typename Model::Kinematics> motions(body_.mesh().nodes, u);
    const Real stiffness = matrix_.largest();
    // Out of balance by R, a stressed body that turns resists by |R| / extent.
    const Real least = std::max(1e-11, moved ? 10 * norm_ / (stiffness * motions.extent()) : 0);
    const std::vector<Field> free = motions.unresisted(dofs_, matrix_.view(), stiffness, least);
    if (!moved) return !free.empty();
    Real share = 0;
    for (const Field& r : free) share = std::hypot(share, r.dot(*moved));
    return share > 1e-6 * moved->norm();
  }

  /// Whether a contact node has gone through its tool between the converged displacements `from` at the time `begin`
  /// and the last evaluation, `to` at the time `end`.
  Trouble passed_through(const Field& from, const Field& to, Real begin, Real end) requires with_contact {
    Trouble trouble;
    for_each_contact(pairs_, [&](auto& pair) {
      if (!trouble) trouble = pair.passed_through(body_.mesh(), from, to, begin, end);
    });
    return trouble;
  }

  /// Makes the state of the last evaluation, at the displacements u, the converged one.
  void commit([[maybe_unused]] const Field& u, [[maybe_unused]] Real time, [[maybe_unused]] Real dt) {
    if constexpr (with_inertia) {
      inertia_.commit(dofs_, u, internal_, contact_);
      if constexpr (with_contact)
        for_each_contact(pairs_, [&](const auto& pair) {
          pair.persist(body_.mesh(), dofs_, inertia_.start_of_step(), u, time - dt, time, inertia_.velocity_before(),
                       inertia_.contact_mass(), inertia_.velocity());
        });
    }
    commit();
  }
  /// The same of what has no velocity: the memory of points and contact nodes.
  void commit() {
    body_.commit();
    if constexpr (with_contact) for_each_contact(pairs_, [](auto& pair) { pair.commit(); });
  }

  Timings timings;

 private:
  Trouble evaluate(const Field& u, Real time, Real dt, const Field* driven, Field* excess) {
    if (const Trouble t = assemble(u, time, dt, driven, excess)) return t;
    if constexpr (with_inertia) {
      const Stopwatch watch(timings.assembly);
      smooth_ = internal_ - external_;
      inertia_.apply(u, smooth_, internal_, balance_, matrix_);
      if constexpr (keeps_couplings<Model>) couplings_.scale(end_share());
    }
    dofs_.gather(balance_, residual_);
    norm_ = residual_.norm();
    if (!std::isfinite(norm_)) return {Cause::not_finite, {}};
    return {};
  }

  template <class Visit>
  void for_each_pass(Visit&& visit) {
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (std::remove_reference_t<decltype(pair)>::passes) visit(pair);
    });
  }

  template <class Visit>
  void for_each_lag(Visit&& visit) {
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (std::remove_reference_t<decltype(pair)>::lags) visit(pair);
    });
  }

  // Weight of the forces at the end of a step in the balance; with inertia, of those that `balance_` has before it,
  // where those of the body are weighed already.
  Real end_share() const {
    if constexpr (with_inertia) return inertia_.contact_share();
    return 1;
  }

  // Internal, contact and external forces by component, their balance and its derivative; with inertia, what its
  // balance is made of (InertiaForces::apply).
  Trouble assemble(const Field& u, Real time, Real dt, const Field* driven, Field* excess) {
    internal_.setZero();
    matrix_.set_zero();
    {
      const Stopwatch watch(timings.assembly);
      if (const Trouble t = body_.assemble(u, dt, driven, internal_, excess, matrix_)) return t;
      if constexpr (weighs_body)
        if (dt > 0) {
          matrix_.scale(inertia_.body_share());
          if (excess) *excess *= inertia_.body_share();
        }
    }
    if constexpr (with_contact) {
      const Stopwatch watch(timings.contact);
      contact_.setZero();
      if constexpr (keeps_couplings<Model>) couplings_.clear();
      Trouble trouble;
      for_each_contact(pairs_, [&](auto& pair) {
        if (!trouble) trouble = pair.assemble(body_.mesh(), u, time, dt, driven, contact_, excess, matrix_, couplings_);
      });
      if (trouble) return trouble;
    }
    external_.setZero();
    if (const Trouble t = prescribed_.add_loads(time, external_)) return t;
    if constexpr (with_inertia)
      balance_ = contact_;
    else
      balance_ = internal_ + contact_ - external_;
    if (excess) balance_ += *excess;
    return {};
  }

  BodyType& body_;
  Pairs& pairs_;
  Inertia& inertia_;
  Dofs dofs_;
  Matrix matrix_;
  [[no_unique_address]] Only<keeps_couplings<Model>, NodeCouplings<dim>, System> couplings_;
  Prescribed prescribed_{dim};
  Field internal_, contact_, external_, balance_, residual_;
  Field excess_;  // forces that closing the stiff relations' defects adds, by component
  Field open_;    // the residual without them
  [[no_unique_address]] Only<with_inertia, Field, System> smooth_;
  Real norm_ = 0, merit_ = 0;
  Real extent_;  // largest reference coordinate
  Index pattern_revision_ = 1;
};

}  // namespace stickslip
