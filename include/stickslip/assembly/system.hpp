// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/body.hpp>
#include <stickslip/assembly/contact_pair.hpp>
#include <stickslip/assembly/inertia.hpp>
#include <stickslip/assembly/parts.hpp>
#include <stickslip/assembly/prescribed.hpp>
#include <stickslip/assembly/rigid_motions.hpp>
#include <stickslip/base/brief.hpp>

#include <algorithm>
#include <array>
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
  static constexpr bool weighs_body = with_inertia && (with_contact || has_damping<Model>);

  /// `revision` tells systems of one scene apart, for those who keep what they made of its pattern.
  System(BodyType& body, Pairs& pairs, Inertia& inertia, const std::vector<SideValue>& driven,
         const std::vector<SideValue>& loads, Index revision = 1)
      : body_(body),
        pairs_(pairs),
        inertia_(inertia),
        parts_(body.mesh()),
        motions_(body.mesh().nodes, parts_),
        prescribed_(dim, body.mesh().extent()),
        extent_(body.mesh().extent()),
        pattern_revision_(revision) {
    const Index components = body.mesh().node_count() * dim;
    for (const SideValue& d : driven) prescribed_.drive(d, body.mesh().side(d.side).nodes);
    for (const SideValue& l : loads)
      prescribed_.load(l, body.mesh().side(l.side).nodes, nodal_areas(body.mesh(), body.kinematics(), l.side));
    dofs_ = prescribed_.unknowns_of(components);
    leaning_ = without_support();
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
  /// Another one when the pattern has changed and the solver must analyse again.
  Index pattern_revision() const { return pattern_revision_; }

  /// Sets the driven and held components of a nodal field to their values at `time`.
  Trouble impose(Real time, Field& u) const { return prescribed_.impose(time, u); }
  /// Which supports prescribe different values of one component at `time`, in words; empty if none do.
  std::string contradiction(Real time) const { return prescribed_.contradiction(time); }

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
  /// Makes lagging bounds see a share of the last `bound_change`; `end_probe` takes that back.
  void probe(Real share) requires with_lag {
    for_each_lag([&](auto& pair) { pair.probe(share); });
  }
  void end_probe() requires with_lag {
    for_each_lag([](auto& pair) { pair.end_probe(); });
  }
  /// Makes lagging bounds see the pressures of first contacts; false where these bear less than a quarter of all.
  bool see_first_contacts() requires with_lag {
    Real all = 0, first = 0;
    for_each_lag([&](const auto& pair) { pair.add_up(all, first); });
    if (!(first > 0.25 * all)) return false;
    for_each_lag([](auto& pair) { pair.see_first_contacts(); });
    return true;
  }
  /// Begins an iteration that takes more care of contact nodes than one that has failed: see ContactPair.
  void begin_retry(bool sticking) requires(has_friction<Model>) {
    begin_iteration();
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (std::remove_reference_t<decltype(pair)>::with_friction) pair.retry(sticking);
    });
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
      accuse(ratio, "the bulk modulus is " + brief(ratio, 2) + " times the shear modulus, at a Poisson's ratio " +
                        brief(0.5 - poisson, 2) + " below 0.5");
    }
    if (by_gaps) {
      if (!words.empty()) return words;
      const Real reach = extent_ + u.lpNorm<Eigen::Infinity>();
      return "coordinates of up to " + brief(reach, 2) + ", of a body that measures " + brief(motions_.extent(), 2) +
             " from its centre, give gaps to no better than " + brief(std::numeric_limits<Real>::epsilon() * reach, 2);
    }
    if constexpr (with_contact) {
      internal_.setZero();
      matrix_.set_zero();
      if (!body_.assemble(u, 0, nullptr, internal_, nullptr, matrix_))
        for_each_contact(pairs_, [&](const auto& pair) {
          const Real ratio = pair.stiffest() / matrix_.largest();
          accuse(ratio, "the penalty of contact \"" + pair.name() + "\" is " + brief(ratio, 2) +
                            " times the body's stiffness");
        });
    }
    return words;
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
    if constexpr (with_contact) for_each_contact(pairs_, [&](const auto& pair) { sum.merge(pair.trial_summary()); });
    return sum;
  }

  /// A part of the body of which nothing resists some rigid-body motion at the displacements u: no support, and not the
  /// tangent of the last evaluation. With `moved`, one that besides has moved so in that displacement: what balance
  /// leaves open. -1 if there is none; see `part_name`.
  Index free_part(const Field& u, const Field* moved = nullptr) {
    motions_.take(u, dofs_, matrix_.view());
    for (Index part = 0; part < parts_.count(); ++part) {
      const std::vector<Field> free = motions_.unresisted(part, moved ? 10 * norm_ : 0);
      if (free.empty()) continue;
      if (!moved) return part;
      Real share = 0, whole = 0;
      for (const Field& r : free) share = std::hypot(share, r.dot(*moved));
      for (Index c = 0; c < moved->size(); ++c)
        if (parts_.at(c / dim) == part) whole = std::hypot(whole, (*moved)[c]);
      if (share > 1e-6 * whole) return part;
    }
    return -1;
  }
  /// Whether there is one.
  bool moves_freely(const Field& u, const Field* moved = nullptr) { return free_part(u, moved) >= 0; }
  /// A part of the body that may shift in some direction, for it has no support there and touches no tool; at the start
  /// of a run (`ever`), for it has no node that could. -1 if there is none. Deformation resists no shift.
  Index loose_part([[maybe_unused]] bool ever) const {
    for (const Index part : leaning_) {
      bool held = false;
      if constexpr (with_contact)
        for_each_contact(pairs_, [&](const auto& pair) {
          for (std::size_t k = 0; k < pair.nodes().size() && !held; ++k)
            held = parts_.at(pair.nodes()[k]) == part && (ever || pair.touches(k));
        });
      if (!held) return part;
    }
    return -1;
  }
  /// What a part is called in a sentence; empty where the body is of one.
  std::string part_name(Index part) const { return parts_.name(part, body_.mesh()); }

  /// Whether friction alone resists some rigid-body motion at the displacements u and `time`: without it nothing does.
  bool held_by_friction(const Field& u, Real time) requires(has_friction<Model>) {
    return !assemble(u, time, 0, nullptr, nullptr, true) && moves_freely(u);
  }
  /// Names the contacts all of whose touching nodes slid in the last evaluation, or else those of which some did, or
  /// else those that touched; empty if there is friction at none.
  std::string sliding_contacts() const requires(has_friction<Model>) {
    const auto named = [&](auto&& takes) {
      std::string names;
      for_each_contact(pairs_, [&](const auto& pair) {
        if constexpr (std::remove_reference_t<decltype(pair)>::with_friction)
          if (pair.trial_summary().touching > 0 && takes(pair.trial_summary()))
            names += (names.empty() ? "contact \"" : ", contact \"") + pair.name() + "\"";
      });
      return names;
    };
    std::string names = named([](const ContactSummary& of) { return of.sliding == of.touching; });
    if (names.empty()) names = named([](const ContactSummary& of) { return of.sliding > 0; });
    return names.empty() ? named([](const ContactSummary&) { return true; }) : names;
  }

  /// Sets out on a step from the converged displacements `from` at the time `begin` to the time `end`: tools that turn
  /// on the way are followed (theory.md, section 4.7).
  Trouble set_out(const Field& from, Real begin, Real end) requires with_contact {
    const Stopwatch watch(timings.contact);
    Trouble trouble;
    for_each_friction([&](auto& pair) {
      if (!trouble) trouble = pair.set_out(body_.mesh(), from, begin, end);
    });
    return trouble;
  }
  /// Whether the last evaluation, at the displacements `to`, shows a tool that must be followed and was not.
  bool must_follow([[maybe_unused]] const Field& from, [[maybe_unused]] const Field& to) requires with_contact {
    bool must = false;
    if constexpr (dim == 3)
      for_each_friction([&](auto& pair) { must = pair.must_follow(body_.mesh(), from, to) || must; });
    return must;
  }
  /// Whether a node's slide has turned within the step by more than the step can tell.
  Trouble slide_turned() requires with_contact {
    Trouble trouble;
    for_each_friction([&](auto& pair) {
      if (!trouble) trouble = pair.slide_turned();
    });
    return trouble;
  }

  /// Names the contacts that such a step was refused for.
  std::string turned_too_far() requires with_contact {
    std::string names;
    for_each_friction([&](auto& pair) {
      if (pair.turned_too_far()) names += (names.empty() ? "contact " : ", ") + pair.name();
    });
    return names;
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
      if (!with_mass_) stiffness_ += inertia_.stiffness();
      with_mass_ = true;
      if constexpr (keeps_couplings<Model>) couplings_.scale(end_share());
    }
    dofs_.gather(balance_, residual_);
    norm_ = residual_.norm();
    if (!std::isfinite(norm_)) return {Cause::not_finite, {}};
    return {};
  }

  // The parts that have no support against some shift; in axisymmetry against that along the axis.
  std::vector<Index> without_support() const {
    constexpr Index first = Model::Kinematics::hoop ? dim - 1 : 0;
    std::vector<bool> held(static_cast<std::size_t>(parts_.count() * dim), false);
    for (Index c = 0; c < dofs_.components(); ++c)
      if (dofs_.equation(c) == Dofs::constrained)
        held[static_cast<std::size_t>(parts_.at(c / dim) * dim + c % dim)] = true;
    std::vector<Index> without;
    for (Index part = 0; part < parts_.count(); ++part)
      for (Index i = first; i < dim; ++i)
        if (!held[static_cast<std::size_t>(part * dim + i)]) {
          without.push_back(part);
          break;
        }
    return without;
  }

  template <class Visit>
  void for_each_pass(Visit&& visit) {
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (std::remove_reference_t<decltype(pair)>::passes) visit(pair);
    });
  }

  template <class Visit>
  void for_each_friction(Visit&& visit) {
    for_each_contact(pairs_, [&](auto& pair) {
      if constexpr (std::remove_reference_t<decltype(pair)>::with_friction) visit(pair);
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

  // Weight of the forces at the end of a step in the balance; with inertia, of those that `balance_` has before it,
  // where those of the body are weighed already.
  Real end_share() const {
    if constexpr (with_inertia) return inertia_.contact_share();
    return 1;
  }

  // Internal, contact and external forces by component, their balance and its derivative; with inertia, what its
  // balance is made of (InertiaForces::apply). If contact is to be `smooth`, the derivative is without friction's.
  Trouble assemble(const Field& u, Real time, Real dt, const Field* driven, Field* excess, bool smooth = false) {
    internal_.setZero();
    matrix_.set_zero();
    {
      const Stopwatch watch(timings.assembly);
      if (const Trouble t = body_.assemble(u, dt, driven, internal_, excess, matrix_)) return t;
      if (!measured_) measure_stiffness();
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
        if (!trouble)
          trouble = pair.assemble(body_.mesh(), u, time, dt, driven, contact_, excess, matrix_, couplings_, smooth);
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
  Parts parts_;
  RigidMotions<typename Model::Kinematics> motions_;
  std::vector<Index> leaning_;  // parts that only a tool could hold against some shift
  Prescribed prescribed_;
  Field internal_, contact_, external_, balance_, residual_;
  Field excess_;  // forces that closing the stiff relations' defects adds, by component
  Field open_;    // the residual without them
  [[no_unique_address]] Only<with_inertia, Field, System> smooth_;
  Real norm_ = 0, merit_ = 0;
  Real stiffness_ = 0, sticking_ = 0;  // of the body, its inertia included, and of sticking [force / length]
  bool measured_ = false;              // whether they are those of this iteration
  [[no_unique_address]] Only<with_inertia, bool, struct MassTag> with_mass_{};
  Real extent_;  // largest reference coordinate
  Index pattern_revision_;
};

}  // namespace stickslip
