// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/nodal.hpp>
#include <stickslip/solve/diagnosis.hpp>
#include <stickslip/solve/system.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace stickslip {

template <class Model>
class March;

namespace detail {
/// What a problem is made of, for a model of one body.
template <class Model, class Tag, bool several = NamesBodies<Model>>
struct SceneParameters {
  Mesh<Model::Kinematics::dim, Model::Element::nodes> body;
  [[no_unique_address]] typename Model::Kinematics kinematics{};
  typename Model::Material material{};
  [[no_unique_address]] StoredIf<has_inertia<Model>, Real, SceneParameters> density{};  ///< [mass / reference volume]
  [[no_unique_address]] typename Model::TimeIntegration time_integration{};
  [[no_unique_address]] DampingOf<Model> damping{};
  [[no_unique_address]] StoredIf<has_contact<Model>, Contacts<Model>, Tag> contacts{};
  [[no_unique_address]] SurfaceContacts<Model> surfaces{};
  [[no_unique_address]] TermsOf<Model> terms{};

  BodyDescriptions<Model> descriptions() && {
    BodyDescriptions<Model> list(1);
    list[0].mesh = std::move(body);
    list[0].material = material;
    if constexpr (has_inertia<Model>) list[0].density = density;
    return list;
  }
};
/// For a model that names types of bodies.
template <class Model, class Tag>
struct SceneParameters<Model, Tag, true> {
  BodyDescriptions<Model> bodies{};
  [[no_unique_address]] typename Model::Kinematics kinematics{};
  [[no_unique_address]] typename Model::TimeIntegration time_integration{};
  [[no_unique_address]] DampingOf<Model> damping{};
  [[no_unique_address]] StoredIf<has_contact<Model>, Contacts<Model>, Tag> contacts{};
  [[no_unique_address]] SurfaceContacts<Model> surfaces{};
  [[no_unique_address]] TermsOf<Model> terms{};

  BodyDescriptions<Model> descriptions() && { return std::move(bodies); }
};
}  // namespace detail

/// What of a scene depends on its bodies alone: supports and loads, and the converged displacements. Scenes that differ
/// in contact, inertia or solver share it.
template <class BodiesType_>
class BodyScene {
 public:
  using BodiesType = BodiesType_;
  static constexpr int dim = BodiesType::dim;

  BodyScene(const BodyScene&) = delete;
  BodyScene& operator=(const BodyScene&) = delete;

  Real time() const { return time_; }
  const BodiesType& bodies() const { return bodies_; }
  /// The body of a model that names no types of bodies.
  const auto& body() const requires requires(const BodiesType& bodies) { bodies.only(); }
  { return bodies_.only(); }
  /// Converged nodal displacements, node * dim + component [length].
  const Field& displacement() const { return u_; }
  /// Displacement of a node [length].
  Vec<Real, dim> displacement(Index node) const { return at_node<dim>(u_, node); }
  /// Sum of the support forces on the body at a side, in one component [force].
  Real reaction(const std::string& side, Index component) const {
    const std::vector<Index> nodes = bodies_.side_nodes(side);
    require_component(side, component);
    Real sum = 0;
    for (const Index n : nodes) sum += reactions_[n * dim + component];
    return sum;
  }
  /// Largest accumulated plastic strain of a point; 0 for a material that has none.
  Real max_plastic_strain() const {
    Real largest = 0;
    bodies_.for_each([&](const auto& body) {
      body.visit_points(u_, [&](Index, int, const auto&, const auto& state, Real) {
        if constexpr (requires { state.plastic_strain; }) largest = std::max(largest, state.plastic_strain);
      });
    });
    return largest;
  }

 protected:
  BodyScene(typename BodiesType::Descriptions bodies, const typename BodiesType::Kinematics& kinematics)
      : bodies_(std::move(bodies), kinematics) {}

  // See Scene, of the same names.
  [[gnu::cold]] void add_drive(const std::string& side, Index component, std::function<Real(Real)> value) {
    driven_.push_back(checked({side, component, std::move(value)}));
    Prescribed supports(dim, bodies_.extent());
    for (const SideValue& d : driven_) supports.drive(d, bodies_.side_nodes(d.side));
    if (const std::string fault = supports.contradiction(time_); !fault.empty()) {
      driven_.pop_back();
      refuse_supports(fault);
    }
  }
  [[gnu::cold]] void take_away(const std::string& side, Index component) {
    require_component(side, component);
    if (std::erase_if(driven_, [&](const SideValue& d) { return d.side == side && d.component == component; }) == 0)
      throw std::invalid_argument("release of side \"" + side + "\": it has no support in component " +
                                  std::to_string(component));
    changed_ = true;
  }
  [[gnu::cold]] void add_constraint(LinearConstraint constraint) {
    for (const IndexMap::Weighted& m : constraint.dependent.masters) require_exists(m.index);
    require_exists(constraint.dependent.component);
    constraints_.push_back(std::move(constraint));
    changed_ = true;
  }
  [[gnu::cold]] void add_load(const std::string& side, Index component, std::function<Real(Real)> value) {
    if (!value) throw std::invalid_argument("load on side \"" + side + "\": needs a function of time");
    if (!bodies_.side_has_facets(side))
      throw std::invalid_argument("load on side \"" + side + "\": the side has no facets to spread it over");
    loads_.push_back(checked({side, component, std::move(value)}));
  }

  [[noreturn, gnu::cold]] static void refuse_supports(const std::string& fault) {
    throw std::invalid_argument("two supports contradict each other: " + fault +
                                "; release() takes a side's supports away");
  }
  // Throws where two supports contradict each other on the way to a time, as far as a look at some times tells.
  [[gnu::cold]] void require_agreement(const Prescribed& prescribed, Real end) const {
    constexpr int looks = 64;
    for (int k = 0; k <= looks; ++k)
      if (const std::string fault = prescribed.contradiction(time_ + (end - time_) * k / looks); !fault.empty())
        refuse_supports(fault);
  }
  [[gnu::cold]] void check_bodies(Archive& archive) const {
    archive.check_equal("kinematics", type_name<typename BodiesType::Kinematics>());
    bodies_.for_each([&](const auto& body) {
      using BodyType = std::remove_cvref_t<decltype(body)>;
      const std::string of = body.name().empty() ? "" : " of body " + body.name();
      archive.check_equal("element" + of, type_name<typename BodyType::Element>());
      archive.check_equal("material" + of, type_name<typename BodyType::Material>());
      archive.check_equal("mesh" + of, fingerprint(body.mesh()));
    });
  }
  [[gnu::cold]] void serialize_bodies(Archive& archive) {
    archive("displacement", u_);
    archive("last increment", last_increment_);
    archive("time", time_);
    archive("last time increment", last_dt_);
    archive("time increment before", increment_before_dt_);
    archive("reactions", reactions_);
    bodies_.serialize(archive);
  }

  BodiesType bodies_;
  std::vector<SideValue> driven_, loads_;
  std::vector<LinearConstraint> constraints_;
  Field u_, last_increment_, reactions_;
  Real time_ = 0;
  Real last_dt_ = 0;              // 0: there is no increment to extrapolate
  Real increment_before_dt_ = 0;  // 0: nor a bend
  bool changed_ = false;          // supports or loads, since the system was made

 private:
  void require_exists(Index component) const {
    if (component < 0 || component >= u_.size())
      throw std::invalid_argument("linear constraint: there is no component " + std::to_string(component));
  }
  static void require_component(const std::string& side, Index component) {
    if (component < 0 || component >= dim)
      throw std::invalid_argument("side \"" + side + "\": there is no component " + std::to_string(component));
  }
  SideValue checked(SideValue value) {
    if (bodies_.side_nodes(value.side).empty()) throw std::invalid_argument("side \"" + value.side + "\" has no nodes");
    require_component(value.side, value.component);
    changed_ = true;  // supports decide the numbering
    return value;
  }
};

/// A scene, whatever solves it: bodies, tools, supports and loads, and its converged state.
template <class Model>
class Scene : public BodyScene<Bodies<Model>> {
 public:
  using Base = BodyScene<Bodies<Model>>;
  static constexpr int dim = Model::Kinematics::dim;
  static constexpr bool with_contact = has_contact<Model>;
  static constexpr bool symmetric_storage = matrix_storage<Model> == Symmetry::symmetric;

  using Parameters = detail::SceneParameters<Model, Scene>;

  /// Throws std::invalid_argument, naming the input, before anything is computed.
  [[gnu::cold]] explicit Scene(Parameters parameters)
      : Base(std::move(parameters).descriptions(), validated(parameters.kinematics)),
        terms_(std::move(parameters.terms)) {
    if constexpr (with_contact) add_contacts(parameters.contacts, tool_pairs(pairs_));
    if constexpr (has_surfaces<Model>)
      for (const auto& c : parameters.surfaces) {
        std::get<1>(pairs_).emplace_back(c, bodies_);
        require_own_name(std::get<1>(pairs_).back());
      }
    Index components = bodies_.node_count() * dim;
    std::apply([&](auto&... terms) { ((terms.number(components), components += terms.unknowns()), ...); }, terms_);
    if constexpr (has_inertia<Model>)
      inertia_.emplace(bodies_, validated(parameters.time_integration), validated(parameters.damping), contact_nodes(),
                       components);
    u_.setZero(components);
    last_increment_ = reactions_ = u_;
    if constexpr (has_inertia<Model>) increment_before_ = u_;
  }
  // Supports and loads may be given at any time, between the steps of a march as well: they count from the next step
  // on.

  /// Holds a displacement component of a side at zero.
  Scene& hold(const std::string& side, Index component) { return drive(side, component, nullptr); }
  /// Drives a displacement component of a side: value(time) [length]. Throws std::invalid_argument where another
  /// support prescribes another value of the component at a node now.
  Scene& drive(const std::string& side, Index component, std::function<Real(Real)> value) {
    this->add_drive(side, component, std::move(value));
    return *this;
  }
  /// Takes the supports of a side in one component away: what `hold` and `drive` on that side gave.
  Scene& release(const std::string& side, Index component) {
    this->take_away(side, component);
    return *this;
  }
  /// Makes a component of a node depend on others: u_dependent = sum of weight * u_master + offset(time), components
  /// counted node * dim + i over all bodies. Where that contradicts supports or another constraint, the next march
  /// throws std::invalid_argument.
  Scene& constrain(LinearConstraint constraint) {
    this->add_constraint(std::move(constraint));
    return *this;
  }
  /// Loads a side with a total dead force in one component, spread over its reference area: value(time) [force].
  Scene& load(const std::string& side, Index component, std::function<Real(Real)> value) {
    this->add_load(side, component, std::move(value));
    return *this;
  }

  /// Sets the velocity at time 0, of all nodes alike or as a function of the reference position [length / time]. Throws
  /// std::invalid_argument later on, where a velocity would contradict the motion so far.
  Scene& start_velocity(const Vec<Real, dim>& velocity) requires has_inertia<Model> {
    return start_velocity([velocity](const Vec<Real, dim>&) { return velocity; });
  }
  Scene& start_velocity(const std::function<Vec<Real, dim>(const Vec<Real, dim>&)>& velocity) requires
      has_inertia<Model> {
    if (time_ != 0)
      throw std::invalid_argument("start velocity: the run has begun, it is at time " + brief(time_) + " already");
    changed_ = true;  // the start is made again, if it has been
    for (Index n = 0; n < bodies_.node_count(); ++n) {
      const Vec<Real, dim> v = velocity(bodies_.positions()[static_cast<std::size_t>(n)]);
      if (!is_finite(v)) throw std::invalid_argument("start velocity: it is not finite at node " + std::to_string(n));
      for (int i = 0; i < dim; ++i) inertia_->velocity()[n * dim + i] = v[i];
    }
    return *this;
  }

  /// The discrete system of the last step; it exists once a march has begun.
  const System<Model>& system() const {
    if (!system_) throw std::invalid_argument("the problem has no system before its first march");
    return *system_;
  }
  /// The user's own terms.
  const TermsOf<Model>& terms() const { return terms_; }
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

 private:
  template <class>
  friend class March;
  using Base::bodies_, Base::driven_, Base::loads_, Base::constraints_, Base::u_, Base::last_increment_,
      Base::reactions_, Base::time_, Base::last_dt_, Base::increment_before_dt_, Base::changed_;

  // Makes the discrete system, unless supports and loads are the same as before, and at time 0 the state to start from.
  void prepare() {
    if (!system_ || changed_) make_system();
  }
  [[gnu::cold]] void make_system() {
    const Timings spent = system_ ? system_->timings : Timings{};
    const Index revision_of_pattern = system_ ? system_->tangent().revision : numberings_;
    diagnosis_.reset();
    system_.reset();
    numberings_ = revision_of_pattern + 1;
    system_ = std::make_unique<System<Model>>(bodies_, pairs_, inertia_term(), driven_, loads_, numberings_, &terms_,
                                              constraints_);
    diagnosis_ = std::make_unique<Diagnosis<Model>>(*system_);
    system_->timings = spent;
    changed_ = false;
    proven_ = false;
    if (time_ != 0) return;
    if (const Failure f = system_->start(u_, time_))
      throw std::invalid_argument(std::string("the start is not a state: ") + describe(f.cause));
  }
  InertiaForces<Model>& inertia_term() {
    if constexpr (has_inertia<Model>)
      return *inertia_;
    else
      return inertia_;
  }

  // Guesses the displacements after a step dt: the last increment again; for lack of one, with inertia those of
  // velocity and acceleration. Without either they are the converged ones, and it is false.
  bool extrapolate(Real dt, Field& u) {
    u = u_;
    const Real h = last_dt_;
    if (h > 0) u += dt / h * last_increment_;
    if constexpr (has_inertia<Model>) {
      // Inertia keeps the path smooth, so its bend is worth half a guess; quasi-static paths have kinks.
      if (const Real before = increment_before_dt_; h > 0 && before > 0)
        u += 0.5 * dt * (dt + h) / (h + before) * (last_increment_ / h - increment_before_ / before);
      inertia_->begin(u_, dt);
      if (!(h > 0)) inertia_->predict(u);
      return true;
    }
    return h > 0;
  }
  // Makes the state of the last evaluation, at the displacements u, the converged one.
  void accept(const Field& u, Real time, Real dt) {
    system_->commit(u, time, dt);
    if constexpr (has_inertia<Model>) {
      increment_before_.swap(last_increment_);
      increment_before_dt_ = last_dt_;
    }
    last_increment_ = u - u_;
    last_dt_ = dt;
    u_ = u;
    time_ = time;
    proven_ = true;
    ++revision_;
    reactions_ = system_->forces().reaction;
  }

  // What the scene is of, and its converged state.
  [[gnu::cold]] void serialize(Archive& archive) {
    this->check_bodies(archive);
    archive.check_equal("friction", type_name<typename Model::Friction>());
    archive.check_equal("enforcement", type_name<typename Model::Enforcement>());
    if constexpr (has_surfaces<Model>) archive.check_equal("surfaces", type_name<SurfacesOf<Model>>());
    if constexpr (with_contact) archive.check_equal("tool", type_name<ToolOf<Model>>());
    archive.check_equal("time integration", type_name<typename Model::TimeIntegration>());
    archive.check_equal("damping", type_name<DampingOf<Model>>());
    archive.check_equal("supports", system_->dofs().fingerprint());
    this->serialize_bodies(archive);
    std::apply([&](auto&... terms) { (terms.serialize(archive), ...); }, terms_);
    if constexpr (has_inertia<Model>) {
      archive("increment before", increment_before_);
      inertia_->serialize(archive);
    }
    if constexpr (with_contact) for_each_contact(pairs_, [&](auto& pair) { pair.serialize(archive); });
    if (!archive.loading()) return;
    proven_ = time_ != 0;
    ++revision_;
  }

  static auto& tool_pairs(typename System<Model>::Pairs& pairs) {
    if constexpr (has_surfaces<Model>)
      return std::get<0>(pairs);
    else
      return pairs;
  }
  void require_own_name(const ContactRecord<dim>& added) const requires with_contact {
    visit_contacts([&](const auto& pair) {
      if (&pair != &added && pair.name() == added.name())
        throw std::invalid_argument("two contacts are called \"" + pair.name() + "\"; give them names");
    });
  }
  template <class Friction>
  void add_contacts(const std::vector<Contact<Model, Friction>>& contacts,
                    detail::PairList<Model, Friction>& pairs) requires with_contact {
    for (const auto& c : contacts) {
      pairs.emplace_back(c, bodies_);
      require_own_name(pairs.back());
    }
  }
  template <class... Frictions>
  void add_contacts(const std::tuple<std::vector<Contact<Model, Frictions>>...>& contacts,
                    std::tuple<detail::PairList<Model, Frictions>...>& pairs) requires with_contact {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (add_contacts(std::get<i>(contacts), std::get<i>(pairs)), ...);
    }
    (std::index_sequence_for<Frictions...>());
  }

  // The nodes of contact sides, by number.
  std::vector<bool> contact_nodes() const {
    std::vector<bool> touches(static_cast<std::size_t>(bodies_.node_count()), false);
    if constexpr (with_contact)
      visit_contacts([&](const auto& pair) {
        pair.for_each_held(true, [&](Index n) { touches[static_cast<std::size_t>(n)] = true; });
      });
    return touches;
  }

  template <class P>
  static const P& validated(const P& parameters) {
    if constexpr (requires { parameters.validate(); }) parameters.validate();
    return parameters;
  }

  [[no_unique_address]] TermsOf<Model> terms_;
  [[no_unique_address]] typename System<Model>::Pairs pairs_;
  [[no_unique_address]] std::conditional_t<has_inertia<Model>, std::optional<InertiaForces<Model>>, NoInertiaForces>
      inertia_;
  std::unique_ptr<System<Model>> system_;
  std::unique_ptr<Diagnosis<Model>> diagnosis_;
  [[no_unique_address]] StoredIf<has_inertia<Model>, Field, Scene> increment_before_;
  bool proven_ = false;   // that supports hold the body, by a step
  Index numberings_ = 0;  // systems that were made
  Index revision_ = 0;    // of the converged state, for marches to tell whether it is still theirs
};

}  // namespace stickslip
