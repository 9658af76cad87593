// SPDX-License-Identifier: BSL-1.0
// Tools of triangles under a body of hexahedra: built where Boost.Geometry is.
#include "../physics/scene.hpp"
#include "suite.hpp"

#include <stickslip/element/hex8.hpp>
#include <stickslip/geometry/triangulated.hpp>
#include <stickslip/kinematics/three_dimensional.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

namespace {

using namespace scene;
using stability::Case;
using stability::HardCase;
using V3 = Vec<Real, 3>;
struct Faceted : Model<EigenLu, Coulomb, Hencky, ThreeDimensional, MeanDilatation<Hex8>> {
  using Tool = rigid::AnyOf<rigid::Revolution, rigid::Triangulated>;
};
const char* const model = "Coulomb, EigenLu, Hex8, Triangulated";

// A square of `cells` x `cells` x 2 triangles about the origin, its normal up, its corners where `at` puts them.
template <class At>
rigid::Triangles sheet(Index cells, At&& at) {
  rigid::Triangles out;
  for (Index i = 0; i <= cells; ++i)
    for (Index j = 0; j <= cells; ++j)
      out.vertices.push_back(at(Real(2 * i - cells) / Real(cells), Real(2 * j - cells) / Real(cells)));
  for (Index i = 0; i < cells; ++i)
    for (Index j = 0; j < cells; ++j) {
      const Index a = i * (cells + 1) + j, b = a + cells + 1;
      out.corners.push_back({a, b, b + 1});
      out.corners.push_back({a, b + 1, a + 1});
    }
  return out;
}
// A box about the origin: six sheets with vertices of their own put together.
rigid::Triangles box(const V3& half, Index cells) {
  rigid::Triangles out;
  for (const int normal : {0, 1, 2})
    for (const Real sign : {-1.0, 1.0}) {
      const int a = (normal + 1) % 3, b = (normal + 2) % 3;
      const auto side = sheet(cells, [&](Real s, Real t) {
        V3 x = V3::Zero();
        x[normal] = sign * half[normal];
        x[a] = half[a] * (sign > 0 ? s : t);
        x[b] = half[b] * (sign > 0 ? t : s);
        return x;
      });
      std::vector<Index> number;
      for (const V3& x : side.vertices) {
        const auto same = std::find_if(out.vertices.begin(), out.vertices.end(),
                                       [&](const V3& y) { return (x - y).norm() < 1e-9 * half.norm(); });
        number.push_back(Index(same - out.vertices.begin()));
        if (same == out.vertices.end()) out.vertices.push_back(x);
      }
      for (const auto& [i, j, k] : side.corners)
        out.corners.push_back({number[std::size_t(i)], number[std::size_t(j)], number[std::size_t(k)]});
    }
  return out;
}

// A block of 4 x 4 x 2 on a tool, pressed down by 0.05 and drawn by `far`.
std::unique_ptr<Problem<Faceted>> block(const Faceted::Tool& tool, const V3& far, Real mu) {
  auto p = std::make_unique<Problem<Faceted>>(Problem<Faceted>::Parameters{
      .body = mesh::box({.size = {4, 4, 2}, .cells = {4, 4, 1}}),
      .material = {.young = 1000, .poisson = 0.3},
      .contacts = {{.side = "back",
                    .tool = tool,
                    .friction = {.mu = mu},
                    .enforcement = {.normal = 1e5, .tangential = 1e4, .per = PenaltyPer::area},
                    .name = "tool"}}});
  for (const Index i : {0, 1, 2})
    p->drive("front", i,
             [=](Real t) { return std::max(0.0, t - 1) * far[i] - (i == 2 ? 0.05 * std::min(1.0, t) : 0); });
  return p;
}
void run(Case& c, Problem<Faceted>& p, Index count) {
  c.completes(p.march({.end = 1, .steps = 3, .tolerance = 1e-10}));
  c.completes(p.march({.end = 2, .steps = count, .tolerance = 1e-10}));
}
V3 support(const Problem<Faceted>& p) {
  return {p.reaction("front", 0), p.reaction("front", 1), p.reaction("front", 2)};
}

const HardCase joints("space: tools", "a table of 5000 triangles whose vertices and edges lie under the nodes", model,
                      "field and force of a plane", [](Case& c) {
                        const auto table = sheet(50, [](Real s, Real t) { return V3(2 + 12.5 * s, 2 + 12.5 * t, 0); });
                        auto many = block(rigid::Triangulated(table), {1, 0.5, 0}, 0.2),
                             one = block(rigid::plane({0, 0, 0}, {0, 0, 1}), {1, 0.5, 0}, 0.2);
                        run(c, *many, 10);
                        run(c, *one, 10);
                        c.small((many->displacement() - one->displacement()).norm() / one->displacement().norm(), 1e-9,
                                "field");
                        c.small((many->contact_force("tool") - one->contact_force("tool")).norm() /
                                    one->contact_force("tool").norm(),
                                1e-9, "force");
                      });
const HardCase corner("space: tools", "nodes that leave a box of triangles over its edges and its corner", model,
                      "support and tool in balance; the few nodes left carry it", [](Case& c) {
                        for (const Index cells : {1, 4}) {
                          rigid::Triangles table = box({3, 3, 1}, cells);
                          for (V3& x : table.vertices) x += V3(1.3, 1.2, -1);
                          auto p = block(rigid::Triangulated(table), {3, 2.6, 0}, 0.2);
                          run(c, *p, 40);
                          c.small((support(*p) - p->contact_force("tool")).norm() / p->contact_force("tool").norm(),
                                  1e-6, "balance");
                          Index touching = 0;
                          for (const auto& n : p->contact("tool").states()) touching += n.touching ? 1 : 0;
                          c.require(touching > 0 && touching < 9, std::to_string(touching) + " are left");
                        }
                      });
const HardCase thrown("space: tunnelling", "a thin box of triangles that turns, from 50 element lengths away", model,
                      "field of 1000 small steps, for 1 and 3 steps", [](Case& c) {
                        const auto hit = [&](Index count) {
                          auto p =
                              std::make_unique<Problem<Faceted>>(
                                  Problem<Faceted>::Parameters{
                                      .body = mesh::box({.size = {4, 4, 2}, .cells = {4, 4, 2}}),
                                      .material = {.young = 1000, .poisson = 0.3},
                                      .contacts = {
                                          {.side = "front",
                                           .tool = rigid::Triangulated(box({3, 3, 0.5}, 1)),
                                           .motion =
                                               [](Real t) {
                                                 const Real angle = 0.4 * pi * (1 - t) + 0.1;
                                                 rigid::Pose<3> pose;
                                                 pose.rotation << std::cos(angle), 0, std::sin(angle), 0, 1, 0,
                                                     -std::sin(angle), 0, std::cos(angle);
                                                 pose.translation = V3(2, 2.3, 52.2 - 50 * t);
                                                 return pose;
                                               },
                                           .friction = {.mu = 0},
                                           .enforcement = {.normal = 1e5, .tangential = 1, .per = PenaltyPer::area},
                                           .name = "tool"}}});
                          for (const Index i : {0, 1, 2}) p->hold("back", i);
                          c.completes(p->march({.end = 1, .steps = count, .tolerance = 1e-10}));
                          return p;
                        };
                        const auto slow = hit(1000);
                        c.require(slow->contact_force("tool").norm() > 30, "it presses");
                        for (const Index few : {1, 3}) {
                          const auto quick = hit(few);
                          c.small((quick->displacement() - slow->displacement()).norm() / slow->displacement().norm(),
                                  1e-7, "field in " + std::to_string(few));
                        }
                      });
const HardCase degenerate("space: failures", "triangles without an area, with a corner twice, missing or not a number",
                          "Triangulated", "input errors that name the triangle", [](Case& c) {
                            const auto with = [](auto change) {
                              rigid::Triangles table = sheet(2, [](Real s, Real t) { return V3(s, t, 0); });
                              change(table);
                              (void)rigid::Triangulated(table);
                            };
                            c.complains([&] { with([](auto& t) { t.corners = {}; }); }, "triang");
                            c.complains([&] { with([](auto& t) { t.corners[3] = {1, 1, 4}; }); }, "triangle 3");
                            c.complains([&] { with([](auto& t) { t.corners[3] = {0, 1, 2}; }); }, "triangle 3");
                            c.complains([&] { with([](auto& t) { t.corners[3] = {0, 1, 9}; }); }, "triangle 3");
                            c.complains([&] { with([](auto& t) { t.corners[3] = {0, -1, 4}; }); }, "triangle 3");
                            c.complains([&] { with([](auto& t) { t.vertices[8][1] = std::nan(""); }); }, "triangle");
                            c.complains([&] { with([](auto& t) { t.vertices[8][1] = HUGE_VAL; }); }, "triangle");
                          });

}  // namespace
