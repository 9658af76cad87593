// SPDX-License-Identifier: BSL-1.0
// STL files: what is written is read, and what is wrong is said, with the file and the place.
#include <stickslip/io/stl.hpp>

#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "icosphere.hpp"

namespace {

using namespace stickslip;

// A file that is removed at the end of its test.
struct File {
  std::filesystem::path path;
  explicit File(const std::string& text = "") {
    static int count = 0;
    path = std::filesystem::temp_directory_path() /
           ("stickslip_stl_" + std::to_string(std::random_device()()) + "_" + std::to_string(++count) + ".stl");
    std::ofstream(path, std::ios::binary) << text;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { std::filesystem::remove(path); }
  std::string text() const {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

std::string complaint(const std::string& text) {
  const File file(text);
  try {
    (void)io::read_stl(file.path);
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    CHECK(what.find(file.path.string()) != std::string::npos);
    CHECK(what.find('\n') == std::string::npos);
    return what;
  }
  return "none";
}
#define SAYS(part, ...) CHECK(complaint(__VA_ARGS__).find(part) != std::string::npos)

const std::string facet =
    "facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\nendfacet\n";

// Triangles as sets of places: vertices may be numbered anew.
void same(const rigid::Triangles& a, const rigid::Triangles& b, Real tolerance) {
  REQUIRE(a.corners.size() == b.corners.size());
  CHECK(a.vertices.size() == b.vertices.size());
  Real worst = 0;
  for (std::size_t i = 0; i < a.corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      worst =
          std::max(worst, (a.vertices[std::size_t(a.corners[i][k])] - b.vertices[std::size_t(b.corners[i][k])]).norm());
  CHECK(worst <= tolerance);
}

TEST_CASE("a surface written as STL is read back, exactly from ASCII and in single precision from binary") {
  const auto ball = icosphere(2);
  const File file;
  io::write_stl(file.path, ball, io::StlFormat::ascii);
  same(io::read_stl(file.path), ball, 0);
  io::write_stl(file.path, ball);
  same(io::read_stl(file.path), ball, 1e-7);
  CHECK(std::filesystem::file_size(file.path) == 84 + 50 * ball.corners.size());
}

TEST_CASE("ASCII STL is read in any case, with several solids and signs") {
  CHECK(complaint("solid a b c\n" + facet + "endsolid a b c\n") == "none");
  CHECK(complaint("  solid\r\n" + facet + "endsolid") == "none");
  CHECK(complaint("solid one\n" + facet + "endsolid one\nsolid two\n" + facet + "endsolid\n") == "none");
  std::string loud = "solid\n" + facet + "endsolid\n";
  for (char& c : loud)
    if (c != 's' && c != 'o' && c != 'l' && c != 'i' && c != 'd') c = static_cast<char>(std::toupper(c));
  CHECK(complaint(loud) == "none");
  CHECK(complaint("solid\nfacet normal nope") != "none");
  std::string plus = "solid\n" + facet + "endsolid\n";
  plus.replace(plus.find("1 0 0"), 5, "+1.5e+0 0 -0");
  CHECK(complaint(plus) == "none");
  CHECK(complaint("SOLID\n" + facet + "ENDSOLID\n") == "none");
  // A binary file may call itself solid.
  const File file;
  io::write_stl(file.path, icosphere(0));
  std::string bytes = file.text();
  bytes.replace(0, 5, "solid");
  CHECK(complaint(bytes) == "none");
}

TEST_CASE("coincident STL corners become one vertex") {
  const auto quad = [](const std::string& near) {
    return "solid\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0\nvertex " + near +
           "\nendloop\nendfacet\nendsolid\n";
  };
  const auto vertices = [](const std::string& text, Real merge) {
    const File file(text);
    return io::read_stl(file.path, merge).vertices.size();
  };
  CHECK(vertices(quad("0 1 0"), 1e-6) == 4);
  CHECK(vertices(quad("0 1 0"), 0) == 4);
  CHECK(vertices(quad("1e-7 1 -1e-7"), 1e-6) == 4);
  CHECK(vertices(quad("1e-5 1 0"), 1e-6) == 5);
  CHECK(vertices(quad("1e-7 1 0"), 0) == 5);
  // A needle whose corners fall together goes.
  const File needle("solid\n" + facet +
                    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e-8 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                    "endsolid\n");
  CHECK(io::read_stl(needle.path).corners.size() == 1);
  SAYS(
      "all triangles are degenerate",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n");
  CHECK_THROWS_AS((void)io::read_stl(needle.path, -1), std::invalid_argument);
}

TEST_CASE("STL surfaces of any representable size are read") {
  for (const char* size : {"1e-200", "1e-100", "1e100", "1e200", "1.7e308"})
    for (const Real merge : {0.0, 1e-300, 1e-6}) {
      std::istringstream in(std::string("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex ") + size +
                            " 0 0\nvertex 0 0 " + size + "\nendloop\nendfacet\nendsolid\n");
      if (std::string(size) == "1.7e308") {
        CHECK_THROWS_WITH_AS((void)io::read_stl(in, "a.stl", merge),
                             "a.stl: the surface is larger than a number can tell", std::runtime_error);
        continue;
      }
      const auto surface = io::read_stl(in, "a.stl", merge);
      CHECK(surface.vertices.size() == 3);
      CHECK(surface.corners.size() == 1);
    }
}

TEST_CASE("wrong ASCII STL files are refused with their line") {
  SAYS("line 3: found \"facet\" where \"outer\"", "solid\nfacet normal 0 0 1\nfacet\n");
  SAYS("line 2: found \"triangle\" where \"facet\" or \"endsolid\"", "solid\ntriangle\n");
  SAYS("line 2: found \"up\" where a number", "solid\nfacet normal up 0 1\n");
  SAYS("line 4: found \"1,0\" where a number", "solid\nfacet normal 0 0 1\nouter loop\nvertex 1,0 0 0\n");
  SAYS("line 4: the number \"nan\" is not finite", "solid\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\n");
  SAYS("line 4: the number \"-inf\" is not finite", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 -inf 0\n");
  SAYS("line 4: the number \"1e999\" is out of range", "solid\nfacet normal 0 0 1\nouter loop\nvertex 1e999 0 0\n");
  SAYS("the file ends where a number", "solid\nfacet normal 0 0 1\nouter loop\nvertex 1 0\n");
  SAYS("line 9: the file ends where \"facet\" or \"endsolid\"", "solid\n" + facet);
  SAYS("found \"vertex\" where \"endloop\"",
       "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
       "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  SAYS("where \"solid\" or the end of the file", "solid\n" + facet + "endsolid\nrubbish\n");
  SAYS("found \"aaaaaaaaaaaaaaaaaaaa...\"", "solid\n" + std::string(100000, 'a') + "\n");
  SAYS("there are no triangles", "solid nothing\nendsolid nothing\n");
}

TEST_CASE("STL files with NaN normals, byte order marks or trailing bytes are read") {
  const auto read = [](const std::string& text, io::Outside outside = io::Outside::agreed) {
    std::istringstream in(text);
    return io::read_stl(in, "a.stl", 1e-6, outside);
  };
  const auto with = [](std::string text, const std::string& old, const std::string& fresh) {
    for (std::size_t at = text.find(old); at != text.npos; at = text.find(old, at + fresh.size()))
      text.replace(at, old.size(), fresh);
    return text;
  };
  const auto ball = icosphere(1);
  const File file;
  io::write_stl(file.path, ball, io::StlFormat::ascii);
  const std::string text = file.text();
  same(read(text), ball, 0);
  for (const char* normal : {"nan nan nan", "-nan(ind) NaN 0", "0 0 0", "1.#QNAN -1.#IND 0", "inf -inf 0"}) {
    std::string odd;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      odd += (line.starts_with("facet normal") ? std::string("facet normal ") + normal : line) + "\n";
    same(read(odd), ball, 0);
  }
  same(read(with(with(text, "endloop", "end loop"), "endfacet", "END  facet")), ball, 0);
  same(read(with(text, "endsolid", "end solid")), ball, 0);
  same(read("\xef\xbb\xbf" + text), ball, 0);
  same(read("\xef\xbb\xbf\r\n  " + text), ball, 0);
  same(read(text + "\x1a"), ball, 0);
  same(read(text + std::string(3, '\0')), ball, 0);
  CHECK_THROWS_WITH_AS((void)read(with(text, "endloop", "end facet")),
                       "a.stl, line 7: found \"facet\" where \"loop\" should stand", std::runtime_error);

  // Bytes behind the end of a binary file, unless they could be more of it.
  io::write_stl(file.path, ball);
  const std::string bytes = file.text();
  for (const std::string& behind : {std::string("x"), std::string("COLOR=\x01\x02\x03\x04"), std::string(512, '\0'),
                                    std::string(50, '\0'), std::string(51, 'x')})
    same(read(bytes + behind), ball, 1e-7);
  CHECK_THROWS_WITH_AS((void)read(bytes + bytes.substr(84, 100)),
                       "a.stl, byte 80: claims 80 triangles, but the file has bytes for 82", std::runtime_error);
  std::string none = bytes;  // normals that are not numbers
  for (std::size_t i = 0; i < ball.corners.size(); ++i)
    none.replace(84 + 50 * i, 4, std::string("\x00\x00\xc0\x7f", 4));
  same(read(none), ball, 1e-7);
}

TEST_CASE("STL corners and normals that contradict each other are refused unless one is chosen") {
  const auto ball = icosphere(1);
  auto turned = ball;
  for (auto& corners : turned.corners) std::swap(corners[1], corners[2]);
  for (const auto format : {io::StlFormat::ascii, io::StlFormat::binary}) {
    // The corners of one, the normals of the other: facet by facet the first four lines, or twelve bytes.
    const File right, wrong;
    io::write_stl(right.path, ball, format);
    io::write_stl(wrong.path, turned, format);
    std::string text = wrong.text();
    if (format == io::StlFormat::ascii) {
      std::istringstream normals(right.text()), corners(wrong.text());
      text.clear();
      for (std::string normal, line; std::getline(normals, normal) && std::getline(corners, line);)
        text += (line.starts_with("facet") ? normal : line) + "\n";
    } else {
      for (std::size_t i = 0; i < ball.corners.size(); ++i)
        text.replace(84 + 50 * i, 12, right.text(), 84 + 50 * i, 12);
    }
    const auto read = [&](io::Outside outside) {
      std::istringstream in(text);
      return io::read_stl(in, "a.stl", 1e-6, outside);
    };
    CHECK_THROWS_WITH_AS((void)read(io::Outside::agreed),
                         doctest::Contains("the corners of triangle 0 run clockwise about its normal, and so do those "
                                           "of 80 of 80 triangles; say which is right"),
                         std::runtime_error);
    same(read(io::Outside::normals), ball, 1e-7);
    same(read(io::Outside::corners), turned, 1e-7);
    // One that contradicts is named, and turned alone.
    text = right.text();
    if (format == io::StlFormat::binary) {
      text.replace(84 + 50 * 7 + 12, 12, right.text(), 84 + 50 * 7 + 24, 12);
      text.replace(84 + 50 * 7 + 24, 12, right.text(), 84 + 50 * 7 + 12, 12);
      CHECK_THROWS_WITH_AS((void)read(io::Outside::agreed),
                           doctest::Contains("a.stl, byte 434: the corners of triangle 7 run clockwise about its "
                                             "normal, and so do those of 1 of 80 triangles"),
                           std::runtime_error);
      const auto mended = read(io::Outside::normals);
      Real volume = 0;  // six times
      for (const auto& [a, b, c] : mended.corners)
        volume += io::detail::cross_product(mended.vertices[std::size_t(a)], mended.vertices[std::size_t(b)])
                      .dot(mended.vertices[std::size_t(c)]);
      Real wanted = 0;
      for (const auto& [a, b, c] : ball.corners)
        wanted += io::detail::cross_product(ball.vertices[std::size_t(a)], ball.vertices[std::size_t(b)])
                      .dot(ball.vertices[std::size_t(c)]);
      CHECK(volume == doctest::Approx(wanted).epsilon(1e-6));
    }
  }
}

// Every edge is walked once in each direction, and the surface around nothing has this volume, six times.
void closed(const rigid::Triangles& s, Real volume) {
  std::map<std::pair<Index, Index>, int> walked;
  Real sum = 0;
  for (const auto& [a, b, c] : s.corners) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++walked[{from, to}];
    const auto& p = s.vertices[std::size_t(a)];
    const auto& q = s.vertices[std::size_t(b)];
    const auto& r = s.vertices[std::size_t(c)];
    sum += io::detail::cross_product(p, q).dot(r);
    const Vec<Real, 3> e = q - p, f = r - p;
    CHECK(io::detail::cross_product(e, f).norm() > 1e-6);
  }
  for (const auto& [edge, times] : walked) {
    CHECK(times == 1);
    CHECK(walked.count({edge.second, edge.first}) == 1);
  }
  CHECK(sum == doctest::Approx(volume));
}

TEST_CASE("degenerate STL triangles that close a seam are refused or removed") {
  // A tetrahedron with vertices on an edge of one face, which the neighbour does not have: fillers close the seam.
  const auto solid = [](const std::vector<Vec<Real, 3>>& x, const std::vector<std::array<int, 3>>& triangles) {
    std::ostringstream out;
    out << "solid\n";
    for (const auto& corners : triangles) {
      out << "facet normal nan nan nan\nouter loop\n";
      for (const int n : corners) {
        const auto& v = x[static_cast<std::size_t>(n)];
        out << "vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << "\n";
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid\n";
    std::istringstream in(out.str());
    return io::read_stl(in, "a.stl");
  };
  const std::vector<Vec<Real, 3>> x{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {1, 0, 0}, {2, 0, 1e-7}, {3, 0, 0}};
  // Bottom 0 2 1 whole; the face 0 1 3 in parts; fillers between, as a fan, and one by one.
  const std::vector<std::array<int, 3>> rest{{0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  const auto and_also = [&](std::vector<std::array<int, 3>> more) {
    more.insert(more.begin(), rest.begin(), rest.end());
    return more;
  };
  closed(solid(x, and_also({{0, 1, 3}})), 64);
  closed(solid(x, and_also({{0, 4, 3}, {4, 1, 3}, {0, 1, 4}})), 64);
  closed(solid(x, and_also({{0, 4, 3}, {4, 5, 3}, {5, 1, 3}, {0, 1, 5}, {0, 5, 4}})), 64);
  closed(solid(x, and_also({{0, 4, 3}, {4, 5, 3}, {5, 6, 3}, {6, 1, 3}, {0, 1, 4}, {4, 1, 6}, {4, 6, 5}})), 64);
  closed(solid(x, and_also({{0, 4, 3}, {4, 5, 3}, {5, 6, 3}, {6, 1, 3}, {0, 1, 6}, {0, 6, 5}, {0, 5, 4}})), 64);
  // A flap without area, back and forth, and one at an open edge, vanish.
  closed(solid(x, and_also({{0, 1, 3}, {0, 5, 1}, {1, 5, 0}})), 64);
  CHECK(solid(x, {{0, 1, 3}, {1, 0, 5}}).corners.size() == 2);
  CHECK(solid(x, {{0, 2, 3}, {1, 0, 5}}).corners.size() == 1);
  CHECK_THROWS_WITH_AS((void)solid(x, {{0, 4, 1}}), "a.stl: all triangles are degenerate", std::runtime_error);
}

TEST_CASE("wrong binary STL files are refused with their byte") {
  const File file;
  io::write_stl(file.path, icosphere(0));
  const std::string good = file.text();
  REQUIRE(complaint(good) == "none");
  SAYS("neither an ASCII STL file", "");
  SAYS("neither an ASCII STL file", "some garbage");
  SAYS("this has 83", good.substr(0, 83));
  SAYS("byte 80: claims 20 triangles, which take 1084 bytes, but the file has 1083", good.substr(0, 1083));
  SAYS("byte 80: claims 20 triangles", good.substr(0, 84));
  std::string changed = good;
  changed.replace(80, 4, "\xff\xff\xff\xff");
  SAYS("claims 4294967295 triangles, which take 214748364834 bytes", changed);
  changed.replace(0, 5, "solid");
  SAYS("claims 4294967295 triangles", changed);
  changed = good;
  changed.replace(84 + 50 * 3 + 24, 4, std::string("\x00\x00\xc0\x7f", 4));  // not a number
  SAYS("byte 258: a vertex of triangle 3 is not finite", changed);
  changed = good.substr(0, 84);
  changed.replace(80, 4, std::string(4, '\0'));
  SAYS("there are no triangles", changed);
}

TEST_CASE("an STL file that cannot be opened or written is named") {
  const auto says = [](auto&& act) {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(says([] { (void)io::read_stl("/no/such/file.stl"); }) ==
        "cannot read /no/such/file.stl: No such file or directory");
  CHECK(says([] { (void)io::read_stl(std::filesystem::temp_directory_path()); }).ends_with(": it is no regular file"));
  CHECK(says([] { io::write_stl("/no/such/file.stl", icosphere(0)); }) ==
        "cannot write /no/such/file.stl: No such file or directory");
  CHECK(says([] { io::write_stl("/dev/full", icosphere(0)); }) == "cannot write /dev/full: it is no regular file");
}

}  // namespace
