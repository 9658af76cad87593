// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <doctest/doctest.h>

namespace newton_check {

using namespace scene;

/// Norms of the residuals that a solver was asked to remove, since the last clear().
inline std::vector<Real>& residuals() {
  static std::vector<Real> all;
  return all;
}
template <class Solver>
class Recording : public Solver {
 public:
  bool solve(const Real* b, Real* x) {
    residuals().push_back(Eigen::Map<const Field>(b, size_).norm());
    return Solver::solve(b, x);
  }
  void analyze(const SparseView& m) {
    size_ = m.size;
    Solver::analyze(m);
  }

 private:
  Index size_ = 0;
};

/// Newton's residuals over a run of press and drag, tolerance 1e-10 and below: e_{k+1} <= C e_k^2 from 1e-4 down to
/// round-off. C is of the order of 1: 100 leaves room, and still refuses any linear convergence. In a step in which
/// nodes touch for the first time a lagged bound follows their own pressure from one linear solution to the next, and
/// the residual falls by the factor kappa of their feedback (theory.md, eq. 5.11): there, to a fifth at least.
template <class Friction, class Material, class Solver, class Element = MeanDilatation<Quad4>>
void check(Real mu) {
  using M = Model<Recording<Solver>, Friction, Material, PlaneStrain, Element>;
  auto p = press_and_drag<M>(mu, 0.2, 1.0, {8, 4});
  auto march = p->march({.end = 1, .steps = 20, .tolerance = 1e-10, .detect_lag_instability = false});
  Index pairs = 0, sliding = 0, sticking = 0, touching = 0;
  residuals().clear();
  for (const auto& step : march) {
    CHECK(step.residual <= 1e-10);
    CHECK(step.contact.dissipated >= 0);
    sliding += step.contact.sliding;
    sticking += step.contact.touching - step.contact.sliding;
    // Tools and supports balance.
    const V tool = p->contact_force("tool"), support(p->reaction("top", 0), p->reaction("top", 1));
    CHECK((tool - support).norm() < 1e-8 * tool.norm());
    const Real scale = residuals().empty() ? 1 : p->contact_force("tool").norm();
    residuals().push_back(step.residual * scale);
    Index jumps = step.outer_iterations - 1;  // to the next pass, whose bounds are others
    for (std::size_t k = 0; k + 1 < residuals().size(); ++k) {
      const Real e = residuals()[k] / scale, next = residuals()[k + 1] / scale;
      if (next > e && jumps-- > 0) continue;
      if (e > 1e-4 || e < 1e-10) continue;
      CAPTURE(step.number);
      CAPTURE(e);
      const bool joined = has_lag<M>() && step.contact.touching > touching;
      CHECK(next <= std::max({100 * e * e, joined ? 0.2 * e : 0, 1e-11}));
      ++pairs;
    }
    residuals().clear();
    touching = step.contact.touching;
  }
  CHECK(bool(march.outcome()));
  CHECK(march.report().rejected_steps == 0);
  CHECK(pairs >= 10);  // that many residuals were small enough to be judged
  CHECK(sliding > 20);
  CHECK(sticking > 0);
  if constexpr (!std::is_same_v<Material, Hencky>) CHECK(p->max_plastic_strain() > 1e-3);
}

}  // namespace newton_check
