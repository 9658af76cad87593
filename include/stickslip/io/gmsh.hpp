// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/element/hex8.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/io/text.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/tensor/tensor.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stickslip::io {

namespace detail {

// Gmsh's first-order elements.
struct GmshType {
  int number, dim;
  std::size_t nodes;
  const char *one, *many;
};
inline constexpr std::array<GmshType, 8> gmsh_types{{{15, 0, 1, "a point", "points"},
                                                     {1, 1, 2, "a line", "lines"},
                                                     {2, 2, 3, "a triangle", "triangles"},
                                                     {3, 2, 4, "a quadrilateral", "quadrilaterals"},
                                                     {4, 3, 4, "a tetrahedron", "tetrahedra"},
                                                     {5, 3, 8, "a hexahedron", "hexahedra"},
                                                     {6, 3, 6, "a prism", "prisms"},
                                                     {7, 3, 5, "a pyramid", "pyramids"}}};

// Contents of a Gmsh file, not yet checked to be a mesh.
struct GmshFile {
  using Tag = std::int64_t;
  struct Node {
    Tag tag;
    Vec<Real, 3> x;
    std::size_t line;
  };
  struct Element {
    const GmshType* type;
    Tag entity;  // format 2.2: the physical group
    std::array<Tag, 8> nodes;
    std::size_t line;
    Tag elementary;  // format 2.2: the entity; format 4.1: the same as `entity`
  };
  using Key = std::pair<int, Tag>;  // dimension, number

  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::map<Key, std::vector<Tag>> groups;  // groups of an entity
  std::map<Key, std::string> names;        // name of a group
  std::set<Key> entities;                  // format 4.1: all entities of the file
};

class GmshParser : public Text {
 public:
  GmshParser(std::string name, std::string_view bytes) : Text(std::move(name), without_mark(bytes)) {}

  GmshFile read() {
    for (std::string_view section = word(); !section.empty(); section = word()) {
      if (section.front() != '$') unexpected(section, "a section, such as \"$Nodes\",");
      if (version_ == Version::unknown && section != "$MeshFormat" && section != "$Comments")
        fail("found \"" + shown(section) + "\" where a Gmsh file has \"$MeshFormat\"");
      if (section == "$MeshFormat")
        format();
      else if (section == "$PhysicalNames")
        names();
      else if (section == "$Entities")
        entities(false);
      else if (section == "$PartitionedEntities")
        entities(true);
      else if (section == "$Nodes" || section == "$ParametricNodes")
        version_ == Version::v2 ? nodes_v2(section == "$ParametricNodes") : nodes();
      else if (section == "$Elements")
        version_ == Version::v2 ? elements_v2() : elements();
      else {
        skip(section);
        continue;
      }
      const std::string_view kind = section == "$ParametricNodes" ? "$Nodes" : section;
      if (!seen_.insert(std::string(kind)).second) fail("the section " + std::string(section) + " is there twice");
      const std::string end = "$End" + std::string(section.substr(1));
      if (const std::string_view found = word(); found != end) unexpected(found, "\"" + end + "\"");
    }
    if (version_ == Version::unknown) fail("the file ends where a Gmsh file has \"$MeshFormat\"");
    return std::move(file_);
  }

 private:
  using Tag = GmshFile::Tag;
  enum class Version { unknown, v2, v4 };
  // Every element of an entity is in all of its groups: without this limit memory grows with the product of both.
  static constexpr Tag most_groups = 32;
  static constexpr Tag largest = std::numeric_limits<Tag>::max();

  Tag count(const char* wanted) { return integer<Tag>(word(), 0, largest, wanted); }
  Tag tag(const char* wanted) { return integer<Tag>(word(), -largest, largest, wanted); }
  int dimension(const char* wanted) { return integer<int>(word(), 0, 3, wanted); }
  // A negative number marks a group oriented against its entity.
  static Tag group(Tag number) { return number < 0 ? -number : number; }
  // A false count does no harm: `read` throws at the end of the file.
  template <class Read>
  static void times(Tag n, Read&& read) {
    for (Tag i = 0; i < n; ++i) read();
  }

  void format() {
    const std::string_view version = word();
    if (version != "4.1" && version != "2.2")
      fail("this is Gmsh's format \"" + shown(version) + "\"; 4.1 and 2.2 can be read (in Gmsh: Mesh.MshFileVersion)");
    version_ = version == "2.2" ? Version::v2 : Version::v4;
    if (integer<int>(word(), 0, 1, "the kind of file") == 1)
      fail("the file is binary; save it as ASCII (in Gmsh: Mesh.Binary = 0)");
    count("the size of numbers");
  }

  void skip(std::string_view section) {
    const std::string end = "$End" + std::string(section.substr(1));
    const std::size_t begin = line();
    for (std::string_view found = word(); found != end; found = word())
      if (found.empty()) fail(begin, "the section " + shown(section) + " has no end");
  }

  void names() {
    times(count("the number of names"), [&] {
      const int dim = dimension("the dimension of a group");
      const Tag number = group(tag("the number of a group"));
      const std::string_view rest = rest_of_line();
      const std::size_t first = rest.find('"'), last = rest.find('"', first + 1);
      if (first == rest.npos || last == rest.npos) fail("the name of a group must stand in quotation marks");
      file_.names[{dim, number}] = rest.substr(first + 1, last - first - 1);
    });
  }

  // The elements of a partitioned mesh belong to partitioned entities. Each lies on another entity, its parent, and
  // repeats the parent's groups; one of lower dimension than its parent is an interface between partitions and is put
  // into no group.
  void entities(bool partitioned) {
    if (partitioned) {
      count("the number of partitions");
      times(count("the number of ghost entities"), [&] {
        tag("the number of a ghost entity");
        tag("the number of a partition");
      });
    }
    std::array<Tag, 4> counts{};
    for (Tag& n : counts) n = count("a number of entities");
    for (int dim = 0; dim < 4; ++dim)
      times(counts[static_cast<std::size_t>(dim)], [&] {
        const Tag number = tag("the number of an entity");
        int parent = dim;
        if (partitioned) {
          parent = integer<int>(word(), -1, 3, "the dimension of an entity");
          tag("the number of an entity");
          times(count("a number of partitions"), [&] { tag("the number of a partition"); });
        }
        for (int i = 0; i < (dim == 0 ? 3 : 6); ++i) real(word(), "a coordinate of an entity");
        const Tag groups = count("a number of groups");
        if (groups > most_groups)
          fail("an entity belongs to " + std::to_string(groups) + " groups, more than the " +
               std::to_string(most_groups) + " that can be read");
        std::vector<Tag> list;
        times(groups, [&] { list.push_back(group(tag("the number of a group"))); });
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        if (!list.empty() && parent <= dim) file_.groups[{dim, number}] = std::move(list);
        file_.entities.insert({dim, number});
        if (dim > 0) times(count("a number of entities"), [&] { tag("the number of an entity"); });
      });
  }

  void add_node(Tag number, const Vec<Real, 3>& x, std::size_t at) { file_.nodes.push_back({number, x, at}); }
  Vec<Real, 3> place() {
    Vec<Real, 3> x;
    for (Real& component : x) component = real(word(), "a coordinate");
    return x;
  }

  void nodes() {
    const Tag blocks = count("the number of blocks"), total = count("the number of nodes");
    for (int i = 0; i < 2; ++i) count("the number of a node");  // the lowest and the highest
    times(blocks, [&] {
      const int dim = dimension("the dimension of a block of nodes");
      tag("the number of an entity");
      const bool parametric = integer<int>(word(), 0, 1, "whether there are parameters") == 1;
      const Tag here = count("the number of nodes in a block");
      const std::size_t first = file_.nodes.size();
      times(here, [&] { add_node(count("the number of a node"), Vec<Real, 3>::Zero(), line()); });
      for (std::size_t n = first; n < file_.nodes.size(); ++n) {
        file_.nodes[n].x = place();
        file_.nodes[n].line = line();
        if (parametric)
          for (int i = 0; i < dim; ++i) real(word(), "a parameter of a node");
      }
    });
    check_total(total, file_.nodes.size(), "nodes");
  }

  void nodes_v2(bool parametric) {
    times(count("the number of nodes"), [&] {
      const Tag number = count("the number of a node");
      const std::size_t at = line();
      add_node(number, place(), at);
      if (!parametric) return;
      const int dim = dimension("the dimension of an entity");
      tag("the number of an entity");
      for (int i = 0; i < (dim < 3 ? dim : 0); ++i) real(word(), "a parameter of a node");  // volumes have none
    });
  }

  const GmshType& type() {
    const int number = integer<int>(word(), 1, std::numeric_limits<int>::max(), "the type of an element");
    for (const GmshType& t : gmsh_types)
      if (t.number == number) return t;
    fail("elements of type " + std::to_string(number) +
         " cannot be read, only those of first order (in Gmsh: Mesh.ElementOrder = 1)");
  }
  void element_nodes(GmshFile::Element element) {
    for (std::size_t a = 0; a < element.type->nodes; ++a) element.nodes[a] = count("the number of a node");
    file_.elements.push_back(element);
  }

  void elements() {
    const Tag blocks = count("the number of blocks"), total = count("the number of elements");
    for (int i = 0; i < 2; ++i) count("the number of an element");  // the lowest and the highest
    times(blocks, [&] {
      const int dim = dimension("the dimension of a block of elements");
      const Tag entity = tag("the number of an entity");
      const GmshType& kind = type();
      if (kind.dim != dim) fail(std::string(kind.one) + " cannot have dimension " + std::to_string(dim));
      times(count("the number of elements in a block"), [&] {
        count("the number of an element");
        element_nodes({&kind, entity, {}, line(), entity});
      });
    });
    check_total(total, file_.elements.size(), "elements");
  }

  void elements_v2() {
    times(count("the number of elements"), [&] {
      count("the number of an element");
      const std::size_t at = line();
      const GmshType& kind = type();
      Tag physical = 0, elementary = 0;
      const Tag tags = count("the number of tags");
      for (Tag i = 0; i < tags; ++i) {  // the others are partitions
        const Tag value = tag("a tag of an element");
        if (i == 0) physical = group(value);
        if (i == 1) elementary = value;
      }
      if (physical != 0) file_.groups[{kind.dim, physical}] = {physical};
      element_nodes({&kind, physical, {}, at, elementary});
    });
  }

  void check_total(Tag claimed, std::size_t found, const char* what) const {
    if (static_cast<std::size_t>(claimed) != found)
      fail("the blocks have " + std::to_string(found) + ' ' + what + ", the section claims " + std::to_string(claimed));
  }

  GmshFile file_;
  Version version_ = Version::unknown;
  std::set<std::string> seen_;
};

// Element types, facets and orientation for two and three dimensions.
template <int dim>
struct GmshCells;
template <>
struct GmshCells<2> {
  using Cell = Quad4;
  using TensorPattern = Planar;
  static constexpr int type = 3, facet_type = 1;
  static constexpr const char *facet = "edge", *nameless[] = {"point ", "curve "};
  // Counter-clockwise.
  static constexpr std::array<std::array<std::size_t, 2>, 4> facets{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  static constexpr std::array<std::size_t, 4> turned{0, 3, 2, 1};
  using Facet = std::array<Index, 2>;
  static Facet reversed(const Facet& f) { return {f[1], f[0]}; }
  static Facet canonical(const Facet& f) { return f; }
};
template <>
struct GmshCells<3> {
  using Cell = Hex8;
  using TensorPattern = Spatial;
  static constexpr int type = 5, facet_type = 3;
  static constexpr const char *facet = "face", *nameless[] = {"point ", "curve ", "surface "};
  // Counter-clockwise viewed from outside.
  static constexpr std::array<std::array<std::size_t, 4>, 6> facets{
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  static constexpr std::array<std::size_t, 8> turned{4, 5, 6, 7, 0, 1, 2, 3};
  using Facet = std::array<Index, 4>;
  static Facet reversed(const Facet& f) { return {f[0], f[3], f[2], f[1]}; }
  // The same cycle of nodes, begun at the lowest number.
  static Facet canonical(Facet f) {
    std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    return f;
  }
};

template <int dim>
class GmshMesh {
 public:
  using Traits = GmshCells<dim>;
  static constexpr int nodes_per_cell = Traits::Cell::nodes;
  using MeshType = Mesh<dim, nodes_per_cell>;

  GmshMesh(const GmshFile& file, const Text& text) : file_(file), text_(text) {}

  MeshType make() {
    sort_tags();
    find_repeated();
    add_nodes();
    add_cells();
    connect();
    add_blocks();
    add_sides();
    return std::move(mesh_);
  }

 private:
  using Element = GmshFile::Element;
  using Facet = typename Traits::Facet;
  static constexpr Index unused = -1, used = -2;

  // A facet of a cell; `key` lists its nodes in ascending order, the same for both cells that share it.
  struct CellFacet {
    Facet key, walk;
    std::size_t line;
  };

  static const GmshType& cell_type() {
    return *std::find_if(gmsh_types.begin(), gmsh_types.end(), [](const auto& t) { return t.number == Traits::type; });
  }
  static Facet key_of(Facet f) {
    std::sort(f.begin(), f.end());
    return f;
  }

  void sort_tags() {
    for (std::size_t n = 0; n < file_.nodes.size(); ++n) places_.push_back({file_.nodes[n].tag, n});
    std::sort(places_.begin(), places_.end());
    for (std::size_t n = 1; n < places_.size(); ++n)
      if (places_[n].first == places_[n - 1].first)
        text_.fail(file_.nodes[places_[n].second].line, "there are two nodes " + std::to_string(places_[n].first));
  }
  // Index in the file of the node `tag`.
  std::size_t place(GmshFile::Tag tag, std::size_t line) const {
    const auto found = std::lower_bound(places_.begin(), places_.end(), std::pair<GmshFile::Tag, std::size_t>(tag, 0));
    if (found == places_.end() || found->first != tag) text_.fail(line, "there is no node " + std::to_string(tag));
    return found->second;
  }

  // Format 2.2 repeats a cell for each of its groups. Equal cells of one entity in one group are a fault of the mesh.
  void find_repeated() {
    repeated_.assign(file_.elements.size(), false);
    std::map<GmshFile::Tag, GmshFile::Tag> group_of;
    bool several = false;
    for (const Element& e : file_.elements)
      if (e.type->dim == dim && e.entity != e.elementary)
        several = several || group_of.try_emplace(e.elementary, e.entity).first->second != e.entity;
    if (!several) return;
    using Key = std::pair<GmshFile::Tag, std::array<GmshFile::Tag, 8>>;  // entity, nodes in ascending order
    std::map<Key, GmshFile::Tag> first;                                  // group of its first appearance
    for (std::size_t k = 0; k < file_.elements.size(); ++k) {
      const Element& e = file_.elements[k];
      if (e.type->dim != dim) continue;
      Key key{e.elementary, e.nodes};
      std::sort(key.second.begin(), key.second.end());
      const auto [at, fresh] = first.try_emplace(key, e.entity);
      repeated_[k] = !fresh && at->second != e.entity;
    }
  }

  // Only nodes of cells, in the order of the file: the others would have no stiffness.
  void add_nodes() {
    number_.assign(file_.nodes.size(), unused);
    std::size_t cells = 0;
    for (const Element& e : file_.elements) {
      if (e.type->dim < dim) continue;
      if (e.type->dim > dim)
        text_.fail(e.line, std::string(e.type->one) + " has no place in a mesh in the plane; read it in space");
      if (e.type->number != Traits::type)
        text_.fail(e.line, std::string(e.type->one) + "; all cells must be " + cell_type().many +
                               (dim == 2 ? " (in Gmsh: Mesh.RecombineAll = 1)" : ""));
      for (std::size_t a = 0; a < e.type->nodes; ++a) number_[place(e.nodes[a], e.line)] = used;
      ++cells;
    }
    if (cells == 0)
      text_.fail_whole(std::string("there are no ") + cell_type().many +
                       "; Gmsh saves what belongs to a physical group, or all with Mesh.SaveAll = 1");
    const GmshFile::Node* first = nullptr;
    Real extent = 0, height = 0;
    const GmshFile::Node* highest = nullptr;
    for (std::size_t n = 0; n < file_.nodes.size(); ++n) {
      if (number_[n] == unused) continue;
      const GmshFile::Node& node = file_.nodes[n];
      if (mesh_.nodes.size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max() / dim))
        text_.fail(node.line, "more nodes than can be numbered");
      number_[n] = mesh_.node_count();
      mesh_.nodes.push_back(node.x.template head<dim>());
      if (!first) first = highest = &node;
      extent = std::max(extent, (node.x - first->x).template head<2>().cwiseAbs().maxCoeff());
      if (const Real h = std::abs(node.x[2] - first->x[2]); h > height) height = h, highest = &node;
    }
    if (dim == 2 && height > 1e-9 * extent)
      text_.fail(highest->line, "node " + std::to_string(highest->tag) + " lies outside the plane of node " +
                                    std::to_string(first->tag) + "; a plane mesh has one z");
  }

  void add_cells() {
    const auto rule = Traits::Cell::quadrature();
    cell_.assign(file_.elements.size(), unused);
    for (std::size_t k = 0; k < file_.elements.size(); ++k) {
      const Element& e = file_.elements[k];
      if (e.type->dim != dim || repeated_[k]) continue;
      typename decltype(mesh_.cells)::value_type cell{};
      Mat<Real, nodes_per_cell, dim> X;
      for (std::size_t a = 0; a < cell.size(); ++a) {
        cell[a] = number_[place(e.nodes[a], e.line)];
        if (std::find(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(a), cell[a]) !=
            cell.begin() + static_cast<std::ptrdiff_t>(a))
          text_.fail(e.line, "the cell names node " + std::to_string(e.nodes[a]) + " twice");
        X.row(static_cast<int>(a)) = mesh_.nodes[static_cast<std::size_t>(cell[a])].transpose();
      }
      std::size_t positive = 0, negative = 0;
      for (const auto& point : rule) {
        const Mat<Real, dim> block = X.transpose() * Traits::Cell::gradient(point.xi);
        auto jacobian = Tensor<Real, typename Traits::TensorPattern>::identity();
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j) jacobian(i, j) = block(i, j);
        const Real volume = determinant(jacobian);
        positive += volume > 0 && std::isfinite(volume);
        negative += volume < 0 && std::isfinite(volume);
      }
      if (negative == rule.size()) {
        const auto as_read = cell;
        for (std::size_t a = 0; a < cell.size(); ++a) cell[a] = as_read[Traits::turned[a]];
      } else if (positive != rule.size()) {
        text_.fail(e.line, std::string("the cell is folded, flat or beyond all size: the Jacobian of ") +
                               cell_type().one + " must have one sign at all quadrature points");
      }
      cell_[k] = mesh_.cell_count();
      mesh_.cells.push_back(cell);
      for (const auto& local : Traits::facets) {
        Facet walk{};
        for (std::size_t n = 0; n < walk.size(); ++n) walk[n] = cell[local[n]];
        facets_.push_back({key_of(walk), walk, e.line});
      }
    }
  }

  // Neighbouring cells traverse their common facet in opposite directions.
  void connect() {
    std::sort(facets_.begin(), facets_.end(),
              [](const CellFacet& a, const CellFacet& b) { return a.key != b.key ? a.key < b.key : a.line < b.line; });
    for (std::size_t i = 1; i < facets_.size(); ++i) {
      const CellFacet &a = facets_[i - 1], &b = facets_[i];
      if (a.key != b.key) continue;
      const std::string first = std::to_string(a.line);
      if (i > 1 && facets_[i - 2].key == a.key)
        text_.fail(b.line, std::string("the cell is the third at one ") + Traits::facet + ", see line " + first);
      if (Traits::canonical(a.walk) != Traits::canonical(Traits::reversed(b.walk)))
        text_.fail(b.line,
                   "the cell and that of line " + first + " lie on the same side of their common " + Traits::facet);
    }
  }

  // Name of the side of a group.
  std::string name_of(const GmshFile::Key& group) const {
    const auto found = file_.names.find(group);
    if (found != file_.names.end() && !found->second.empty()) return found->second;
    return Traits::nameless[group.first] + std::to_string(group.second);
  }

  // Named groups of cells are blocks. A cell that format 2.2 repeats is the one before it with its nodes.
  void add_blocks() {
    std::map<std::array<GmshFile::Tag, 8>, Index> number;
    for (std::size_t k = 0; k < file_.elements.size(); ++k) {
      const Element& e = file_.elements[k];
      if (e.type->dim != dim) continue;
      auto key = e.nodes;
      std::sort(key.begin(), key.end());
      const Index cell = cell_[k] == unused ? number.at(key) : number[key] = cell_[k];
      const auto groups = file_.groups.find({dim, e.entity});
      if (groups == file_.groups.end()) continue;
      for (const GmshFile::Tag group : groups->second)
        if (const auto name = file_.names.find({dim, group}); name != file_.names.end() && !name->second.empty()) {
          std::vector<Index>& block = mesh_.blocks[name->second];
          if (block.empty() || block.back() != cell) block.push_back(cell);
        }
    }
  }

  void add_sides() {
    std::map<GmshFile::Key, std::vector<const Element*>> members;
    for (const Element& e : file_.elements) {
      if (e.type->dim >= dim) continue;
      const GmshFile::Key entity{e.type->dim, e.entity};
      if (!file_.entities.empty() && file_.entities.count(entity) == 0)
        text_.fail(e.line, std::string(e.type->one) + " of the " + Traits::nameless[e.type->dim] +
                               std::to_string(e.entity) +
                               ", which the file does not list, so that its groups are lost");
      const auto groups = file_.groups.find(entity);
      if (groups == file_.groups.end()) continue;
      for (const GmshFile::Tag group : groups->second) members[{e.type->dim, group}].push_back(&e);
    }
    for (const auto& [group, name] : file_.names)
      if (group.first < dim && members.count(group) == 0)
        text_.fail_whole("the group \"" + shown(name, 60) +
                         "\" has a name but no elements; format 2.2 loses groups with Mesh.SaveAll = 1, and a mesh "
                         "that is saved in pieces has in each file some");
    for (const auto& [group, elements] : members) {
      const std::string name = name_of(group);
      const auto [at, fresh] = mesh_.sides.try_emplace(name);
      if (!fresh) text_.fail(elements[0]->line, "two groups are called \"" + shown(name, 60) + "\"");
      fill(at->second, elements, group.first, name);
    }
  }

  void fill(Side<dim>& side, const std::vector<const Element*>& elements, int group_dim, const std::string& name) {
    const std::string whose = " of the group \"" + shown(name, 60) + "\"";
    std::set<Facet> given;
    std::set<Index> listed;
    const auto list = [&](Index node) {
      if (listed.insert(node).second) side.nodes.push_back(node);
    };
    for (const Element* e : elements) {
      std::array<Index, 8> nodes{};
      for (std::size_t a = 0; a < e->type->nodes; ++a) {
        nodes[a] = number_[place(e->nodes[a], e->line)];
        if (nodes[a] == unused)
          text_.fail(e->line, "node " + std::to_string(e->nodes[a]) + whose + " belongs to no cell");
      }
      if (group_dim < dim - 1) {
        for (std::size_t a = 0; a < e->type->nodes; ++a) list(nodes[a]);
        continue;
      }
      if (e->type->number != Traits::facet_type)
        text_.fail(e->line, std::string(e->type->one) + whose + " can be no " + Traits::facet + " of a cell");
      Facet facet{};
      std::copy_n(nodes.begin(), facet.size(), facet.begin());
      const Facet key = key_of(facet);
      const auto found = std::lower_bound(facets_.begin(), facets_.end(), key,
                                          [](const CellFacet& f, const Facet& k) { return f.key < k; });
      const std::string which = std::string("the ") + Traits::facet + whose;
      if (found == facets_.end() || found->key != key) text_.fail(e->line, which + " belongs to no cell");
      if (const auto next = std::next(found); next != facets_.end() && next->key == key)
        text_.fail(e->line, which + " lies inside the body; sides are on its boundary");
      if (!given.insert(key).second) text_.fail(e->line, which + " is there twice");
      side.facets.push_back(found->walk);
      for (const Index node : found->walk) list(node);
    }
  }

  const GmshFile& file_;
  const Text& text_;
  MeshType mesh_;
  std::vector<std::pair<GmshFile::Tag, std::size_t>> places_;  // index in the file, sorted by tag
  std::vector<Index> number_;                                  // node of the mesh, by index in the file
  std::vector<CellFacet> facets_;
  std::vector<Index> cell_;     // of the mesh, by element of the file
  std::vector<bool> repeated_;  // for each element of the file: an earlier one is the same cell
};

template <int dim>
typename GmshMesh<dim>::MeshType read_gmsh(std::string_view bytes, const std::string& name) {
  GmshParser parser(name, bytes);
  const GmshFile file = parser.read();
  return GmshMesh<dim>(file, parser).make();
}

}  // namespace detail

/// Reads a mesh from a Gmsh file (MSH 4.1 or 2.2, ASCII): quadrilaterals with dim 2, in the x-y plane, hexahedra with
/// dim 3. `name` stands for the file in messages.
///
/// Physical groups of curves in the plane and of surfaces in space become sides with their names, or "curve 7" without
/// one; facets are oriented as `Side` requires and must lie on the boundary. Groups of lower dimension become sides of
/// nodes without facets, which can be held but not loaded. The order of the file is kept; nodes without a cell and
/// boundary elements without a group are dropped. Cells that are numbered clockwise (in space: mirrored) are reversed.
/// A partitioned mesh is read as a whole; parameters of nodes are ignored; a cell that format 2.2 repeats for each of
/// its groups is one cell. Coincident nodes, as of blocks that were not merged, stay separate. A run of such a mesh
/// warns of them (mesh/coincident_nodes.hpp).
///
/// Throws std::runtime_error, naming file and line, if the file cannot be read, is malformed, or is no valid mesh:
/// cells of another type, folded or overlapping. Memory is proportional to the size of the file, independent of the
/// counts in it.
template <int dim>
Mesh<dim, detail::GmshMesh<dim>::nodes_per_cell> read_gmsh(std::istream& in, const std::string& name) {
  return detail::read_gmsh<dim>(detail::read_all(in, name), name);
}

/// The same from a file.
template <int dim>
Mesh<dim, detail::GmshMesh<dim>::nodes_per_cell> read_gmsh(const std::filesystem::path& path) {
  return detail::read_gmsh<dim>(detail::read_all(path), path.string());
}

}  // namespace stickslip::io
