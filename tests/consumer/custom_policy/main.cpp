// SPDX-License-Identifier: BSL-1.0
//
// The conical extrusion with a friction law, a hardening law and a linear solver that stickslip does not have.
//
// The three stand between the two rulers below, whose lines a test counts. The rest asks three questions. Do they meet
// the contracts? Are their derivatives what they say? And is the physics right: at the limits where the laws become
// those of the library the forces must be the library's, away from them the saturated wall must resist less than
// Coulomb's and more than a smooth one, and the work of the ram must be found again.

#include <stickslip/stickslip.hpp>
#include <stickslip/verify/energy.hpp>
#include <stickslip/verify/tangent.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace stickslip;

// --- policies: begin
// Friction: mu p at light pressure, a shear stress k at heavy, as of Wanheim and Bay's asperities that merge.
struct Saturating {
  using Role = role::Friction;
  using Law = Saturating;
  using Pressure = LastConverged;  // so the tangent is symmetric
  static constexpr bool active = true, depends_on_pressure = true, depends_on_slip = false, depends_on_area = true;
  Real mu = 0, k = 0;  // [-], [stress]
  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    const S lost = expm1(at.pressure * (-mu / (k * at.area)));
    return {lost * (-k * at.area), (lost + S(1)) * mu, S(0)};
  }
};
// Hardening: Ludwik's power, begun at a small strain so that the slope is finite: yield + strength ((e + p)^n - e^n).
struct Ludwik {
  using Role = role::Hardening;
  Real yield = 0, strength = 0, e = 0, n = 1;  // [stress], [stress], [-], [-]
  template <class S>
  FlowStress<S> flow(const S& p) const {
    const S power = pow(p + S(e), n);
    return {(power - S(std::pow(e, n))) * strength + S(yield), power * (strength * n) / (p + S(e))};
  }
  Real work(Real p) const {
    const Real area = (std::pow(e + p, n + 1) - std::pow(e, n + 1)) / (n + 1);
    return yield * p + strength * (area - std::pow(e, n) * p);
  }
};
// Linear solver: L D L^T without the zeros that stand before the first entry of each row.
struct Skyline {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric, storage = Symmetry::symmetric;
  Eigen::MatrixXd l;         // L below the diagonal, D on it
  std::vector<Index> first;  // entry of each row
  void analyze(const SparseView& m) { first.resize(m.size); }
  Factorization factorize(const SparseView& m) {
    l.setZero(m.size, m.size);
    for (Index j = m.size; j-- > 0;)
      for (Index k = m.column_start[j]; k < m.column_start[j + 1]; ++k) {
        l(m.row[k], j) = m.values[k];
        first[m.row[k]] = j;
      }
    for (Index i = 0; i < m.size; ++i)
      for (Index j = first[i]; j < i; ++j) {
        for (Index k = std::max(first[i], first[j]); k < j; ++k) l(i, j) -= l(i, k) * l(k, k) * l(j, k);
        l(i, j) /= l(j, j);
        l(i, i) -= l(i, j) * l(i, j) * l(j, j);
      }
    if (!l.allFinite()) return Factorization::failed;
    return l.diagonal().minCoeff() > 0 ? Factorization::done : Factorization::indefinite;
  }
  bool solve(const Real* b, Real* x) {
    Eigen::Map<Field> y(x, l.rows());
    y = l.triangularView<Eigen::UnitLower>().solve(Eigen::Map<const Field>(b, l.rows()));
    y.array() /= l.diagonal().array();
    l.transpose().triangularView<Eigen::UnitUpper>().solveInPlace(y);
    return y.allFinite();
  }
};
// --- policies: end

static_assert(FrictionPolicy<Saturating> && friction_symmetry<Saturating>() == Symmetry::symmetric);
static_assert(HardeningPolicy<Ludwik> && MaterialPolicy<FiniteJ2<Ludwik>, Planar>);
static_assert(LinearSolverPolicy<Skyline>);

struct Library : QuasistaticDefaults {
  using Kinematics = Axisymmetric;
  using Material = FiniteJ2<LinearHardening>;
  using Friction = QuasiCoulomb;
};
struct Custom : Library {
  using Material = FiniteJ2<Ludwik>;
  using Friction = Saturating;
  using LinearSolver = Skyline;
};

int wrong = 0;
void check(bool right, const char* what, double number) {
  std::printf("%-5s %s: %.3g\n", right ? "ok" : "WRONG", what, number);
  if (!right) ++wrong;
}

// The derivatives that the laws claim, against those of dual numbers and differences.
void check_derivatives(const Saturating& friction, const Ludwik& hardening) {
  // Fed with the pressure of the iterate, or its derivative would not be looked at.
  using Current = WithPressure<Saturating, CurrentPressure>;
  const auto disc = rigid::disc({0, -5}, 5);
  const Penalty penalty{.normal = 1e4, .tangential = 1e4};
  const verify::SingleNode<Penalty, Saturating, Current, rigid::Profile> node{
      .enforcement = penalty, .law = friction, .friction = {}, .tool = disc, .area = 20};
  const auto slides = verify::contact_tangent(node, {{0, 0.01}, {0, -0.2}, {0.5, -0.3}});
  check(std::max(slides.by_duals, slides.by_differences) < 1e-8, "error of the tangent of a sliding node",
        std::max(slides.by_duals, slides.by_differences));

  const FiniteJ2<Ludwik> metal{.young = 68956, .poisson = 0.32, .hardening = hardening};
  verify::DeformationPath<Planar> path(2, Tensor<Real, Planar>::identity());
  path[0](0, 1) = 0.1;
  path[1](0, 1) = 0.3;
  const auto flows = verify::material_tangent(metal, path);
  check(std::max(flows.by_duals, flows.by_differences) < 1e-8, "error of the material's tangent",
        std::max(flows.by_duals, flows.by_differences));
  check(verify::material_memory(metal, path) < 1e-12, "change of the stress on its own memory",
        verify::material_memory(metal, path));
  check(verify::material_objectivity(metal, path, 0.7) < 1e-12, "change of the stress under a rotation",
        verify::material_objectivity(metal, path, 0.7));
}

constexpr Real radius = 50.8, length = 254, travel = 178;  // [mm]
const Vec<Real, 2> along_wall(-std::sin(5 * pi / 180), std::cos(5 * pi / 180));

struct Run {
  std::vector<Real> force;  // on the ram, at each mm of its way [N]
  Real shear = 0;           // largest friction force on the wall [N]
  Real work = 0;            // of the ram [N mm]
  Real lost = 0;            // part of it that is found neither in the billet nor at the wall [-]
};

// A billet is pushed into a cone of half-angle 5 degrees, a millimetre a step.
template <class Model>
Run extrude(const char* name, decltype(Model::Material::hardening) hardening, typename Model::Friction::Law friction) {
  Problem<Model> billet{{
      .body = mesh::rectangle({.size = {radius, length}, .cells = {4, 20}}),
      .material = {.young = 68956, .poisson = 0.32, .hardening = hardening},
      .contacts = {{.side = "right",
                    .tool = rigid::line({radius, length}, along_wall),
                    .friction = friction,
                    .enforcement = {.normal = 1e7, .tangential = 1e6}}},
  }};
  billet.hold("left", 0).drive("bottom", 1, [](Real t) { return travel * t; });

  Run run;
  auto march = billet.march({.end = 1, .steps = static_cast<Index>(travel), .tolerance = 1e-8});
  verify::EnergyBalance ledger(billet);
  Real time = 0, force = 0;
  for (const StepReport& step : march) {
    ledger.update(step);
    run.work += (step.time - time) * travel * (force + billet.reaction("bottom", 1)) / 2;
    time = step.time;
    force = billet.reaction("bottom", 1);
    // At every millimetre: a first contact may have cut the step to it.
    if (std::abs(travel * time - std::round(travel * time)) < 1e-6) run.force.push_back(force);
    run.shear = std::max(run.shear, std::abs(billet.contact_force("right").dot(along_wall)));
  }
  const auto& e = ledger.energies();
  run.lost = 1 - (e.elastic + e.plastic + e.friction + e.penalty) / run.work;
  std::printf("\n%s: %d steps, %d iterations, %.1f kN after %.0f mm\n", name, march.report().steps,
              march.report().iterations, force / 1e3, travel * time);
  std::printf("  work %.1f kJ; plastic %.1f, friction %.1f, elastic %.1f, penetration %.1f\n", run.work / 1e6,
              e.plastic / 1e6, e.friction / 1e6, e.elastic / 1e6, e.penalty / 1e6);
  if (!march.outcome() || run.force.size() != static_cast<std::size_t>(travel)) {
    std::printf("WRONG %s, forces at %zu places\n", march.outcome().message().c_str(), run.force.size());
    std::exit(1);  // what follows compares them one by one
  }
  return run;
}

// The largest ratio of two runs' forces, but for the first ones.
Real largest_ratio(const Run& a, const Run& b, std::size_t first = 0) {
  Real ratio = 0;
  for (std::size_t i = first; i < a.force.size(); ++i) ratio = std::max(ratio, a.force[i] / b.force[i]);
  return ratio;
}

int main() {
  constexpr Real never = 1e12;  // a shear stress that no wall reaches
  const Ludwik metal{.yield = 31, .strength = 260, .e = 0.01, .n = 0.6};
  const Saturating wall{.mu = 0.1, .k = 31 / std::sqrt(3.0)};
  check_derivatives(wall, metal);

  const Run library = extrude<Library>("library", {.yield = 31, .modulus = 261.2}, {.mu = 0.1});
  const Run limit = extrude<Custom>("own policies at the library's limit",
                                    {.yield = 31, .strength = 261.2, .e = 0.01, .n = 1}, {.mu = 0.1, .k = never});
  const Run own = extrude<Custom>("own policies", metal, wall);
  const Run coulomb = extrude<Custom>("own metal at Coulomb's wall", metal, {.mu = wall.mu, .k = never});
  const Run smooth = extrude<Custom>("own metal at a smooth wall", metal, {.mu = 0, .k = never});

  std::printf("\n");
  const Real apart = std::max(largest_ratio(limit, library), largest_ratio(library, limit)) - 1;
  check(apart < 1e-8, "distance of the limit from the library, any force", apart);
  // Where the stress in the wall stays below the cap, forces are equal. The first millimetre presses an edge in within one
  // step, at which Newton's method searches so long that the bounds stay where they are then; the step's lag says so.
  check(largest_ratio(own, coulomb, 1) < 1 + 1e-8, "own force over that at Coulomb's wall, largest",
        largest_ratio(own, coulomb, 1));
  check(largest_ratio(smooth, own) < 1 + 1e-8, "smooth force over own, largest", largest_ratio(smooth, own));
  const Real full = own.shear / (wall.k * 2 * pi * radius * length);
  check(full < 1 && full > 0.5, "friction over what the whole flank bears, largest", full);
  check(std::abs(own.lost) < 5e-3, "work that is not found again", own.lost);
  return wrong == 0 ? 0 : 1;
}
