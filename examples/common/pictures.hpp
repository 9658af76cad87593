// SPDX-License-Identifier: BSL-1.0
// Pictures by gnuplot, each as PNG and SVG, with the data and the script beside them.
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/io/new_file.hpp>
#include <stickslip/problem.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace examples {

/// Writes `NAME.gp` into the directory and runs gnuplot on it for a PNG and an SVG. `body` is what follows the set-up
/// of the terminal. Throws std::runtime_error when gnuplot is missing or refuses.
void draw(const std::filesystem::path& directory, const std::string& name, const std::string& body, int width = 900,
          int height = 600);

/// Mean plastic strain of every cell; zeros where the material has none.
template <class Body>
std::vector<double> plastic_strains(const Body& body, const stickslip::Field& u) {
  const auto cells = static_cast<std::size_t>(body.mesh().cell_count());
  std::vector<double> value(cells, 0.0), volume(cells, 0.0);
  if constexpr (requires(typename Body::State s) { s.plastic_strain; })
    body.visit_points(u, [&](stickslip::Index e, int, const auto&, const auto& state, double weight) {
      value[static_cast<std::size_t>(e)] += weight * state.plastic_strain;
      volume[static_cast<std::size_t>(e)] += weight;
    });
  for (std::size_t e = 0; e < cells; ++e)
    if (volume[e] > 0) value[e] /= volume[e];
  return value;
}

/// The patches of a picture: four nodes and the cell that they belong to. In the plane the cells themselves, in space
/// the facets of the side `section`, which lies in the half-plane of the first and the last coordinate.
template <class MeshType>
auto patches(const MeshType& mesh, [[maybe_unused]] const std::string& section) {
  std::vector<std::pair<std::array<stickslip::Index, 4>, std::size_t>> found;
  if constexpr (MeshType::dim == 2) {
    for (std::size_t e = 0; e < mesh.cells.size(); ++e) found.emplace_back(mesh.cells[e], e);
  } else {
    const auto sorted = [](auto nodes) {
      std::sort(nodes.begin(), nodes.end());
      return nodes;
    };
    const auto& side = mesh.side(section);
    const std::set<stickslip::Index> listed(side.nodes.begin(), side.nodes.end());
    std::map<std::array<stickslip::Index, 4>, std::size_t> cell_behind;
    for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
      std::vector<stickslip::Index> on_side;
      for (const auto n : mesh.cells[e])
        if (listed.count(n) > 0) on_side.push_back(n);
      if (on_side.size() == 4) cell_behind[sorted(std::array{on_side[0], on_side[1], on_side[2], on_side[3]})] = e;
    }
    for (const auto& facet : side.facets) found.emplace_back(facet, cell_behind.at(sorted(facet)));
  }
  return found;
}

/// Data of the body's mesh deformed by u, a gnuplot pm3d patch each: x, y, plastic strain (mean over the points). Of a
/// mesh in space its `section`, see patches().
template <class Body>
void write_mesh_data(const std::filesystem::path& path, const Body& body, const stickslip::Field& u,
                     const std::string& section) {
  constexpr int dim = Body::dim;
  const auto& mesh = body.mesh();
  const std::vector<double> value = plastic_strains(body, u);
  stickslip::io::NewFile file(path);
  std::ostream& out = file.stream();
  out << "# x y plastic_strain x_at_start y_at_start: one patch a cell\n";
  for (const auto& [nodes, cell] : patches(mesh, section)) {
    for (const std::size_t a : {0u, 1u, 3u, 2u}) {
      const auto& start = mesh.nodes[static_cast<std::size_t>(nodes[a])];
      const auto moved = stickslip::at_node<dim>(u, nodes[a]);
      out << start[0] + moved[0] << ' ' << start[dim - 1] + moved[dim - 1] << ' ' << value[cell] << ' ' << start[0]
          << ' ' << start[dim - 1] << '\n';
      if (a == 1) out << '\n';
    }
    out << "\n\n";
  }
  file.place();
}

/// Name of the file that holds the deformed mesh at a travel: mesh_10.0.dat.
std::string shot_name(double travel_mm);

/// Data of the tools at a time, a block each. In space they are surfaces of revolution about the last coordinate's
/// axis.
template <class Model>
void write_tool_data(const std::filesystem::path& path, const stickslip::Scene<Model>& problem, double reach) {
  stickslip::io::NewFile file(path);
  std::ostream& out = file.stream();
  problem.visit_contacts([&](const auto& pair) {
    if constexpr (requires { pair.tool(); }) {  // else a surface of a body, which is drawn with it
      const auto pose = pair.motion().at(problem.time());
      if constexpr (Model::Kinematics::dim == 2)
        for (const auto& p : pair.tool().sample(reach / 200, reach)) {
          const stickslip::Vec<double, 2> x = pose.in_space(p);
          out << x[0] << ' ' << x[1] << " 0\n";
        }
      else
        for (const auto& p : pair.tool().meridian().sample(reach / 200, reach))
          out << p[0] << ' ' << p[1] + pose.translation[2] << " 0\n";
      out << "\n\n";
    }
  });
  file.place();
}

}  // namespace examples
