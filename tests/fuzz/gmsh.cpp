// SPDX-License-Identifier: BSL-1.0
// Gmsh files, read in the plane and in space. What is read is a mesh: a body is made of it, and its sides lie on its
// boundary.
#include <stickslip/body/body.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/io/gmsh.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/material/neo_hookean.hpp>
#include <stickslip/mesh/coincident_nodes.hpp>
#include <stickslip/mesh/facet.hpp>

#include <cmath>
#include <set>

#include "target.hpp"

using namespace stickslip;

namespace {

template <class Kinematics, class Cell>
void read(std::string_view bytes) {
  constexpr int dim = Kinematics::dim;
  using Read = Mesh<dim, Cell::nodes>;
  fuzz::reader<std::runtime_error>(
      bytes, "input.msh", [](std::istream& in, const std::string& name) { return io::read_gmsh<dim>(in, name); },
      [](const Read& mesh) {
        std::set<Index> of_cells;
        const auto check = [&](Index n) { fuzz::require(n >= 0 && n < mesh.node_count(), "nodes exist"); };
        for (const auto& x : mesh.nodes) fuzz::require(x.allFinite(), "nodes are finite");
        for (const auto& cell : mesh.cells)
          for (const Index n : cell) check(n), of_cells.insert(n);
        fuzz::require(of_cells.size() == mesh.nodes.size(), "each node belongs to a cell");
        fuzz::require(mesh::coincident_nodes(mesh).nodes < mesh.node_count(), "a node lies where it lies");
        for (const auto& [name, side] : mesh.sides) {
          fuzz::require(!side.nodes.empty() && !name.empty(), "sides have a name and nodes");
          std::set<Index> once;
          for (const Index n : side.nodes) check(n), once.insert(n);
          fuzz::require(once.size() == side.nodes.size(), "a side has each node once");
          for (const auto& facet : side.facets)
            for (const Index n : facet) fuzz::require(once.count(n) == 1, "a side has the nodes of its facets");
        }
        // The Jacobians are what the body looks at, so that it must take the mesh.
        try {
          const Kinematics kinematics{};
          const BodyOf<Kinematics, FullyIntegrated<Cell>, NeoHookean, Symmetry::symmetric> body(
              mesh, kinematics, NeoHookean{.young = 1, .poisson = 0.3});
          for (const auto& [name, side] : mesh.sides)
            fuzz::require(nodal_areas(body.mesh(), kinematics, name).size() == side.nodes.size(), "nodes have areas");
        } catch (const std::invalid_argument& error) {
          fuzz::broken(error.what());
        }
      });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  read<PlaneStrain, Quad4>(bytes);
  read<ThreeDimensional, Hex8>(bytes);
  return 0;
}
