// SPDX-License-Identifier: BSL-1.0
// STL files: what is written is read, and what is wrong is said, with the file and the place.
#include <stickslip/io/stl.hpp>

#include <doctest/doctest.h>

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

TEST_CASE("written and read again") {
  const auto ball = icosphere(2);
  const File file;
  io::write_stl(file.path, ball, io::StlFormat::ascii);
  same(io::read_stl(file.path), ball, 0);
  io::write_stl(file.path, ball);
  same(io::read_stl(file.path), ball, 1e-7);
  CHECK(std::filesystem::file_size(file.path) == 84 + 50 * ball.corners.size());
}

TEST_CASE("dialects") {
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

TEST_CASE("corners that coincide become one vertex") {
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

TEST_CASE("surfaces of any size") {
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

TEST_CASE("ASCII files that are wrong") {
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

TEST_CASE("binary files that are wrong") {
  const File file;
  io::write_stl(file.path, icosphere(0));
  const std::string good = file.text();
  REQUIRE(complaint(good) == "none");
  SAYS("neither an ASCII STL file", "");
  SAYS("neither an ASCII STL file", "some garbage");
  SAYS("this has 83", good.substr(0, 83));
  SAYS("byte 80: claims 20 triangles, which take 1084 bytes, but the file has 1083", good.substr(0, 1083));
  SAYS("byte 80: claims 20 triangles", good.substr(0, 84));
  SAYS("but the file has 1085", good + "x");
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

TEST_CASE("files that cannot be opened") {
  const auto says = [](auto&& act) {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(says([] { (void)io::read_stl("/no/such/file.stl"); }) == "cannot read /no/such/file.stl");
  CHECK(says([] { (void)io::read_stl(std::filesystem::temp_directory_path()); }).starts_with("cannot read "));
  CHECK(says([] { io::write_stl("/no/such/file.stl", icosphere(0)); }) == "cannot write /no/such/file.stl");
}

}  // namespace
