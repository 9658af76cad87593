// SPDX-License-Identifier: BSL-1.0
// Pictures by gnuplot, each as PNG and SVG, with the data and the script beside them.
#pragma once

#include <stickslip/problem.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace examples {

/// Writes `NAME.gp` into the directory and runs gnuplot on it for a PNG and an SVG. `body` is what follows the set-up
/// of the terminal. Throws std::runtime_error when gnuplot is missing or refuses.
void draw(const std::filesystem::path& directory, const std::string& name, const std::string& body, int width = 900,
          int height = 600);

/// Data of the deformed mesh, a gnuplot pm3d patch a cell: x, y, plastic strain (mean over the points).
template <class Model>
void write_mesh_data(const std::filesystem::path& path, const stickslip::Scene<Model>& problem) {
  const auto& mesh = problem.body().mesh();
  std::vector<double> value(mesh.cells.size(), 0.0), volume(mesh.cells.size(), 0.0);
  if constexpr (requires(typename stickslip::Problem<Model>::BodyType::State s) { s.plastic_strain; })
    problem.body().visit_points(problem.displacement(),
                                [&](stickslip::Index e, int, const auto&, const auto& state, double weight) {
                                  value[static_cast<std::size_t>(e)] += weight * state.plastic_strain;
                                  volume[static_cast<std::size_t>(e)] += weight;
                                });
  std::ofstream out(path);
  out << "# x y plastic_strain x_at_start y_at_start: one patch a cell\n";
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const auto& cell = mesh.cells[e];
    for (const std::size_t a : {0u, 1u, 3u, 2u}) {
      const auto n = cell[a];
      const stickslip::Vec<double, 2> x = mesh.nodes[static_cast<std::size_t>(n)] + problem.displacement(n);
      out << x[0] << ' ' << x[1] << ' ' << (volume[e] > 0 ? value[e] / volume[e] : 0.0) << ' '
          << mesh.nodes[static_cast<std::size_t>(n)][0] << ' ' << mesh.nodes[static_cast<std::size_t>(n)][1] << '\n';
      if (a == 1) out << '\n';
    }
    out << "\n\n";
  }
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

/// Name of the file that holds the deformed mesh at a travel: mesh_10.0.dat.
std::string shot_name(double travel_mm);

/// Data of the tools at a time, a block each.
template <class Model>
void write_tool_data(const std::filesystem::path& path, const stickslip::Scene<Model>& problem, double reach) {
  std::ofstream out(path);
  problem.visit_contacts([&](const auto& pair) {
    const auto pose = pair.motion().at(problem.time());
    for (const auto& p : pair.tool().sample(reach / 200, reach)) {
      const stickslip::Vec<double, 2> x = pose.rotation * p + pose.translation;
      out << x[0] << ' ' << x[1] << " 0\n";
    }
    out << "\n\n";
  });
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace examples
