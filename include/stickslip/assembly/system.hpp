// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/body.hpp>
#include <stickslip/assembly/contact_pair.hpp>
#include <stickslip/assembly/inertia.hpp>
#include <stickslip/assembly/prescribed.hpp>
#include <stickslip/assembly/rigid_motions.hpp>
#include <stickslip/base/figure.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
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
    const Real share = static_share();
    dofs_.gather(excess_, open_);
    open_ = residual_ - share * open_;
    const Real imbalance = open_.norm();
    Real openness = body_.openness();
    if constexpr (with_contact) for_each_contact(pairs_, [&](const auto& pair) { openness += pair.openness(); });
    norm_ = std::max({norm_, imbalance, share * excess_.norm()});
    merit_ = std::hypot(imbalance, share * std::sqrt(openness));
    return {};
  }
  /// Begins an iteration at the converged state's values of the stiff relations.
  void begin_iteration() {
    measured_ = false;
    if constexpr (with_inertia) with_mass_ = false;
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
    inertia_.start(dofs_, balance_);
    return {};
  }

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
  /// How far the last pass was from what another one would give [-]; see ContactPair.
  Real unsettled() requires with_passes {
    Real largest = 0;
    for_each_pass([&](auto& pair) { largest = std::max(largest, pair.unsettled()); });
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
  /// Bound of the residual that round-off alone leaves: the largest stiffness of the body and of sticking times the
  /// extent of the coordinates (theory.md, eq. 6.2a).
  Real roundoff(const Field& u) const {
    const Real moved = u.lpNorm<Eigen::Infinity>();
    Real force = stiffness_ * (exact_strains && !with_contact ? moved : moved + extent_);
    if constexpr (with_contact) force += sticking_ * (moved + extent_);
    return 16 * std::numeric_limits<Real>::epsilon() * force * std::sqrt(Real(dofs_.unknowns()));
  }
  /// Whether all forces of the last evaluation are below that bound, and supports alone act on the body: it only moves,
  /// free of stress, and would never be in balance but for its round-off.
  bool only_moves(Real roundoff) const {
    if constexpr (with_contact)
      if (contact_summary().touching > 0) return false;
    return external_.isZero(0) && internal_.norm() <= roundoff;
  }
  /// What the round-off of the gaps makes of the pressures, at the stiffness of the penalty or the body, whichever is
  /// softer (theory.md, eq. 6.2d) [force].
  Real blurred() const {
    Real square = 0;
    if constexpr (with_contact) {
      Real share = 1;  // of the stiffness that a body shows whose volume may go aside
      if constexpr (requires { body_.material().poisson; })
        share = (1 - 2 * body_.material().poisson) / (1 - body_.material().poisson);
      for_each_contact(pairs_, [&](const auto& pair) { square += pair.blurred(share); });
    }
    return std::sqrt(square);
  }
  /// What of the scene makes round-off of the forces, in words: a stiffness more than `worst` times another one, if
  /// there is any; with `by_gaps` else the coordinates, to whose round-off the body answers. Spoils the last
  /// evaluation.
  std::string blame(const Field& u, bool by_gaps, Real worst) {
    std::string words;
    const auto accuse = [&](Real ratio, const std::string& text) {
      if (!(ratio > worst)) return;
      worst = ratio;
      words = text;
    };
    if constexpr (requires { body_.material().poisson; }) {
      const Real poisson = body_.material().poisson;
      const Real ratio = 2 * (1 + poisson) / (3 * (1 - 2 * poisson));
      accuse(ratio, "the bulk modulus is " + figure(ratio) + " times the shear modulus, at a Poisson's ratio " +
                        figure(0.5 - poisson) + " below 0.5");
    }
    if (by_gaps) {
      if (!words.empty()) return words;
      const Real reach = extent_ + u.lpNorm<Eigen::Infinity>();
      const RigidMotions<typename Model::Kinematics> motions(body_.mesh().nodes, u);
      return "coordinates of up to " + figure(reach) + ", of a body that measures " + figure(motions.extent()) +
             " from its centre, give gaps to no better than " + figure(std::numeric_limits<Real>::epsilon() * reach);
    }
    if constexpr (with_contact) {
      internal_.setZero();
      matrix_.set_zero();
      if (!body_.assemble(u, 0, nullptr, internal_, nullptr, matrix_))
        for_each_contact(pairs_, [&](const auto& pair) {
          const Real ratio = pair.stiffest() / matrix_.largest();
          accuse(ratio,
                 "the penalty of contact \"" + pair.name() + "\" is " + figure(ratio) + " times the body's stiffness");
        });
    }
    return words;
  }
  /// Force of a support on the body, by nodal component, inertia included; zero to the tolerance at free components.
  /// With generalised-alpha it is that of the balance, between the start and the end of the step.
  Real reaction(Index component) const { return balance_[component]; }
  /// Nodal forces of the last evaluation by component [force].
  const Field& internal() const { return internal_; }
  const Field& contact() const { return contact_; }
  const Field& external() const { return external_; }

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

  /// Makes the state of the last evaluation the converged one.
  void commit() {
    if constexpr (with_inertia) inertia_.commit();
    body_.commit();
    if constexpr (with_contact) for_each_contact(pairs_, [](auto& pair) { pair.commit(); });
  }

  Timings timings;

 private:
  Trouble evaluate(const Field& u, Real time, Real dt, const Field* driven, Field* excess) {
    if (const Trouble t = assemble(u, time, dt, driven, excess)) return t;
    if constexpr (with_inertia) {
      const Stopwatch watch(timings.assembly);
      static_force_ = balance_;
      inertia_.apply(u, static_force_, balance_, matrix_);
      if (!with_mass_) stiffness_ += inertia_.stiffness();
      with_mass_ = true;
      if constexpr (keeps_couplings<Model>) couplings_.scale(static_share());
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

  // The stiffnesses that round-off meets, once an iteration.
  void measure_stiffness() {
    measured_ = true;
    stiffness_ = matrix_.largest();
    sticking_ = 0;
    if constexpr (with_contact)
      for_each_contact(pairs_, [&](const auto& pair) { sticking_ = std::max(sticking_, pair.stickiest()); });
  }
  // Whether the material takes strains with all their digits.
  static constexpr bool exact_strains =
      requires(const typename Model::Material& material, const Deformation<Real, typename BodyType::Shape>& deformation,
               const typename BodyType::State& state) {
    material.respond(deformation, state, Real(0));
  };

  // Weight of the forces at the end of a step in the balance.
  Real static_share() const {
    if constexpr (with_inertia) return 1 - inertia_.scheme().alpha_f;
    return 1;
  }

  // Internal, contact and external forces by component, their balance without inertia, and its derivative.
  Trouble assemble(const Field& u, Real time, Real dt, const Field* driven, Field* excess) {
    internal_.setZero();
    matrix_.set_zero();
    {
      const Stopwatch watch(timings.assembly);
      if (const Trouble t = body_.assemble(u, dt, driven, internal_, excess, matrix_)) return t;
      if (!measured_) measure_stiffness();
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
  [[no_unique_address]] Only<with_inertia, Field, System> static_force_;
  Real norm_ = 0, merit_ = 0;
  Real stiffness_ = 0, sticking_ = 0;  // of the body, its inertia included, and of sticking [force / length]
  bool measured_ = false;              // whether they are those of this iteration
  [[no_unique_address]] Only<with_inertia, bool, struct MassTag> with_mass_{};
  Real extent_;  // largest reference coordinate
  Index pattern_revision_ = 1;
};

}  // namespace stickslip
