// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/triangles.hpp>
#include <stickslip/io/text.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stickslip::io {

namespace detail {

// Corners, three a triangle, as a file of triangles lists them: each with vertices of its own.
using Corners = std::vector<Vec<Real, 3>>;

inline std::string lower(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

// Words of an ASCII STL file, in which capitals and small letters are the same.
class StlWords : public Text {
 public:
  using Text::Text;
  std::string next() { return lower(word()); }
  void expect(const char* wanted) {
    const std::string found = next();
    if (found != wanted) unexpected(found, std::string("\"") + wanted + "\"");
  }
};

inline Corners read_ascii_stl(const std::string& name, std::string_view bytes) {
  StlWords words(name, bytes);
  Corners corners;
  words.expect("solid");
  words.rest_of_line();  // its name
  for (;;) {
    std::string word = words.next();
    if (word == "endsolid") {
      words.rest_of_line();
      word = words.next();
      if (word.empty()) return corners;
      if (word != "solid") words.unexpected(word, "\"solid\" or the end of the file");
      words.rest_of_line();
      continue;
    }
    if (word != "facet") words.unexpected(word, "\"facet\" or \"endsolid\"");
    words.expect("normal");
    for (int i = 0; i < 3; ++i) words.real(words.word());  // the corners' order says more
    words.expect("outer");
    words.expect("loop");
    for (int k = 0; k < 3; ++k) {
      words.expect("vertex");
      Vec<Real, 3> x;
      for (int i = 0; i < 3; ++i) x[i] = words.real(words.word());
      corners.push_back(x);
    }
    words.expect("endloop");
    words.expect("endfacet");
  }
}

constexpr std::size_t stl_header = 84, stl_triangle = 50;  // bytes

inline std::uint32_t stl_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + stl_header - sizeof(count), sizeof(count));
  return count;
}

inline Corners read_binary_stl(const std::string& name, std::string_view bytes) {
  Corners corners;
  const std::size_t count = stl_count(bytes);
  corners.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t offset = stl_header + stl_triangle * i + 12 * (k + 1);  // behind the normal
      std::array<float, 3> x{};
      std::memcpy(x.data(), bytes.data() + offset, sizeof(x));
      for (const float component : x)
        if (!std::isfinite(component))
          throw std::runtime_error(name + ", byte " + std::to_string(offset) + ": a vertex of triangle " +
                                   std::to_string(i) + " is not finite");
      corners.emplace_back(x[0], x[1], x[2]);
    }
  return corners;
}

// Gives corners in a box of diagonal `extent` one vertex if they are closer than `tolerance`; leaves out triangles of
// which two corners fall together.
inline rigid::Triangles merge(const Corners& corners, Real extent, Real tolerance) {
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
  // A cell is no smaller than its numbers can count, however small the tolerance.
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

inline void check_merge(Real merge) {
  if (!(merge >= 0 && merge < 0.1)) throw std::invalid_argument("STL: the merge tolerance must lie in [0, 0.1)");
}

inline rigid::Triangles read_stl(std::string_view view, const std::string& name, Real merge_tolerance) {
  static_assert(std::endian::native == std::endian::little, "binary STL files hold little-endian numbers");
  const std::size_t first = view.find_first_not_of(" \t\r\n");
  const bool solid = first != std::string_view::npos && lower(view.substr(first, 5)) == "solid";
  const bool whole =
      view.size() >= stl_header && view.size() - stl_header == stl_triangle * std::size_t(stl_count(view));
  // Some binary files begin with "solid", but none without zero bytes.
  const bool ascii = solid && !whole && view.find('\0') == std::string_view::npos;
  if (!ascii && !whole) {
    if (view.size() < stl_header)
      throw std::runtime_error(name + ": neither an ASCII STL file, which begins with \"solid\", nor a binary one, " +
                               "which has a header of 84 bytes; this has " + std::to_string(view.size()));
    const std::uint64_t count = stl_count(view);
    throw std::runtime_error(name + ", byte 80: claims " + std::to_string(count) + " triangles, which take " +
                             std::to_string(stl_header + stl_triangle * count) + " bytes, but the file has " +
                             std::to_string(view.size()));
  }
  const Corners corners = ascii ? read_ascii_stl(name, view) : read_binary_stl(name, view);
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
  rigid::Triangles surface = merge(corners, extent, merge_tolerance * extent);
  if (surface.corners.empty()) throw std::runtime_error(name + ": all triangles are degenerate");
  return surface;
}

}  // namespace detail

/// Reads a surface from an STL file, ASCII or binary, whichever it is; `name` is what complaints call it. Corners
/// closer to each other than `merge` times the diagonal of the surface's box become one vertex; triangles that lose a
/// side by it are left out. The order of the corners says where outside is; the normals in the file are not looked at.
/// Throws std::runtime_error, one sentence with the file and the line (ASCII) or byte (binary), if the file cannot be
/// read or is not what it claims to be. Needs memory in proportion to the file, never to a count that the file merely
/// claims.
inline rigid::Triangles read_stl(std::istream& in, const std::string& name, Real merge = 1e-6) {
  detail::check_merge(merge);
  return detail::read_stl(detail::read_all(in, name), name, merge);
}

/// The same from a file on the disc.
inline rigid::Triangles read_stl(const std::filesystem::path& path, Real merge = 1e-6) {
  detail::check_merge(merge);
  return detail::read_stl(detail::read_all(path), path.string(), merge);
}

enum class StlFormat { binary, ascii };

/// Writes a surface as an STL file: binary in single precision, ASCII in full. Throws std::runtime_error, naming the
/// file, when it cannot be written.
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
  std::ofstream out(path, std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace stickslip::io
