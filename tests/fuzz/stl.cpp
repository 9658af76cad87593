// SPDX-License-Identifier: BSL-1.0
// STL files. What is read is a surface of numbered, finite vertices without needles; a tool is made of it or refused by
// a sentence, and a tool can be asked for its distance.
#include <stickslip/geometry/triangulated.hpp>
#include <stickslip/io/stl.hpp>

#include "target.hpp"

using namespace stickslip;

namespace {

void use(const rigid::Triangles& surface) {
  fuzz::require(!surface.corners.empty(), "a surface has triangles");
  for (const auto& x : surface.vertices) fuzz::require(x.allFinite(), "vertices are finite");
  for (const auto& [a, b, c] : surface.corners) {
    for (const Index n : {a, b, c})
      fuzz::require(n >= 0 && static_cast<std::size_t>(n) < surface.vertices.size(), "corners are vertices");
    fuzz::require(a != b && b != c && c != a, "triangles have three corners");
  }
  try {
    const rigid::Triangulated tool(surface);
    (void)tool.distance(Vec<Real, 3>(surface.vertices[0] + Vec<Real, 3>(0.25, 0.5, -0.125)));
  } catch (const std::invalid_argument& error) {
    fuzz::require_sentence(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (const auto outside : {io::Outside::agreed, io::Outside::normals})
    fuzz::reader<std::runtime_error>(
        bytes, "input.stl",
        [outside](std::istream& in, const std::string& name) { return io::read_stl(in, name, 1e-6, outside); }, use);
  return 0;
}
