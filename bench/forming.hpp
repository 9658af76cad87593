// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws.hpp"

#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/solve/system.hpp>
#include <stickslip/time_integration/quasistatic.hpp>

namespace bench {

/// Sheet stretched by a hemispherical punch: axisymmetric, plastic, in contact with punch and die.
template <class Friction_, class Solver>
struct Stretching {
  using Kinematics = stickslip::Axisymmetric;
  using Element = stickslip::MeanDilatation<stickslip::Quad4>;
  using Material = J2Power;
  using Friction = Friction_;
  using Enforcement = stickslip::Penalty;
  using TimeIntegration = stickslip::Quasistatic;
  using LinearSolver = Solver;
};

/// Its balance with 14 x 2 elements, `refine` times as many each way, in a state that yields and touches the tools.
template <class Model>
class Forming {
 public:
  explicit Forming(stickslip::Index refine)
      : body(stickslip::mesh::rectangle({.size = {59.18, 1.0}, .cells = {14 * refine, 2 * refine}}), {},
             J2Power(sheet_metal<J2Power>())),
        pairs(tools(body)),
        system(body, pairs, inertia, {{"left", 0, {}}, {"right", 0, {}}, {"right", 1, {}}}, {}) {
    // A dished sheet, strained by up to 2 %.
    u.setZero(body.mesh().node_count() * 2);
    for (stickslip::Index n = 0; n < body.mesh().node_count(); ++n) {
      const double r = body.mesh().nodes[static_cast<std::size_t>(n)][0] / 59.18;
      u[2 * n + 1] = -3 * (1 - r * r);
    }
    evaluate();
  }
  Forming(const Forming&) = delete;
  Forming& operator=(const Forming&) = delete;

  stickslip::Failure evaluate() { return system.evaluate(u, 0.1, 0.1); }

 private:
  using Pairs = typename stickslip::System<Model>::Pairs;

  static Pairs tools(const stickslip::Bodies<Model>& body) {
    using namespace stickslip;
    const Contact<Model> punch{.side = "top",
                               .tool = rigid::path({50.8, 51.8}, {0, -1}).right(50.8, pi),
                               .motion = [](Real t) { return Vec<Real, 2>(0, -40 * t); },
                               .friction = {.mu = 0.15},
                               .enforcement = {.normal = 1e5, .tangential = 1e4},
                               .name = "punch"};
    const Contact<Model> die{
        .side = "bottom",
        .tool = rigid::path({52.83, -106.35}, {0, 1}).straight(100).right(6.35, pi / 2).straight(50),
        .friction = {.mu = 0.15},
        .enforcement = {.normal = 1e5, .tangential = 1e4},
        .name = "die"};
    Pairs pairs;
    for (const Contact<Model>& c : {punch, die}) pairs.emplace_back(c, body);
    return pairs;
  }

  stickslip::Bodies<Model> body;
  Pairs pairs;
  typename stickslip::System<Model>::Inertia inertia;

 public:
  stickslip::System<Model> system;
  stickslip::Field u;
};

}  // namespace bench
