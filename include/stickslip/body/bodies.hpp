// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/base/require.hpp>
#include <stickslip/body/body.hpp>
#include <stickslip/mesh/facet.hpp>

#include <algorithm>
#include <list>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace stickslip {

/// See BodyDescription.
template <int dim, class Element, class Material, bool weighed>
struct BodyDescriptionOf {
  std::string name = "";  ///< sides are then called "name.side"
  Mesh<dim, Element::nodes> mesh;
  Material material{};
  [[no_unique_address]] StoredIf<weighed, Real, BodyDescriptionOf> density{};  ///< [mass / reference volume]
  std::string nodes_of = "";  ///< another body, given before it, whose nodes this one's mesh has: they are shared
};

/// A body as the user describes it. `Type` has its Element and Material.
template <class Model, class Type>
using BodyDescription =
    BodyDescriptionOf<Model::Kinematics::dim, typename Type::Element, typename Type::Material, has_inertia<Model>>;

namespace detail {
template <class Model, class Type>
using BodyOfType =
    BodyOf<typename Model::Kinematics, typename Type::Element, typename Type::Material, matrix_storage<Model>>;

// Lists of the bodies of each type: `Types` is BodyTypes, or a type alone where a model names none.
template <class Kinematics, class Types, Symmetry storage, bool weighed>
struct BodyLists {
  using Stored = std::tuple<std::list<BodyOf<Kinematics, typename Types::Element, typename Types::Material, storage>>>;
  using Described =
      std::vector<BodyDescriptionOf<Kinematics::dim, typename Types::Element, typename Types::Material, weighed>>;
  static constexpr bool named = false, one_type = true;
};
template <class Kinematics, class... Types, Symmetry storage, bool weighed>
struct BodyLists<Kinematics, BodyTypes<Types...>, storage, weighed> {
  using Stored =
      std::tuple<std::list<BodyOf<Kinematics, typename Types::Element, typename Types::Material, storage>>...>;
  using Described = std::tuple<
      std::vector<BodyDescriptionOf<Kinematics::dim, typename Types::Element, typename Types::Material, weighed>>...>;
  static constexpr bool named = true, one_type = false;
};
template <class Kinematics, class Type, Symmetry storage, bool weighed>
struct BodyLists<Kinematics, BodyTypes<Type>, storage, weighed> : BodyLists<Kinematics, Type, storage, weighed> {
  static constexpr bool named = true;
};

// The side of a body that is called `side` in a scene: "body.side", or "side" alone.
inline bool is_side_of(const std::string& body, const std::string& side) {
  return side.size() > body.size() && side.starts_with(body) && side[body.size()] == '.';
}
inline std::string own_side(const std::string& body, const std::string& side) {
  return is_side_of(body, side) ? side.substr(body.size() + 1) : side;
}
[[noreturn, gnu::cold]] inline void refuse_side(const std::string& side, const std::vector<std::string>& bodies) {
  throw std::invalid_argument("there is no side called \"" + side +
                              "\": sides are named \"body.side\", and the bodies are " + listed(bodies));
}
[[noreturn, gnu::cold]] inline void refuse_name(const std::string& body) {
  throw std::invalid_argument("bodies: " +
                              (body.empty() ? "one of several has no name" : "two are called \"" + body + "\""));
}
[[noreturn, gnu::cold]] inline void refuse_shared_nodes(const std::string& body, const std::string& of, bool exists) {
  throw std::invalid_argument("body \"" + body + "\": " +
                              (exists ? "its mesh does not have the nodes of body \"" + of + "\", which it is to share"
                                      : "there is no body \"" + of + "\" before it to share nodes with"));
}
[[noreturn, gnu::cold]] inline void refuse_loose_node(const std::string& body, Index node) {
  throw std::invalid_argument("body" + (body.empty() ? "" : " \"" + body + "\"") + ": node " + std::to_string(node) +
                              " of the mesh is in no cell");
}
[[gnu::cold]] inline void require_density(Real density, const std::string& body) {
  require::positive(density, ((body.empty() ? "inertia" : "body \"" + body + "\"") + ": the density").c_str());
}
}  // namespace detail

/// The bodies of a problem under one numbering: a body's nodes and cells follow those of the bodies before it, unless
/// it shares the nodes of one. Each is a term that adds to its part of the fields. Models that differ in contact or
/// solver share the class: see Bodies.
template <class Kinematics_, class Types, Symmetry storage, bool weighed>
class BodiesOf {
  using Lists = detail::BodyLists<Kinematics_, Types, storage, weighed>;
  using First = typename std::tuple_element_t<0, typename Lists::Stored>::value_type;

 public:
  using Kinematics = Kinematics_;
  using Point = Vec<Real, Kinematics::dim>;
  using Matrix = SparseMatrix<storage>;
  /// As the user gives them: a list, or with several types a tuple of a list each.
  using Descriptions = typename Lists::Described;
  /// A tuple of a list for each type of bodies.
  using Stored = typename Lists::Stored;
  static constexpr int dim = Kinematics::dim;
  static constexpr bool one_type = Lists::one_type;

  /// Throws std::invalid_argument, naming the input, before anything is computed.
  [[gnu::cold]] BodiesOf(Descriptions described, const Kinematics& kinematics) {
    if constexpr (one_type)
      add_all(std::get<0>(lists_), described, kinematics);
    else
      [&]<std::size_t... i>(std::index_sequence<i...>) {
        (add_all(std::get<i>(lists_), std::get<i>(described), kinematics), ...);
      }
    (std::make_index_sequence<std::tuple_size_v<Stored>>{});
    if (count_ == 0) throw std::invalid_argument("bodies: there is none");
    require_cells();
    for_each([&](const auto& body) {
      extent_ = std::max(extent_, body.extent());
      if (count_ == 1) return;
      joined_.resize(std::max(joined_.size(), static_cast<std::size_t>(body.first_node()) + body.mesh().nodes.size()));
      std::copy(body.mesh().nodes.begin(), body.mesh().nodes.end(), joined_.begin() + body.first_node());
    });
  }
  /// One body without a name.
  BodiesOf(typename First::MeshType mesh, const Kinematics& kinematics,
           const typename First::Material& material) requires(one_type)
      : BodiesOf(one(std::move(mesh), material), kinematics) {}
  BodiesOf(const BodiesOf&) = delete;
  BodiesOf& operator=(const BodiesOf&) = delete;

  /// Calls visit(body) for each, in the order of their numbering within a type.
  template <class Visit>
  void for_each(Visit&& visit) {
    visit_lists(lists_, visit);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    visit_lists(lists_, visit);
  }
  /// Mass per reference volume of a body, by its number [mass / length^3].
  Real density(std::size_t body) const requires weighed { return densities_[body]; }
  Index count() const { return count_; }
  Index node_count() const { return nodes_; }
  Index cell_count() const { return cells_; }
  /// Reference positions of all nodes [length].
  const std::vector<Point>& positions() const {
    if (count_ > 1) return joined_;
    const std::vector<Point>* only = nullptr;
    for_each([&](const auto& body) { only = &body.mesh().nodes; });
    return *only;
  }
  /// Largest reference coordinate [length].
  Real extent() const { return extent_; }

  /// The result of visit(body, side) for the side called `name`: "side", or "body.side" where bodies have names. Throws
  /// std::invalid_argument, which lists what there is, if there is none.
  template <class Visit>
  auto with_side(const std::string& name, Visit&& visit) const {
    std::optional<decltype(visit(std::declval<const First&>(), name))> result;
    for_each([&](const auto& body) {
      if (!result && (count_ == 1 || detail::is_side_of(body.name(), name)))
        result.emplace(visit(body, detail::own_side(body.name(), name)));
    });
    if (!result) detail::refuse_side(name, names());
    return std::move(*result);
  }
  /// The nodes of a side, by number.
  std::vector<Index> side_nodes(const std::string& name) const {
    return with_side(name, [](const auto& body, const std::string& side) {
      std::vector<Index> nodes = body.mesh().side(side).nodes;
      for (Index& n : nodes) n += body.first_node();
      return nodes;
    });
  }
  bool side_has_facets(const std::string& name) const {
    return with_side(name,
                     [](const auto& body, const std::string& side) { return !body.mesh().side(side).facets.empty(); });
  }
  /// Reference areas that the nodes of a side carry, in the side's order.
  std::vector<Real> side_areas(const std::string& name) const {
    return with_side(name, [](const auto& body, const std::string& side) {
      return nodal_areas(body.mesh(), body.kinematics(), side);
    });
  }

  // The only body of a model that names no types of bodies.
  const auto& only() const requires(!Lists::named) { return std::get<0>(lists_).front(); }
  const auto& mesh() const requires(!Lists::named) { return only().mesh(); }
  const Kinematics& kinematics() const requires(!Lists::named) { return only().kinematics(); }
  const auto& material() const requires(!Lists::named) { return only().material(); }

  // --- The term: see BodyOf

  void couple(SparsityPattern& pattern) const {
    for_each([&](const auto& body) { body.couple(pattern); });
  }
  void connect(const IndexMap& dofs, const Matrix& matrix) {
    for_each([&](auto& body) { body.connect(dofs, matrix); });
  }
  void extrapolate(Real share, bool smooth) {
    for_each([&](auto& body) { body.extrapolate(share, smooth); });
  }
  void begin_iteration() {
    for_each([](auto& body) { body.begin_iteration(); });
  }
  void predict(const Field& du, Real fraction) {
    for_each([&](auto& body) { body.predict(du, fraction); });
  }
  void set_step(Real length) {
    for_each([&](auto& body) { body.set_step(length); });
  }
  Real constraint_merit() const {
    Real sum = 0;
    for_each([&](const auto& body) { sum += body.constraint_merit(); });
    return sum;
  }
  template <class Evaluation>
  Failure evaluate(const Evaluation& ev, Field& forces) {
    Failure failure;
    for_each([&](auto& body) {
      if (!failure) failure = body.evaluate(ev, forces);
    });
    return failure;
  }
  void commit() {
    for_each([](auto& body) { body.commit(); });
  }
  void serialize(Archive& archive) {
    for_each([&](auto& body) { body.serialize(archive); });
  }

 private:
  static Descriptions one(typename First::MeshType mesh, const typename First::Material& material) requires(one_type) {
    Descriptions list(1);
    list[0].mesh = std::move(mesh);
    list[0].material = material;
    return list;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for_each([&](const auto& body) { all.push_back(body.name()); });
    return all;
  }
  template <class All, class Visit>
  static void visit_lists(All& lists, Visit& visit) {
    if constexpr (one_type)
      for (auto& body : std::get<0>(lists)) visit(body);
    else
      std::apply([&](auto&... list) { (visit_list(list, visit), ...); }, lists);
  }
  template <class List, class Visit>
  static void visit_list(List& list, Visit& visit) {
    for (auto& body : list) visit(body);
  }
  template <class List, class Described>
  [[gnu::cold]] void add_all(List& list, Described& described, const Kinematics& kinematics) {
    for (auto& d : described) {
      if constexpr (requires { d.material.validate(); }) d.material.validate();
      if constexpr (weighed) detail::require_density(d.density, d.name);
      Index first = nodes_;
      for_each([&](const auto& other) {
        if (other.name() == d.name) detail::refuse_name(d.name);
        if (d.nodes_of.empty() || other.name() != d.nodes_of) return;
        first = other.first_node();
        if (other.mesh().nodes != d.mesh.nodes) detail::refuse_shared_nodes(d.name, d.nodes_of, true);
      });
      if (!d.nodes_of.empty() && first == nodes_) detail::refuse_shared_nodes(d.name, d.nodes_of, false);
      const Index end = first + d.mesh.node_count();
      list.emplace_back(std::move(d.mesh), kinematics, d.material, d.name, first, cells_);
      if constexpr (weighed) densities_.push_back(d.density);
      nodes_ = std::max(nodes_, end);
      cells_ += list.back().mesh().cell_count();
      ++count_;
    }
  }
  // Throws where a node is in no cell of any body: its matrix row would be zero.
  [[gnu::cold]] void require_cells() const {
    std::vector<bool> listed(static_cast<std::size_t>(nodes_), false);
    for_each([&](const auto& body) {
      for (const auto& cell : body.mesh().cells)
        for (const Index n : cell) listed[static_cast<std::size_t>(body.first_node() + n)] = true;
    });
    for_each([&](const auto& body) {
      for (Index n = 0; n < body.mesh().node_count(); ++n)
        if (!listed[static_cast<std::size_t>(body.first_node() + n)]) detail::refuse_loose_node(body.name(), n);
    });
  }

  Stored lists_;
  std::vector<Point> joined_;  // of several bodies
  [[no_unique_address]] StoredIf<weighed, std::vector<Real>, BodiesOf> densities_;
  Index count_ = 0, nodes_ = 0, cells_ = 0;
  Real extent_ = 0;
};

/// The bodies of a model.
template <class Model>
using Bodies = BodiesOf<typename Model::Kinematics, typename detail::BodiesIn<Model>::type, matrix_storage<Model>,
                        has_inertia<Model>>;
/// The same as the user gives them: a list, or with several types a tuple of a list each.
template <class Model>
using BodyDescriptions = typename Bodies<Model>::Descriptions;

/// The only body of a model that names no types of bodies; models that differ in contact, inertia or solver share it.
template <class Model>
using Body = detail::BodyOfType<Model, Model>;

}  // namespace stickslip
