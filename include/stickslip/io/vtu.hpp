// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/body/stress_recovery.hpp>
#include <stickslip/io/new_file.hpp>
#include <stickslip/problem.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace stickslip::io {

namespace detail {

inline std::string base64(std::span<const unsigned char> bytes) {
  static constexpr char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = std::uint32_t(bytes[i]) << 16;
    if (i + 1 < bytes.size()) word |= std::uint32_t(bytes[i + 1]) << 8;
    if (i + 2 < bytes.size()) word |= std::uint32_t(bytes[i + 2]);
    text += digit[word >> 18 & 63];
    text += digit[word >> 12 & 63];
    text += i + 1 < bytes.size() ? digit[word >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digit[word & 63] : '=';
  }
  return text;
}

// Writes a VTK data array in binary form: the byte count, then the numbers.
template <class T>
void write_array(std::ostream& out, const char* type, const std::string& name, int components,
                 const std::vector<T>& values) {
  const std::uint64_t bytes = values.size() * sizeof(T);
  std::vector<unsigned char> data(sizeof(bytes) + bytes);
  std::memcpy(data.data(), &bytes, sizeof(bytes));
  if (bytes > 0) std::memcpy(data.data() + sizeof(bytes), values.data(), bytes);
  out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
      << "\" format=\"binary\">" << base64(data) << "</DataArray>\n";
}

// The text escaped for an attribute value in quotation marks.
inline std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\t':
        out += "&#9;";
        break;
      case '\n':
        out += "&#10;";
        break;
      case '\r':
        out += "&#13;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// Whether the text is valid in XML: UTF-8, below U+0020 only tab, line feed and carriage return.
inline bool is_xml_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto at = [&](std::size_t k) -> std::uint32_t {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    const std::uint32_t first = at(0);
    const std::size_t length = first < 0x80         ? 1
                               : first >> 5 == 0x6  ? 2
                               : first >> 4 == 0xe  ? 3
                               : first >> 3 == 0x1e ? 4
                                                    : 0;
    if (length == 0) return false;
    static constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000}, mask{0, 0x7f, 0x1f, 0x0f, 0x07};
    std::uint32_t code = first & mask[length];
    for (std::size_t k = 1; k < length; ++k) {
      if (at(k) >> 6 != 2) return false;
      code = code << 6 | (at(k) & 0x3f);
    }
    const bool blank = code == 0x9 || code == 0xa || code == 0xd;
    if (code < least[length] || (code < 0x20 && !blank) || (code >= 0xd800 && code < 0xe000) || code == 0xfffe ||
        code == 0xffff || code > 0x10ffff)
      return false;
    i += length;
  }
  return true;
}

}  // namespace detail

namespace detail {

// Means over the points of the cells of all bodies, in their order.
struct CellMeans {
  std::vector<Real> stress, mises, pressure, plastic_strain, error, body;
  bool plastic = false;

  template <class Body>
  void add(const Body& body_, const Field& u, Index number) {
    using TensorPattern = typename Body::TensorPattern;
    const std::size_t cells = body_.mesh().cells.size(), first = mises.size();
    for (std::vector<Real>* list : {&mises, &pressure}) list->resize(first + cells, 0.0);
    stress.resize(6 * (first + cells), 0.0);
    // Not a number where the material has no plastic strain.
    constexpr bool flows = requires(typename Body::State s) {
      s.plastic_strain;
    };
    plastic_strain.resize(first + cells, flows ? 0.0 : std::numeric_limits<Real>::quiet_NaN());
    plastic = plastic || flows;
    body.resize(first + cells, Real(number));
    StressRecovery<Body> recovery(body_);
    recovery.update(body_, u);
    std::vector<Real> volume(cells, 0.0);
    body_.visit_points(u, [&](Index cell, int point, const auto&, const auto& state, Real weight) {
      const std::size_t e = first + static_cast<std::size_t>(cell);
      const Tensor<Real, TensorPattern>& cauchy = recovery.stress(cell, point);
      static constexpr std::array<std::pair<int, int>, 6> order{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
      for (std::size_t k = 0; k < order.size(); ++k)
        if (TensorPattern::couples(order[k].first, order[k].second))
          stress[6 * e + k] += weight * cauchy(order[k].first, order[k].second);
      mises[e] += weight * von_mises(cauchy);
      pressure[e] -= weight * trace(cauchy) / 3;
      if constexpr (flows) plastic_strain[e] += weight * state.plastic_strain;
      volume[static_cast<std::size_t>(cell)] += weight;
    });
    for (std::size_t k = 0; k < cells; ++k) {
      const std::size_t e = first + k;
      for (std::size_t i = 0; i < 6; ++i) stress[6 * e + i] /= volume[k];
      mises[e] /= volume[k];
      pressure[e] /= volume[k];
      if constexpr (flows) plastic_strain[e] /= volume[k];
    }
    error.insert(error.end(), recovery.cells().begin(), recovery.cells().end());
  }
};

// Writes bodies at the displacements u [length]; `contacts` is empty, or all of them.
template <class BodiesType>
void write_vtu(const std::filesystem::path& path, const BodiesType& bodies, const Field& u, bool with_contact,
               const std::vector<const ContactRecord<BodiesType::dim>*>& contacts) {
  static_assert(std::endian::native == std::endian::little, "the file says that its numbers are little-endian");
  constexpr int dim = BodiesType::dim;
  const auto& positions = bodies.positions();
  const std::size_t nodes = positions.size(), cells = static_cast<std::size_t>(bodies.cell_count());

  std::vector<Real> points(3 * nodes, 0.0), displacement(3 * nodes, 0.0);
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = 0; i < dim; ++i) {
      points[3 * n + i] = positions[n][static_cast<int>(i)];
      displacement[3 * n + i] = u[static_cast<Index>(n) * dim + static_cast<int>(i)];
    }

  std::vector<std::int64_t> connectivity, offsets;
  CellMeans means;
  Index number = 0;
  bodies.for_each([&](const auto& body) {
    constexpr int nodes_per_cell = std::remove_cvref_t<decltype(body)>::MeshType::nodes_per_cell;
    static_assert((dim == 2 && nodes_per_cell == 4) || (dim == 3 && nodes_per_cell == 8),
                  "the cell types below are VTK's quadrilateral and hexahedron");
    for (const auto& cell : body.mesh().cells) {
      for (const Index n : cell) connectivity.push_back(body.first_node() + n);
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    }
    means.add(body, u, number++);
  });
  const std::vector<std::uint8_t> types(cells, dim == 2 ? 9 : 12);

  NewFile file(path);
  std::ostream& out = file.stream();
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n"
      << "<UnstructuredGrid><Piece NumberOfPoints=\"" << nodes << "\" NumberOfCells=\"" << cells << "\">\n<Points>\n";
  write_array(out, "Float64", "points", 3, points);
  out << "</Points>\n<Cells>\n";
  write_array(out, "Int64", "connectivity", 1, connectivity);
  write_array(out, "Int64", "offsets", 1, offsets);
  write_array(out, "UInt8", "types", 1, types);
  out << "</Cells>\n<PointData Vectors=\"displacement\">\n";
  write_array(out, "Float64", "displacement", 3, displacement);
  if (with_contact) {
    std::vector<Real> force(3 * nodes, 0.0), traction(3 * nodes, 0.0), slip(nodes, 0.0),
        gap(nodes, std::numeric_limits<Real>::infinity());
    for (const ContactRecord<dim>* pair : contacts) {
      const std::vector<Real> areas = bodies.side_areas(pair->side());
      for (std::size_t k = 0; k < pair->nodes().size(); ++k) {
        const Index node = pair->nodes()[k];
        const auto n = static_cast<std::size_t>(node);
        const ContactNodeState<dim>& state = pair->states()[k];
        for (std::size_t i = 0; i < dim; ++i) {
          force[3 * n + i] += state.force[static_cast<int>(i)];
          traction[3 * n + i] += state.force[static_cast<int>(i)] / areas[k];
        }
        slip[n] = std::max(slip[n], state.accumulated_slip);
        gap[n] = std::min(gap[n], state.gap);
      }
    }
    for (Real& g : gap)
      if (std::isinf(g)) g = std::numeric_limits<Real>::quiet_NaN();
    write_array(out, "Float64", "contact_force", 3, force);
    write_array(out, "Float64", "contact_traction", 3, traction);
    write_array(out, "Float64", "slip", 1, slip);
    write_array(out, "Float64", "gap", 1, gap);
  }
  out << "</PointData>\n<CellData>\n";
  write_array(out, "Float64", "cauchy_stress", 6, means.stress);
  write_array(out, "Float64", "von_mises_stress", 1, means.mises);
  write_array(out, "Float64", "pressure", 1, means.pressure);
  if (means.plastic) write_array(out, "Float64", "plastic_strain", 1, means.plastic_strain);
  write_array(out, "Float64", "stress_error", 1, means.error);
  if (bodies.count() > 1) write_array(out, "Float64", "body", 1, means.body);
  out << "</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n";
  file.place();
}

}  // namespace detail

/// Writes the converged state as a VTK unstructured grid: reference coordinates; at nodes displacement, contact force
/// [force], contact traction [force / reference area], accumulated slip and gap [length] (NaN at nodes of no contact);
/// in cells the means over the points of Cauchy stress (order xx yy zz xy yz xz), von Mises stress, pressure, the
/// estimated error of the mesh in the stress (theory.md, eq. 6.20), where a material has it plastic strain (NaN in the
/// bodies of others), and of several bodies the number of the cell's, from 0 in the order of their numbering. In
/// axisymmetry x is the radius, y the axis and z the hoop direction. Throws std::runtime_error, naming the file and the
/// reason, if it cannot be written; the old file is then unchanged (NewFile).
template <class Model>
void write_vtu(const std::filesystem::path& path, const Scene<Model>& problem) {
  std::vector<const ContactRecord<Scene<Model>::dim>*> contacts;
  if constexpr (has_contact<Model>) problem.visit_contacts([&](const auto& pair) { contacts.push_back(&pair); });
  detail::write_vtu(path, problem.bodies(), problem.displacement(), has_contact<Model>, contacts);
}

/// A series of states over time: `DIR/NAME_0000.vtu` and so on, with `DIR/NAME.pvd` to open in ParaView. The collection
/// is rewritten after every state, so that an interrupted run leaves a valid one.
class VtuSeries {
 public:
  /// Creates the folder. `name` is the prefix of the file names and stands in XML: UTF-8 without a slash. Throws
  /// std::invalid_argument if it is not, std::runtime_error, naming the folder, if the folder cannot be created.
  VtuSeries(std::filesystem::path directory, std::string name)
      : directory_(std::move(directory)), name_(std::move(name)) {
    if (name_.find('/') != name_.npos || !detail::is_xml_text(name_))
      throw std::invalid_argument(
          "a VTU series: its name must be text in UTF-8 without slashes and control characters");
    std::error_code error;
    std::filesystem::create_directories(directory_, error);
    if (error) throw std::runtime_error("cannot write " + directory_.string() + ": " + error.message());
  }

  /// Writes the converged state as the next of the series. Throws std::runtime_error, naming the file and the reason,
  /// if it cannot be written; the next call then reuses its number.
  template <class Model>
  void write(const Scene<Model>& problem) {
    write_vtu(directory_ / file(times_.size()), problem);
    times_.push_back(problem.time());
    write_collection();
  }

  /// The times of the states so far, for io::save: a restarted run overwrites the later states.
  void serialize(Archive& archive) { archive.resizable("series, times", times_); }

 private:
  void write_collection() const {
    NewFile collection(directory_ / (name_ + ".pvd"));
    std::ostream& out = collection.stream();
    out.precision(17);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n<Collection>\n";
    for (std::size_t k = 0; k < times_.size(); ++k)
      out << "<DataSet timestep=\"" << times_[k] << "\" part=\"0\" file=\"" << detail::escaped(file(k)) << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
    collection.place();
  }
  std::string file(std::size_t k) const {
    std::string number = std::to_string(k);
    number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
    return name_ + "_" + number + ".vtu";
  }

  std::filesystem::path directory_;
  std::string name_;
  std::vector<Real> times_;
};

}  // namespace stickslip::io
