// SPDX-License-Identifier: BSL-1.0
#pragma once

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

/// A body as the user describes it. `Type` has its Element and Material.
template <class Model, class Type>
struct BodyDescription {
  std::string name = "";  ///< sides are then called "name.side"
  Mesh<Model::Kinematics::dim, Type::Element::nodes> mesh;
  typename Type::Material material{};
  [[no_unique_address]] StoredIf<has_inertia<Model>, Real, BodyDescription> density{};  ///< [mass / reference volume]
  std::string nodes_of = "";  ///< another body, given before it, whose nodes this one's mesh has: they are shared
};

namespace detail {
template <class Model, class Type>
using BodyOfType =
    BodyOf<typename Model::Kinematics, typename Type::Element, typename Type::Material, matrix_storage<Model>>;
template <class Model, class List>
struct BodyLists;
template <class Model, class... Types>
struct BodyLists<Model, BodyTypes<Types...>> {
  using Stored = std::tuple<std::list<BodyOfType<Model, Types>>...>;
  using Described = std::tuple<std::vector<BodyDescription<Model, Types>>...>;
  static constexpr std::size_t count = sizeof...(Types);
};
template <class Model, class Type>
struct BodyLists<Model, BodyTypes<Type>> {
  using Stored = std::tuple<std::list<BodyOfType<Model, Type>>>;
  using Described = std::vector<BodyDescription<Model, Type>>;
  static constexpr std::size_t count = 1;
};
}  // namespace detail

/// The bodies of a model as the user gives them: a list, or with several types a tuple of a list each.
template <class Model>
using BodyDescriptions = typename detail::BodyLists<Model, BodyTypesOf<Model>>::Described;

/// The bodies of a problem under one numbering: a body's nodes and cells follow those of the bodies before it, unless
/// it shares the nodes of one. Each is a term that adds to its part of the fields.
template <class Model>
class Bodies {
  using Lists = detail::BodyLists<Model, BodyTypesOf<Model>>;
  using First = typename std::tuple_element_t<0, typename Lists::Stored>::value_type;

 public:
  using Kinematics = typename Model::Kinematics;
  using Point = Vec<Real, Kinematics::dim>;
  using Matrix = SparseMatrix<matrix_storage<Model>>;
  static constexpr int dim = Kinematics::dim;
  static constexpr bool one_type = Lists::count == 1;

  /// Throws std::invalid_argument, naming the input, before anything is computed.
  Bodies(BodyDescriptions<Model> described, const Kinematics& kinematics) {
    if constexpr (one_type)
      add_all(std::get<0>(lists_), described, kinematics);
    else
      [&]<std::size_t... i>(std::index_sequence<i...>) {
        (add_all(std::get<i>(lists_), std::get<i>(described), kinematics), ...);
      }
    (std::make_index_sequence<Lists::count>{});
    if (count_ == 0) throw std::invalid_argument("bodies: there is none");
    require_cells();
    if (count_ > 1)
      for_each([&](const auto& body) {
        joined_.resize(
            std::max(joined_.size(), static_cast<std::size_t>(body.first_node()) + body.mesh().nodes.size()));
        std::copy(body.mesh().nodes.begin(), body.mesh().nodes.end(), joined_.begin() + body.first_node());
      });
    for_each([&](const auto& body) { extent_ = std::max(extent_, body.extent()); });
  }
  /// One body without a name.
  Bodies(typename First::MeshType mesh, const Kinematics& kinematics,
         const typename First::Material& material) requires(one_type)
      : Bodies(one(std::move(mesh), material), kinematics) {}
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  /// Calls visit(body) for each, in the order of their numbering within a type.
  template <class Visit>
  void for_each(Visit&& visit) {
    std::apply([&](auto&... list) { (visit_list(list, visit), ...); }, lists_);
  }
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::apply([&](const auto&... list) { (visit_list(list, visit), ...); }, lists_);
  }
  /// Mass per reference volume of a body, by its number [mass / length^3].
  Real density(std::size_t body) const requires has_inertia<Model> { return densities_[body]; }
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
      if (!result && (count_ == 1 || name.starts_with(body.name() + ".")))
        result.emplace(visit(body, name.starts_with(body.name() + ".") ? name.substr(body.name().size() + 1) : name));
    });
    if (!result) {
      std::string known;
      for_each([&](const auto& body) { known += (known.empty() ? "" : ", ") + body.name(); });
      throw std::invalid_argument("there is no side called \"" + name +
                                  "\": sides are named \"body.side\", and the bodies are " + known);
    }
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
  const auto& only() const requires(!detail::NamesBodies<Model>) { return std::get<0>(lists_).front(); }
  const auto& mesh() const requires(!detail::NamesBodies<Model>) { return only().mesh(); }
  const Kinematics& kinematics() const requires(!detail::NamesBodies<Model>) { return only().kinematics(); }
  const auto& material() const requires(!detail::NamesBodies<Model>) { return only().material(); }

  // --- The term: see BodyOf
  // -------------------------------------------------------------------------------------------

  void couple(SparsityPattern& pattern) const {
    for_each([&](const auto& body) { body.couple(pattern); });
  }
  void connect(const IndexMap& dofs, const Matrix& matrix) {
    for_each([&](auto& body) { body.connect(dofs, matrix); });
  }
  void extrapolate(Real share) {
    for_each([&](auto& body) { body.extrapolate(share); });
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
  static BodyDescriptions<Model> one(typename First::MeshType mesh,
                                     const typename First::Material& material) requires(one_type) {
    BodyDescriptions<Model> list(1);
    list[0].mesh = std::move(mesh);
    list[0].material = material;
    return list;
  }
  template <class List, class Visit>
  static void visit_list(List& list, Visit& visit) {
    for (auto& body : list) visit(body);
  }
  template <class List, class Described>
  void add_all(List& list, Described& described, const Kinematics& kinematics) {
    for (auto& d : described) {
      if constexpr (requires { d.material.validate(); }) d.material.validate();
      if constexpr (has_inertia<Model>)
        require::positive(d.density,
                          ((d.name.empty() ? "inertia" : "body \"" + d.name + "\"") + ": the density").c_str());
      Index first = nodes_;
      for_each([&](const auto& other) {
        if (other.name() == d.name)
          throw std::invalid_argument(
              "bodies: " + (d.name.empty() ? "one of several has no name" : "two are called \"" + d.name + "\""));
        if (d.nodes_of.empty() || other.name() != d.nodes_of) return;
        first = other.first_node();
        if (other.mesh().nodes != d.mesh.nodes)
          throw std::invalid_argument("body \"" + d.name + "\": its mesh does not have the nodes of body \"" +
                                      d.nodes_of + "\", which it is to share");
      });
      if (!d.nodes_of.empty() && first == nodes_)
        throw std::invalid_argument("body \"" + d.name + "\": there is no body \"" + d.nodes_of +
                                    "\" before it to share nodes with");
      const Index end = first + d.mesh.node_count();
      list.emplace_back(std::move(d.mesh), kinematics, d.material, d.name, first, cells_);
      if constexpr (has_inertia<Model>) densities_.push_back(d.density);
      nodes_ = std::max(nodes_, end);
      cells_ += list.back().mesh().cell_count();
      ++count_;
    }
  }
  // Throws where a node is in no cell of any body: its matrix row would be zero.
  void require_cells() const {
    std::vector<bool> listed(static_cast<std::size_t>(nodes_), false);
    for_each([&](const auto& body) {
      for (const auto& cell : body.mesh().cells)
        for (const Index n : cell) listed[static_cast<std::size_t>(body.first_node() + n)] = true;
    });
    for_each([&](const auto& body) {
      for (Index n = 0; n < body.mesh().node_count(); ++n)
        if (!listed[static_cast<std::size_t>(body.first_node() + n)])
          throw std::invalid_argument("body" + (body.name().empty() ? "" : " \"" + body.name() + "\"") + ": node " +
                                      std::to_string(n) + " of the mesh is in no cell");
    });
  }

  typename Lists::Stored lists_;
  std::vector<Point> joined_;  // of several bodies
  [[no_unique_address]] StoredIf<has_inertia<Model>, std::vector<Real>, Bodies> densities_;
  Index count_ = 0, nodes_ = 0, cells_ = 0;
  Real extent_ = 0;
};

/// The only body of a model that names no types of bodies; models that differ in contact, inertia or solver share it.
template <class Model>
using Body = detail::BodyOfType<Model, Model>;

}  // namespace stickslip
