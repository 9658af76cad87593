// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/triangles.hpp>
#include <stickslip/io/new_file.hpp>
#include <stickslip/io/text.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <istream>
#include <limits>
#include <map>
#include <ostream>
#include <queue>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stickslip::io {

/// Which data define the outside of a triangle: the order of its corners by the right-hand rule, its normal in the
/// file, or `agreed`: both, which must be consistent as the format requires.
enum class Outside { agreed, corners, normals };

namespace detail {

// Contents of a file: three corners per triangle, not shared between triangles, and one normal per triangle, of any
// length or NaN.
struct Facets {
  std::vector<Vec<Real, 3>> corners, normals;
  std::vector<std::size_t> places;  // lines (ASCII) or bytes (binary) of the triangles
  const char* place = "line";
};

inline std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

// Words of an ASCII STL file, without regard to case.
class StlWords : public Text {
 public:
  using Text::Text;
  std::string next() { return lower(word()); }
  void expect(const char* wanted) {
    const std::string found = next();
    if (found != wanted) unexpected(found, std::string("\"") + wanted + "\"");
  }
  // "endloop", or "end loop".
  void expect_end(const std::string& of) {
    const std::string found = next();
    if (found == "end" + of) return;
    if (found != "end") unexpected(found, "\"end" + of + "\"");
    expect(of.c_str());
  }
  // A component of a normal: for a triangle without area not a number, in the spelling of the program that wrote it:
  // nan, -nan(ind), 1.#IND.
  Real component() {
    const std::string found = next();
    const std::string_view digits = std::string_view(found).substr(found.starts_with('-') || found.starts_with('+'));
    for (const char* none : {"nan", "inf", "1.#"})
      if (digits.starts_with(none)) return std::numeric_limits<Real>::quiet_NaN();
    return real(found);
  }
};

inline Facets read_ascii_stl(const std::string& name, std::string_view bytes) {
  StlWords words(name, bytes);
  Facets facets;
  words.expect("solid");
  words.rest_of_line();  // its name
  for (;;) {
    std::string word = words.next();
    if (word == "end") word += words.next();
    if (word == "endsolid") {
      words.rest_of_line();
      word = words.next();
      if (word.empty()) return facets;
      if (word != "solid") words.unexpected(word, "\"solid\" or the end of the file");
      words.rest_of_line();
      continue;
    }
    if (word != "facet") words.unexpected(word, "\"facet\" or \"endsolid\"");
    facets.places.push_back(words.line());
    words.expect("normal");
    Vec<Real, 3> normal;
    for (int i = 0; i < 3; ++i) normal[i] = words.component();
    facets.normals.push_back(normal);
    words.expect("outer");
    words.expect("loop");
    for (int k = 0; k < 3; ++k) {
      words.expect("vertex");
      Vec<Real, 3> x;
      for (int i = 0; i < 3; ++i) x[i] = words.real(words.word());
      facets.corners.push_back(x);
    }
    words.expect_end("loop");
    words.expect_end("facet");
  }
}

constexpr std::size_t stl_header = 84, stl_triangle = 50;  // bytes

inline std::uint32_t stl_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + stl_header - sizeof(count), sizeof(count));
  return count;
}

inline Facets read_binary_stl(const std::string& name, std::string_view bytes) {
  Facets facets;
  facets.place = "byte";
  const std::size_t count = stl_count(bytes);
  facets.corners.reserve(3 * count);
  facets.normals.reserve(count);
  facets.places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = stl_header + stl_triangle * i;
    facets.places.push_back(at);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t offset = at + 12 * k;
      std::array<float, 3> x{};
      std::memcpy(x.data(), bytes.data() + offset, sizeof(x));
      if (k == 0) {
        facets.normals.emplace_back(x[0], x[1], x[2]);
        continue;
      }
      for (const float component : x)
        if (!std::isfinite(component))
          throw std::runtime_error(name + ", byte " + std::to_string(offset) + ": a vertex of triangle " +
                                   std::to_string(i) + " is not finite");
      facets.corners.emplace_back(x[0], x[1], x[2]);
    }
  }
  return facets;
}

inline Vec<Real, 3> cross_product(const Vec<Real, 3>& a, const Vec<Real, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Reverses triangles, or refuses a file whose corners and normals disagree. `extent` is the diagonal of the box.
inline void settle_outside(Facets& facets, Real extent, Outside outside, const std::string& name) {
  if (outside == Outside::corners) return;
  const std::size_t count = facets.normals.size();
  std::vector<std::size_t> against;
  std::size_t judged = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto scaled = [&](std::size_t k) -> Vec<Real, 3> { return facets.corners[3 * i + k] / extent; };
    const Vec<Real, 3> a = scaled(1) - scaled(0), b = scaled(2) - scaled(0), area = cross_product(a, b);
    const Vec<Real, 3> normal = facets.normals[i].stableNormalized();
    // A triangle whose height is below the precision of the file has no meaningful normal.
    const Real longest = std::max({a.norm(), b.norm(), (a - b).norm()});
    Real largest = 1;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, scaled(k).cwiseAbs().maxCoeff());
    if (!normal.allFinite() || !(area.norm() > 1e-5 * largest * longest)) continue;
    const Real cosine = normal.dot(area) / area.norm();
    if (!(std::abs(cosine) > 0.5)) continue;
    ++judged;
    if (cosine < 0) against.push_back(i);
  }
  if (against.empty()) return;
  if (outside == Outside::agreed)
    throw std::runtime_error(name + ", " + facets.place + " " + std::to_string(facets.places[against[0]]) +
                             ": the corners of triangle " + std::to_string(against[0]) +
                             " run clockwise about its normal, and so do those of " + std::to_string(against.size()) +
                             " of " + std::to_string(count) +
                             " triangles; say which is right where the file is read, Outside::normals or "
                             "Outside::corners");
  const auto turn = [&](std::size_t i) { std::swap(facets.corners[3 * i + 1], facets.corners[3 * i + 2]); };
  if (against.size() == judged)  // triangles without meaningful normal follow the others
    for (std::size_t i = 0; i < count; ++i) turn(i);
  else
    for (const std::size_t i : against) turn(i);
}

// Merges corners closer than `tolerance` into one vertex, in a box of diagonal `extent` [length]; drops triangles of
// which two corners coincide.
inline rigid::Triangles merge(const std::vector<Vec<Real, 3>>& corners, Real extent, Real tolerance) {
  struct Hash {
    std::size_t operator()(const std::array<std::int64_t, 3>& cell) const {
      std::uint64_t h = 0;
      for (const std::int64_t i : cell) h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15u, h ^= h >> 29;
      return static_cast<std::size_t>(h);
    }
  };
  rigid::Triangles out;
  std::unordered_multimap<std::array<std::int64_t, 3>, Index, Hash> cells;
  Vec<Real, 3> origin = corners[0];
  for (const auto& x : corners) origin = origin.cwiseMin(x);
  // The lower limit of the cell size keeps cell numbers countable for every tolerance.
  const Real size = std::max(4 * tolerance, 1e-12 * extent);
  const auto cell = [&](const Vec<Real, 3>& x) {
    std::array<std::int64_t, 3> c{};
    for (int i = 0; i < 3; ++i)
      c[static_cast<std::size_t>(i)] = size > 0 ? std::llround(std::floor((x[i] - origin[i]) / size)) : 0;
    return c;
  };
  const auto number = [&](const Vec<Real, 3>& x) {
    const Vec<Real, 3> reach = Vec<Real, 3>::Constant(tolerance);
    const auto low = cell(x - reach), high = cell(x + reach);
    for (auto i = low[0]; i <= high[0]; ++i)
      for (auto j = low[1]; j <= high[1]; ++j)
        for (auto k = low[2]; k <= high[2]; ++k) {
          const auto [first, last] = cells.equal_range({i, j, k});
          for (auto at = first; at != last; ++at)
            if ((out.vertices[static_cast<std::size_t>(at->second)] - x).stableNorm() <= tolerance) return at->second;
        }
    const Index fresh = static_cast<Index>(out.vertices.size());
    out.vertices.push_back(x);
    cells.insert({cell(x), fresh});
    return fresh;
  };
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const std::array<Index, 3> triangle{number(corners[i]), number(corners[i + 1]), number(corners[i + 2])};
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      out.corners.push_back(triangle);
  }
  return out;
}

// Removes slivers, triangles no higher than `tolerance`: meshers make them where vertices of one patch lie on an edge
// of the next. Such an edge is divided at the vertex instead, so that the surface stays closed.
inline void take_out_slivers(rigid::Triangles& surface, Real tolerance) {
  using Triangle = std::array<Index, 3>;
  const auto vertex = [&](Index n) -> const Vec<Real, 3>& { return surface.vertices[static_cast<std::size_t>(n)]; };
  struct Flat {
    Real length;        // of the longest edge
    Triangle triangle;  // begins with that edge
    std::size_t at;
    bool operator<(const Flat& other) const { return length != other.length ? length < other.length : at > other.at; }
  };
  auto& triangles = surface.corners;
  const auto flat = [&](std::size_t at, Flat& found) {
    Triangle t = triangles[at];
    Real length = -1;
    for (int k = 0; k < 3; ++k, std::rotate(t.begin(), t.begin() + 1, t.end()))
      if (const Real l = (vertex(t[1]) - vertex(t[0])).stableNorm(); l > length) found = {length = l, t, at};
    const auto& [from, to, top] = found.triangle;
    // Edges over the longest one, so that their squares do not overflow.
    const Vec<Real, 3> along = (vertex(to) - vertex(from)) / length, side = (vertex(top) - vertex(from)) / length;
    return !(cross_product(along, side).norm() > std::max(tolerance / length, Real(2e-12)));
  };
  std::priority_queue<Flat> work;
  Flat found{};
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (flat(i, found)) work.push(found);
  if (work.empty()) return;
  // From, to -> the triangle; none if there are several.
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::map<std::pair<Index, Index>, std::size_t> walked;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] = walked.insert({{triangles[i][k], triangles[i][(k + 1) % 3]}, i});
      if (!fresh) at->second = none;
    }
  std::vector<bool> gone(triangles.size(), false);
  const auto forget = [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = walked.find({triangles[i][k], triangles[i][(k + 1) % 3]});
      if (at != walked.end() && at->second == i) walked.erase(at);
    }
  };
  const auto put = [&](std::size_t i, const Triangle& t) {
    triangles[i] = t;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, fresh] = walked.insert({{t[k], t[(k + 1) % 3]}, i});
      if (!fresh) at->second = none;
    }
    Flat again{};
    if (flat(i, again)) work.push(again);
  };
  // Each division moves a vertex into the neighbour; the budget ends cyclic divisions.
  for (std::size_t budget = 8 * work.size() + 8; !work.empty();) {
    const Flat now = work.top();
    work.pop();
    if (gone[now.at]) continue;
    const auto [from, to, top] = now.triangle;
    {
      const Triangle& t = triangles[now.at];
      Triangle a = t, b = now.triangle;
      std::sort(a.begin(), a.end());
      std::sort(b.begin(), b.end());
      if (a != b) continue;  // the triangle has been divided since
    }
    const auto across = walked.find({to, from});
    const std::size_t other = across == walked.end() ? none : across->second;
    forget(now.at);
    if (other == none || budget == 0) {
      gone[now.at] = true;
      continue;
    }
    --budget;
    Index far = 0;
    for (const Index n : triangles[other])
      if (n != from && n != to) far = n;
    forget(other);
    if (far == top) {  // the same triangle with opposite orientation
      gone[now.at] = gone[other] = true;
      continue;
    }
    put(now.at, {top, from, far});
    put(other, {far, to, top});
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (!gone[i]) triangles[kept++] = triangles[i];
  triangles.resize(kept);
}

inline void check_merge(Real merge) {
  if (!(merge >= 0 && merge < 0.1)) throw std::invalid_argument("STL: the merge tolerance must lie in [0, 0.1)");
}

inline rigid::Triangles read_stl(std::string_view view, const std::string& name, Real merge_tolerance,
                                 Outside outside) {
  static_assert(std::endian::native == std::endian::little, "binary STL files hold little-endian numbers");
  const std::string_view text = without_mark(view);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const bool solid = first != std::string_view::npos && lower(text.substr(first, 5)) == "solid";
  const std::size_t wanted = view.size() < stl_header ? 0 : stl_header + stl_triangle * std::size_t(stl_count(view));
  const bool whole = wanted != 0 && view.size() >= wanted;
  // Some binary files begin with "solid", but all contain zero bytes; some texts end with zero bytes.
  const std::string_view words = text.substr(0, text.find_last_not_of(std::string_view("\0\x1a", 2)) + 1);
  const bool ascii = solid && view.size() != wanted && words.find('\0') == std::string_view::npos;
  if (!ascii && !whole) {
    if (view.size() < stl_header)
      throw std::runtime_error(name + ": neither an ASCII STL file, which begins with \"solid\", nor a binary one, " +
                               "which has a header of 84 bytes; this has " + std::to_string(view.size()));
    throw std::runtime_error(name + ", byte 80: claims " + std::to_string(stl_count(view)) + " triangles, which take " +
                             std::to_string(wanted) + " bytes, but the file has " + std::to_string(view.size()));
  }
  // Bytes after the last triangle are ignored, unless they could be more triangles.
  if (!ascii) {
    const std::string_view behind = view.substr(wanted);
    if (!behind.empty() && behind.size() % stl_triangle == 0 && behind.find_first_not_of('\0') != behind.npos)
      throw std::runtime_error(name + ", byte 80: claims " + std::to_string(stl_count(view)) +
                               " triangles, but the file has bytes for " +
                               std::to_string((view.size() - stl_header) / stl_triangle));
  }
  Facets facets = ascii ? read_ascii_stl(name, words) : read_binary_stl(name, view);
  const std::vector<Vec<Real, 3>>& corners = facets.corners;
  if (corners.empty()) throw std::runtime_error(name + ": there are no triangles");
  if (corners.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw std::runtime_error(name + ": more corners than can be numbered");
  Vec<Real, 3> low = corners[0], high = corners[0];
  for (const auto& x : corners) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Real extent = (high - low).stableNorm();
  if (!std::isfinite(extent)) throw std::runtime_error(name + ": the surface is larger than a number can tell");
  if (extent > 0) settle_outside(facets, extent, outside, name);
  rigid::Triangles surface = merge(corners, extent, merge_tolerance * extent);
  take_out_slivers(surface, merge_tolerance * extent);
  if (surface.corners.empty()) throw std::runtime_error(name + ": all triangles are degenerate");
  return surface;
}

}  // namespace detail

/// Reads a surface from an ASCII or a binary STL file; `name` stands for it in messages. Corners closer to each other
/// than `merge` times the diagonal of the bounding box become one vertex. Triangles that lose a side by it, or that are
/// no higher, are removed: where they closed the seam between a vertex and an edge that contains it, the edge is
/// divided there.
///
/// The order of the corners and the normals in the file define the outside, and must agree. A file in which they
/// contradict each other is refused, unless `outside` selects one of them; normals that are zero, not numbers or nearly
/// in the triangle's plane are ignored.
///
/// Throws std::runtime_error, naming the file and the line (ASCII) or byte (binary), if it cannot be read or is
/// malformed, std::invalid_argument if `merge` is outside [0, 0.1). Memory is proportional to the size of the file,
/// whatever its count. Bytes after a binary file's last triangle are ignored, unless they could be further ones.
inline rigid::Triangles read_stl(std::istream& in, const std::string& name, Real merge = 1e-6,
                                 Outside outside = Outside::agreed) {
  detail::check_merge(merge);
  return detail::read_stl(detail::read_all(in, name), name, merge, outside);
}

/// The same from a file.
inline rigid::Triangles read_stl(const std::filesystem::path& path, Real merge = 1e-6,
                                 Outside outside = Outside::agreed) {
  detail::check_merge(merge);
  return detail::read_stl(detail::read_all(path), path.string(), merge, outside);
}

enum class StlFormat { binary, ascii };

/// Writes a surface as an STL file: binary in single precision, ASCII in full. Throws std::runtime_error, naming the
/// file and the reason, if it cannot be written.
inline void write_stl(const std::filesystem::path& path, const rigid::Triangles& surface,
                      StlFormat format = StlFormat::binary) {
  static_assert(std::endian::native == std::endian::little, "binary STL files hold little-endian numbers");
  std::string text = format == StlFormat::ascii ? "solid stickslip\n" : std::string(80, ' ');
  const auto put = [&](const Vec<Real, 3>& v) {
    for (const Real x : v) {
      if (format == StlFormat::ascii) {
        std::array<char, 32> digits{};
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), x).ptr;
        text.append(1, ' ').append(digits.data(), end);
      } else {
        const auto single = static_cast<float>(x);
        text.append(reinterpret_cast<const char*>(&single), sizeof(single));
      }
    }
  };
  const auto count = static_cast<std::uint32_t>(surface.corners.size());
  if (format == StlFormat::binary) text.append(reinterpret_cast<const char*>(&count), sizeof(count));
  for (const auto& [a, b, c] : surface.corners) {
    const Vec<Real, 3>&p = surface.vertices.at(static_cast<std::size_t>(a)),
                    &q = surface.vertices.at(static_cast<std::size_t>(b)),
                    &r = surface.vertices.at(static_cast<std::size_t>(c));
    const Vec<Real, 3> e = q - p, f = r - p;
    const Vec<Real, 3> normal(e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]);
    if (format == StlFormat::ascii) text += "facet normal";
    put(normal.stableNormalized());
    if (format == StlFormat::ascii) text += "\nouter loop\n";
    for (const Vec<Real, 3>* x : {&p, &q, &r}) {
      if (format == StlFormat::ascii) text += "vertex";
      put(*x);
      if (format == StlFormat::ascii) text += '\n';
    }
    text += format == StlFormat::ascii ? std::string("endloop\nendfacet\n") : std::string(2, '\0');
  }
  if (format == StlFormat::ascii) text += "endsolid stickslip\n";
  write_file(path, [&](std::ostream& out) { out.write(text.data(), static_cast<std::streamsize>(text.size())); });
}

}  // namespace stickslip::io
