// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/geometry/triangles.hpp>

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
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stickslip::io {

namespace detail {

// Corners, three a triangle, as a file of triangles lists them: each with vertices of its own.
using Corners = std::vector<Vec<Real, 3>>;

// The words of a text with the number of the line that each stands in.
class StlWords {
 public:
  StlWords(std::string name, std::string_view text) : name_(std::move(name)), text_(text) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(name_ + ", line " + std::to_string(line_) + ": " + what);
  }
  // The next word in lower case, empty at the end of the file.
  std::string next() {
    std::size_t ahead = at_;
    while (ahead < text_.size() && blank(text_[ahead])) line_ += text_[ahead++] == '\n';
    at_ = ahead;
    while (at_ < text_.size() && !blank(text_[at_])) ++at_;
    std::string word(text_.substr(ahead, at_ - ahead));
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return word;
  }
  void expect(const char* wanted) {
    const std::string word = next();
    if (word != wanted) unexpected(word, std::string("\"") + wanted + "\"");
  }
  [[noreturn]] void unexpected(const std::string& word, const std::string& wanted) const {
    if (word.empty()) fail("the file ends where " + wanted + " should stand");
    fail("found \"" + shown(word) + "\" where " + wanted + " should stand");
  }
  Real number() {
    const std::string word = next();
    const char *first = word.data() + (word.starts_with('+') ? 1 : 0), *last = word.data() + word.size();
    Real value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc::result_out_of_range) fail("the number \"" + shown(word) + "\" is out of range");
    if (error != std::errc() || end != last) unexpected(word, "a number");
    if (!std::isfinite(value)) fail("the number \"" + shown(word) + "\" is not finite");
    return value;
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v'; }
  // Garbage may be long and may not be text.
  static std::string shown(const std::string& word) {
    std::string text = word.substr(0, 20);
    for (char& c : text)
      if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    return word.size() > 20 ? text + "..." : text;
  }

  std::string name_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

inline Corners read_ascii_stl(const std::string& name, std::string_view text) {
  StlWords words(name, text);
  Corners corners;
  words.expect("solid");
  words.skip_line();  // its name
  for (;;) {
    std::string word = words.next();
    if (word == "endsolid") {
      words.skip_line();
      word = words.next();
      if (word.empty()) return corners;
      if (word != "solid") words.unexpected(word, "\"solid\" or the end of the file");
      words.skip_line();
      continue;
    }
    if (word != "facet") words.unexpected(word, "\"facet\" or \"endsolid\"");
    words.expect("normal");
    for (int i = 0; i < 3; ++i) words.number();  // the corners' order says more
    words.expect("outer");
    words.expect("loop");
    for (int k = 0; k < 3; ++k) {
      words.expect("vertex");
      Vec<Real, 3> x;
      for (int i = 0; i < 3; ++i) x[i] = words.number();
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

// Gives corners closer than `tolerance` one vertex; leaves out triangles of which two corners fall together.
inline rigid::Triangles merge(const Corners& corners, Real tolerance) {
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
  const Real size = 4 * tolerance;
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
            if ((out.vertices[static_cast<std::size_t>(at->second)] - x).norm() <= tolerance) return at->second;
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

}  // namespace detail

/// Reads a surface from an STL file, ASCII or binary, whichever it is. Corners closer to each other than `merge` times
/// the diagonal of the surface's box become one vertex; triangles that lose a side by it are left out. The order of the
/// corners says where outside is; the normals in the file are not looked at. Throws std::runtime_error, one sentence
/// with the file and the line (ASCII) or byte (binary), if the file cannot be read or is not what it claims to be.
/// Needs memory in proportion to the file, never to a count that the file merely claims.
inline rigid::Triangles read_stl(const std::filesystem::path& path, Real merge = 1e-6) {
  static_assert(std::endian::native == std::endian::little, "binary STL files hold little-endian numbers");
  if (!(merge >= 0 && merge < 0.1)) throw std::invalid_argument("STL: the merge tolerance must lie in [0, 0.1)");
  const std::string name = path.string();
  std::error_code error;
  const auto size = std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
  std::ifstream in(path, std::ios::binary);
  if (error || !in || !std::filesystem::is_regular_file(path, error)) throw std::runtime_error("cannot read " + name);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!in || static_cast<std::uintmax_t>(in.gcount()) != size) throw std::runtime_error("cannot read " + name);

  const std::string_view view(bytes);
  const std::size_t first = view.find_first_not_of(" \t\r\n");
  const bool solid = first != std::string_view::npos && view.substr(first, 5) == "solid";
  const bool whole = view.size() >= detail::stl_header &&
                     view.size() - detail::stl_header == detail::stl_triangle * std::size_t(detail::stl_count(view));
  // Some binary files begin with "solid", but none without zero bytes.
  const bool ascii = solid && !whole && view.find('\0') == std::string_view::npos;
  if (!ascii && !whole) {
    if (view.size() < detail::stl_header)
      throw std::runtime_error(name + ": neither an ASCII STL file, which begins with \"solid\", nor a binary one, " +
                               "which has a header of 84 bytes; this has " + std::to_string(view.size()));
    const std::uint64_t count = detail::stl_count(view);
    throw std::runtime_error(name + ", byte 80: claims " + std::to_string(count) + " triangles, which take " +
                             std::to_string(detail::stl_header + detail::stl_triangle * count) +
                             " bytes, but the file has " + std::to_string(view.size()));
  }
  const detail::Corners corners = ascii ? detail::read_ascii_stl(name, view) : detail::read_binary_stl(name, view);
  if (corners.empty()) throw std::runtime_error(name + ": there are no triangles");
  if (corners.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw std::runtime_error(name + ": more corners than can be numbered");
  Vec<Real, 3> low = corners[0], high = corners[0];
  for (const auto& x : corners) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  rigid::Triangles surface = detail::merge(corners, merge * (high - low).stableNorm());
  if (surface.corners.empty()) throw std::runtime_error(name + ": all triangles are degenerate");
  return surface;
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
