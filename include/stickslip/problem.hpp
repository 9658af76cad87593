// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/assembly/system.hpp>
#include <stickslip/solve/newton.hpp>
#include <stickslip/solve/report.hpp>
#include <stickslip/solve/step_control.hpp>

#include <cmath>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace stickslip {

template <class Model>
class Problem;

/// A run in progress: an input range of converged steps. Each increment computes one step; the range ends at the end of
/// the run or at a failure, which `outcome()` tells.
template <class Model>
class March {
 public:
  class Iterator {
   public:
    using iterator_concept = std::input_iterator_tag;
    using value_type = StepReport;
    using difference_type = std::ptrdiff_t;
    const StepReport& operator*() const { return march_->step_; }
    const StepReport* operator->() const { return &march_->step_; }
    Iterator& operator++() {
      march_->advance();
      return *this;
    }
    void operator++(int) { ++*this; }
    friend bool operator==(const Iterator& it, std::default_sentinel_t) { return it.at_end(); }

   private:
    friend class March;
    explicit Iterator(March* march) : march_(march) {}
    bool at_end() const { return march_->ended_; }
    March* march_;
  };

  Iterator begin() {
    if (!begun_) advance();
    begun_ = true;
    return Iterator(this);
  }
  std::default_sentinel_t end() const { return {}; }

  /// Runs to the end without looking at the steps.
  const Outcome& finish() {
    for ([[maybe_unused]] const StepReport& step : *this) {
    }
    return outcome_;
  }
  /// How the run ended, or that it goes well so far.
  const Outcome& outcome() const { return outcome_; }
  const RunReport& report() const { return report_; }

 private:
  friend class Problem<Model>;
  March(Problem<Model>& problem, const MarchOptions& options);
  void advance();
  Index pass_again(Field& u, Real time, Real dt, NewtonReport& newton);

  Problem<Model>& problem_;
  MarchOptions options_;
  StepControl control_;
  Newton<SolverOf<Model>> newton_;
  StepReport step_{};
  RunReport report_{};
  Outcome outcome_{};
  Field trial_, driven_;
  bool begun_ = false;
  bool ended_ = false;
};

/// A scene of the bundle `Model`: body, tools, supports and loads, and its converged state. The bundle decides what
/// there is (docs/policies.md); the parameters say how much.
template <class Model>
class Problem {
  static_assert(CheckModel<Model>::ok);

 public:
  using BodyType = Body<Model>;
  static constexpr int dim = Model::Kinematics::dim;
  static constexpr bool with_contact = has_contact<Model>;
  static constexpr bool symmetric_storage = matrix_storage<Model> == Symmetry::symmetric;

  struct Parameters {
    typename BodyType::MeshType body;
    [[no_unique_address]] typename Model::Kinematics kinematics{};
    typename Model::Material material{};
    [[no_unique_address]] typename Model::Inertia inertia{};
    [[no_unique_address]] Only<with_contact, Contacts<Model>, Problem> contacts{};
  };

  /// Throws std::invalid_argument, naming the input, before anything is computed.
  explicit Problem(Parameters parameters)
      : body_(std::move(parameters.body), validated(parameters.kinematics), validated(parameters.material)) {
    if constexpr (with_contact) add_contacts(parameters.contacts, pairs_);
    if constexpr (has_inertia<Model>) inertia_.emplace(body_, validated(parameters.inertia));
    u_.setZero(body_.mesh().node_count() * dim);
    last_increment_ = u_;
    if constexpr (has_inertia<Model>) increment_before_ = u_;
  }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;

  /// Holds a displacement component of a side at zero.
  Problem& hold(const std::string& side, Index component) { return drive(side, component, nullptr); }
  /// Drives a displacement component of a side: value(time) [length].
  Problem& drive(const std::string& side, Index component, std::function<Real(Real)> value) {
    driven_.push_back(checked({side, component, std::move(value)}));
    return *this;
  }
  /// Loads a side with a total dead force in one component, spread over its reference area: value(time) [force].
  Problem& load(const std::string& side, Index component, std::function<Real(Real)> value) {
    if (!value) throw std::invalid_argument("load on side \"" + side + "\": needs a function of time");
    if (body_.mesh().side(side).facets.empty())
      throw std::invalid_argument("load on side \"" + side + "\": the side has no facets to spread it over");
    loads_.push_back(checked({side, component, std::move(value)}));
    return *this;
  }

  /// Sets the velocity at time 0, of all nodes alike or as a function of the reference position [length / time].
  Problem& start_velocity(const Vec<Real, dim>& velocity) requires has_inertia<Model> {
    return start_velocity([velocity](const Vec<Real, dim>&) { return velocity; });
  }
  Problem& start_velocity(const std::function<Vec<Real, dim>(const Vec<Real, dim>&)>& velocity) requires
      has_inertia<Model> {
    for (Index n = 0; n < body_.mesh().node_count(); ++n)
      inertia_->velocity().template segment<dim>(n * dim) = velocity(body_.mesh().nodes[static_cast<std::size_t>(n)]);
    return *this;
  }

  /// Begins a run from the present state; the problem must outlive it.
  March<Model> march(const MarchOptions& options) {
    options.validate(time_);
    return March<Model>(*this, options);
  }

  Real time() const { return time_; }
  /// The discrete system of the last run; it exists once a march has begun.
  const System<Model>& system() const {
    if (!system_) throw std::invalid_argument("the problem has no system before its first march");
    return *system_;
  }
  const BodyType& body() const { return body_; }
  /// Converged nodal displacements, node * dim + component [length].
  const Field& displacement() const { return u_; }
  /// Displacement of a node [length].
  Vec<Real, dim> displacement(Index node) const { return u_.template segment<dim>(node * dim); }
  /// Mass, velocity and acceleration.
  const InertiaForces<Model>& inertia() const requires has_inertia<Model> { return *inertia_; }
  Index unknowns() const { return system_ ? system_->dofs().unknowns() : 0; }

  /// The contact called `name`.
  const ContactRecord<dim>& contact(const std::string& name) const requires with_contact {
    const ContactRecord<dim>* found = nullptr;
    visit_contacts([&](const auto& pair) {
      if (pair.name() == name) found = &pair;
    });
    if (!found) throw std::invalid_argument("there is no contact called \"" + name + "\"");
    return *found;
  }
  /// Calls visit(pair) for every ContactPair.
  template <class Visit>
  void visit_contacts(Visit&& visit) const requires with_contact {
    for_each_contact(pairs_, visit);
  }
  /// Force of the body on the tool of a contact [force]; in axisymmetry of the full turn.
  Vec<Real, dim> contact_force(const std::string& name) const requires with_contact { return contact(name).force(); }
  /// Sum of the support forces on the body at a side, in one component [force].
  Real reaction(const std::string& side, Index component) const {
    const auto& nodes = body_.mesh().side(side).nodes;
    require_component(side, component);
    Real sum = 0;
    if (system_)
      for (const Index n : nodes) sum += reactions_[n * dim + component];
    return sum;
  }

  /// Largest accumulated plastic strain of a point; 0 for a material that has none.
  Real max_plastic_strain() const {
    Real largest = 0;
    if constexpr (requires(typename BodyType::State s) { s.plastic_strain; })
      body_.visit_points(u_, [&](Index, int, const auto&, const auto& state, Real) {
        largest = std::max(largest, state.plastic_strain);
      });
    return largest;
  }

 private:
  friend class March<Model>;

  template <class Friction>
  void add_contacts(const std::vector<Contact<Model, Friction>>& contacts,
                    std::vector<ContactPair<Model, Friction>>& pairs) requires with_contact {
    for (const auto& c : contacts) {
      visit_contacts([&](const auto& pair) {
        if (pair.name() == (c.name.empty() ? c.side : c.name))
          throw std::invalid_argument("two contacts are called \"" + pair.name() + "\"; give them names");
      });
      pairs.emplace_back(c, body_.mesh(), body_.kinematics());
    }
  }
  template <class... Frictions>
  void add_contacts(const std::tuple<std::vector<Contact<Model, Frictions>>...>& contacts,
                    std::tuple<std::vector<ContactPair<Model, Frictions>>...>& pairs) requires with_contact {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (add_contacts(std::get<i>(contacts), std::get<i>(pairs)), ...);
    }
    (std::index_sequence_for<Frictions...>());
  }

  template <class P>
  static const P& validated(const P& parameters) {
    if constexpr (requires { parameters.validate(); }) parameters.validate();
    return parameters;
  }
  static void require_component(const std::string& side, Index component) {
    if (component < 0 || component >= dim)
      throw std::invalid_argument("side \"" + side + "\": there is no component " + std::to_string(component));
  }
  SideValue checked(SideValue value) {
    (void)body_.mesh().side(value.side);
    require_component(value.side, value.component);
    system_.reset();  // supports decide the numbering
    return value;
  }

  BodyType body_;
  [[no_unique_address]] typename System<Model>::Pairs pairs_;
  [[no_unique_address]] Only<has_inertia<Model>, std::optional<InertiaForces<Model>>, BodyType> inertia_;
  std::vector<SideValue> driven_, loads_;
  std::unique_ptr<System<Model>> system_;
  Field u_, last_increment_, reactions_;
  [[no_unique_address]] Only<has_inertia<Model>, Field, Problem> increment_before_;
  Real time_ = 0;
  Real last_dt_ = 0;              // 0: there is no increment to extrapolate
  Real increment_before_dt_ = 0;  // 0: nor a bend
};

template <class Model>
March<Model>::March(Problem<Model>& problem, const MarchOptions& options)
    : problem_(problem),
      options_(options),
      control_(options, problem.time_),
      newton_(NewtonOptions{.tolerance = options.tolerance,
                            .max_iterations = options.max_iterations,
                            .line_search = options.line_search}) {
  if (!problem.system_) {
    if constexpr (has_inertia<Model>)
      problem.system_ = std::make_unique<System<Model>>(problem.body_, problem.pairs_, *problem.inertia_,
                                                        problem.driven_, problem.loads_);
    else
      problem.system_ = std::make_unique<System<Model>>(problem.body_, problem.pairs_, problem.inertia_,
                                                        problem.driven_, problem.loads_);
    problem.reactions_.setZero(problem.u_.size());
    if constexpr (has_contact<Model>)
      if (problem.time_ == 0) {
        for_each_contact(problem.pairs_, [&](auto& pair) {
          if (const Trouble t = pair.start(problem.body_.mesh(), problem.u_, problem.time_))
            throw std::invalid_argument("contact \"" + pair.name() +
                                        "\": the tool's position or the distance to it is not finite at the start");
        });
        if (const Trouble t = problem.system_->measure(problem.u_))
          throw std::invalid_argument(std::string("the start is not a state: ") + describe(t.cause));
      }
    if constexpr (has_inertia<Model>)
      if (problem.time_ == 0)
        if (const Trouble t = problem.system_->start(problem.u_, problem.time_))
          throw std::invalid_argument(std::string("the start is not a state: ") + describe(t.cause));
  }
}

/// Passes over a step whose first one has converged, until another one would change nothing beyond the tolerance
/// (theory.md, section 5.8). Their iterations are added to `newton`, but step control looks at those of the first pass.
template <class Model>
Index March<Model>::pass_again([[maybe_unused]] Field& u, [[maybe_unused]] Real time, [[maybe_unused]] Real dt,
                               [[maybe_unused]] NewtonReport& newton) {
  Index passes = 1;
  if constexpr (takes_passes<Model>()) {
    System<Model>& system = *problem_.system_;
    Real before = 0;
    for (Real now = system.unsettled(); now > options_.pass_tolerance; now = system.unsettled()) {
      if (passes == options_.max_passes) {
        newton.trouble = {Cause::passes_failed, {}};
        break;
      }
      // Multipliers settle by a factor that falls with the stiffness, so that no value of it need be asked for.
      if (before > 0 && now > 0.25 * before) system.stiffen(4);
      before = now;
      system.renew();
      const NewtonReport again = newton_.resume(system, u, time, dt);
      ++passes;
      newton.iterations += again.iterations;
      newton.residual = again.residual;
      newton.trouble = again.trouble;
      if (newton.trouble) break;
    }
  }
  return passes;
}

template <class Model>
void March<Model>::advance() {
  if (ended_ || control_.finished() || !outcome_) {
    ended_ = true;
    return;
  }
  System<Model>& system = *problem_.system_;
  Field& u = trial_;
  Index rejected = 0;
  for (;;) {
    const Real time = control_.next();
    const Real dt = time - problem_.time_;
    // Guess: the last increment again. For lack of one, with inertia velocity and acceleration, else the tangent at the
    // converged state.
    u = problem_.u_;
    bool extrapolate = problem_.last_dt_ > 0;
    if (extrapolate) {
      const Real h = problem_.last_dt_;
      u += dt / h * problem_.last_increment_;
      // Inertia keeps the path smooth, so its bend is worth half a guess; quasi-static paths have kinks.
      if constexpr (has_inertia<Model>)
        if (const Real before = problem_.increment_before_dt_; before > 0)
          u +=
              0.5 * dt * (dt + h) / (h + before) * (problem_.last_increment_ / h - problem_.increment_before_ / before);
    }
    if constexpr (has_inertia<Model>) {
      problem_.inertia_->begin(problem_.u_, dt);
      if (!extrapolate) problem_.inertia_->predict(u);
      extrapolate = true;
    }
    Trouble trouble = system.impose(time, u);
    if constexpr (takes_passes<Model>()) system.begin_passes();
    NewtonReport newton;
    if (trouble) {
      newton.trouble = trouble;
    } else if (extrapolate) {
      newton = newton_.solve(system, u, time, dt);
    } else {
      driven_ = u - problem_.u_;
      u = problem_.u_;
      newton = newton_.solve(system, u, time, dt, driven_.isZero(0) ? nullptr : &driven_);
    }
    Index passes = 1;
    const Index first_iterations = newton.iterations;
    if constexpr (takes_passes<Model>())
      if (!newton.trouble) passes = pass_again(u, time, dt, newton);
    report_.passes += passes;
    report_.iterations += newton.iterations;
    report_.work = newton_.counts;
    report_.timings = system.timings;
    Real local_error = 0, error = 0;
    if constexpr (has_inertia<Model>) {
      if (!newton.trouble) local_error = problem_.inertia_->local_error();
      if (options_.time_tolerance > 0) error = local_error / options_.time_tolerance;
      if (error > 2 && options_.steps == 0) {
        control_.reject(time, error);
        if (!control_.too_small()) {
          ++rejected;
          ++report_.rejected_steps;
          continue;
        }
      }
    }
    if (!newton.trouble) {
      const ContactSummary contact = system.contact_summary();
      const Real lag = contact.bound > 0 ? contact.lag / contact.bound : 0;
      control_.accept(time, first_iterations, error, options_.lag_tolerance > 0 ? lag / options_.lag_tolerance : 0);
      system.commit();
      if constexpr (has_inertia<Model>) {
        problem_.increment_before_.swap(problem_.last_increment_);
        problem_.increment_before_dt_ = problem_.last_dt_;
      }
      problem_.last_increment_ = u - problem_.u_;
      problem_.last_dt_ = dt;
      problem_.u_ = u;
      problem_.time_ = time;
      for (Index c = 0; c < system.dofs().components(); ++c) problem_.reactions_[c] = system.reaction(c);

      step_ = {.number = ++report_.steps,
               .time = time,
               .dt = dt,
               .iterations = newton.iterations,
               .rejected = rejected,
               .passes = passes,
               .residual = newton.residual,
               .contact = contact,
               .lag = lag,
               .local_error = local_error};
      report_.max_penetration = std::max(report_.max_penetration, step_.contact.max_penetration);
      report_.max_slip = std::max(report_.max_slip, step_.contact.max_slip);
      report_.max_lag = std::max(report_.max_lag, step_.lag);
      return;
    }
    ++rejected;
    ++report_.rejected_steps;
    control_.reject(time);
    if (control_.too_small()) {
      outcome_ = {.trouble = newton.trouble,
                  .step = report_.steps + 1,
                  .time = problem_.time_,
                  .tried_step = dt,
                  .attempts = rejected};
      ended_ = true;
      return;
    }
  }
}

}  // namespace stickslip
