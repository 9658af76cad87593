// SPDX-License-Identifier: BSL-1.0
// Tangents are assembled where they are factorised: few are for nothing, and few evaluations are made twice.
#include "scene.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>

#include <doctest/doctest.h>

namespace evaluations {
using namespace scene;

template <class M>
RunReport press_and_drag(Real tolerance) {
  Contact<M> disc{.side = "bottom",
                  .tool = rigid::disc({5, -20}, 20),
                  .motion = [](Real t) { return V(std::max(0.0, t - 0.5), 0); },
                  .friction = {.mu = 0.2},
                  .enforcement = {.normal = 1e6, .tangential = 1e5}};
  Problem<M> block{{.body = mesh::rectangle({.size = {10, 5}, .cells = {8, 4}}),
                    .material = material<FiniteJ2<LinearHardening>>(),
                    .contacts = {disc}}};
  block.hold("top", 0).drive("top", 1, [](Real t) { return -0.4 * std::min(t, 0.5); });
  auto march = block.march({.end = 1, .steps = 40, .tolerance = tolerance});
  REQUIRE(bool(march.finish()));
  return march.report();
}

TEST_CASE_TEMPLATE("tangents that nobody factorises and evaluations made twice are rare", M,
                   Model<EigenLdlt, QuasiCoulomb, FiniteJ2<LinearHardening>>,
                   Model<EigenLu, Coulomb, FiniteJ2<LinearHardening>>) {
  for (const Real tolerance : {1e-5, 1e-10}) {
    const RunReport r = press_and_drag<M>(tolerance);
    const WorkCounts& work = r.work;
    MESSAGE(r.steps << " / " << r.iterations << ", " << work.evaluations << " evaluations, " << work.tangents_unused
                    << " tangents unused, " << work.evaluations_repeated << " evaluations repeated, "
                    << work.line_search_cuts << " cuts");
    REQUIRE(r.rejected_steps == 0);
    // One at the start of each solution, one after each linear solution, and those of cut or repeated steps; the probes
    // of a lagging bound are counted besides.
    const Index counted = r.outer_iterations + r.iterations + work.line_search_cuts + work.evaluations_repeated;
    CHECK(work.evaluations >= counted);
    if (!has_lag<M>()) CHECK(work.evaluations == counted);
    CHECK(work.tangents_unused + work.evaluations_repeated - work.line_search_cuts <= 0.08 * work.evaluations);
  }
}

TEST_CASE("a wrong prediction of convergence costs an evaluation and no iteration") {
  const RunReport r = press_and_drag<Model<EigenLu, Coulomb, FiniteJ2<LinearHardening>>>(1e-5);
  CHECK(r.work.evaluations_repeated > 0);
  CHECK(r.iterations == 112);  // as where every tangent is assembled
}

}  // namespace evaluations
