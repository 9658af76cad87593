// SPDX-License-Identifier: BSL-1.0
// Terms of a user's own in the balance: stencils that change from step to step, a condensed unknown, an unknown that is
// no node's; and linear constraints between components.
#include "scene.hpp"

#include <stickslip/dofs/condensed_unknowns.hpp>
#include <stickslip/element/fully_integrated.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/linear_solver/eigen_lu.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>

namespace terms {
using namespace scene;

// A spring along y on the mean motion of some nodes, which drags them along x by a part of its force: a follower of
// friction's kind, so that the derivative is not symmetric. The force is a condensed unknown. From step to step another
// number of nodes is in the mean.
struct MeanSpring {
  static constexpr Symmetry symmetry = Symmetry::general;
  std::vector<Index> nodes{};  // all that may be in it
  Real stiffness = 0, drag = 0;
  int changes = 0;

  MeanSpring() = default;
  MeanSpring(std::vector<Index> of, Real k, Real part) : nodes(std::move(of)), stiffness(k), drag(part) {}
  Index unknowns() const { return 0; }
  void number(Index) {}
  bool update(const Field&, Real time) {
    const std::size_t now = 1 + static_cast<std::size_t>(std::lround(8 * time)) / 2 % nodes.size();
    if (now == count_) return false;
    count_ = now;
    ++changes;
    return true;
  }
  void couple(SparsityPattern& pattern) const { pattern.couple(components()); }
  void begin_iteration() { force_ = converged_; }
  void predict(const Field& du, Real fraction) {
    start_ = force_;
    step_ = fraction * residual_ + stiffness * mean(du);
  }
  void set_step(Real length) { force_ = start_ + length * step_; }
  Real constraint_merit() const { return 0.05 * 0.05 * residual_ * residual_; }
  template <class Evaluation>
  Failure evaluate(const Evaluation& ev, const IndexMap& dofs, Field& forces) {
    const Real asked = stiffness * mean(ev.u);
    if (!ev.constraint_force) force_ = asked;
    residual_ = asked - force_;
    const Real weight = 1 / Real(count_);
    for (std::size_t k = 0; k < count_; ++k)
      for (int i = 0; i < 2; ++i) {
        const Real share = weight * (i == 0 ? drag : 1);
        forces[nodes[k] * 2 + i] += share * force_;
        if (ev.constraint_force) (*ev.constraint_force)[nodes[k] * 2 + i] += share * residual_;
        if (ev.driven) forces[nodes[k] * 2 + i] += share * stiffness * mean(*ev.driven);
      }
    if (ev.want == Want::residual) return {};
    const std::vector<Index> c = components();
    ev.matrix.add(dofs, c, [&](Index a, Index b) {
      return b % 2 == 0 ? 0 : weight * weight * stiffness * (a % 2 == 0 ? drag : 1);
    });
    return {};
  }
  void commit() { converged_ = force_; }
  void serialize(Archive& archive) { archive("mean spring", converged_); }
  Real force() const { return converged_; }

 private:
  std::vector<Index> components() const {
    std::vector<Index> c;
    for (std::size_t k = 0; k < count_; ++k) c.insert(c.end(), {nodes[k] * 2, nodes[k] * 2 + 1});
    return c;
  }
  Real mean(const Field& u) const {
    Real sum = 0;
    for (std::size_t k = 0; k < count_; ++k) sum += u[nodes[k] * 2 + 1];
    return sum / Real(count_);
  }
  std::size_t count_ = 0;
  Real force_ = 0, converged_ = 0, residual_ = 0, start_ = 0, step_ = 0;
};
static_assert(Term<MeanSpring>);

// A force on some nodes, alike on each, whose size is an unknown: the mean of their motion along y is prescribed.
struct LoadFactor {
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  std::vector<Index> nodes{};
  Real speed = 0;

  LoadFactor() = default;
  LoadFactor(std::vector<Index> of, Real v) : nodes(std::move(of)), speed(v) {}
  Index unknowns() const { return 1; }
  void number(Index first) { own_ = first; }
  bool update(const Field&, Real) { return false; }
  void couple(SparsityPattern& pattern) const { pattern.couple(components()); }
  void begin_iteration() {}
  void predict(const Field&, Real) {}
  void set_step(Real) {}
  Real constraint_merit() const { return 0; }
  template <class Evaluation>
  Failure evaluate(const Evaluation& ev, const IndexMap& dofs, Field& forces) {
    const Real weight = 1 / Real(nodes.size());
    forces[own_] -= speed * ev.time;
    for (const Index n : nodes) {
      forces[n * 2 + 1] += weight * ev.u[own_];
      forces[own_] += weight * ev.u[n * 2 + 1];
    }
    if (ev.want != Want::residual)
      ev.matrix.add(dofs, components(), [&](Index a, Index b) { return (a == 0) == (b == 0) ? 0 : weight; });
    return {};
  }
  void commit() {}
  void serialize(Archive&) {}
  Index own() const { return own_; }

 private:
  std::vector<Index> components() const {
    std::vector<Index> c{own_};
    for (const Index n : nodes) c.push_back(n * 2 + 1);
    return c;
  }
  Index own_ = 0;
};
static_assert(Term<LoadFactor>);

struct Sprung : Model<EigenLu, Frictionless, Hencky, PlaneStrain, FullyIntegrated<Quad4>, NoContact> {
  using Terms = TermTypes<MeanSpring>;
};
struct Loaded : Model<EigenLu, Frictionless, Hencky, PlaneStrain, FullyIntegrated<Quad4>, NoContact> {
  using Terms = TermTypes<LoadFactor>;
};
using Plain = Model<EigenLu, Frictionless, Hencky, PlaneStrain, FullyIntegrated<Quad4>, NoContact>;
static_assert(system_symmetry<Sprung> == Symmetry::general && system_symmetry<Loaded> == Symmetry::symmetric);
static_assert(sizeof(Problem<Plain>::Parameters) ==
              sizeof(Problem<Lone<EigenLdlt, Hencky, PlaneStrain, FullyIntegrated<Quad4>>>::Parameters));

mesh::Rectangle block() {
  return {.size = {4, 2}, .cells = {8, 4}};
}
constexpr Hencky elastic{.young = 1000, .poisson = 0.2};

TEST_CASE("a term whose stencil changes from step to step is in balance, with its derivative") {
  const auto mesh = mesh::rectangle(block());
  Problem<Sprung> p{{.body = mesh, .material = elastic, .terms = {MeanSpring(mesh.side("top").nodes, 300, 0.4)}}};
  p.hold("bottom", 0).hold("bottom", 1).load("right", 1, [](Real t) { return 30 * t; });
  auto march = p.march({.end = 1, .steps = 8, .tolerance = 1e-11});
  Index revision = 0, changes = 0;
  for (const StepReport& step : march) {
    CHECK(step.iterations <= 5);  // quadratic
    if (p.system().tangent().revision != revision) ++changes;
    revision = p.system().tangent().revision;
    const Real spring = std::get<0>(p.terms()).force();
    CHECK(p.reaction("bottom", 1) + 30 * step.time - spring == doctest::Approx(0).scale(30).epsilon(1e-9));
    CHECK(p.reaction("bottom", 0) - 0.4 * spring == doctest::Approx(0).scale(30).epsilon(1e-9));
  }
  REQUIRE(bool(march.outcome()));
  CHECK(std::get<0>(p.terms()).force() > 1);
  // The pattern is made anew where the stencil has changed, and only there.
  CHECK(changes == std::get<0>(p.terms()).changes);
  CHECK(changes == 4);
}

TEST_CASE("the derivative of a term of one's own is that of its forces") {
  const auto mesh = mesh::rectangle({.size = {2, 1}, .cells = {2, 2}});
  Bodies<Sprung> bodies(mesh, {}, elastic);
  typename System<Sprung>::Pairs pairs{};
  typename System<Sprung>::Inertia inertia{};
  std::tuple<MeanSpring> terms{MeanSpring(mesh.side("top").nodes, 300, 0.4)};
  System<Sprung> system(bodies, pairs, inertia, {{"bottom", 1, nullptr}}, {}, 1, &terms);
  Field u = Field::Zero(system.dofs().components());
  system.update(u, 0.5);
  for (Index i = 0; i < u.size(); ++i)
    u[i] += system.dofs().equation(i) == IndexMap::constrained ? 0 : 0.02 * std::sin(3.0 * i);
  const auto report = verify::system_tangent(system, u, 1, 1, 1e-6);
  CHECK(report.by_differences < 1e-8);
  CHECK(report.asymmetry > 1e-3);
}

TEST_CASE("an unknown that is no node's: the load that gives a prescribed mean motion") {
  const auto mesh = mesh::rectangle(block());
  Problem<Loaded> loaded{
      {.body = mesh, .material = {.young = 1000}, .terms = {LoadFactor(mesh.side("top").nodes, -0.3)}}};
  Problem<Plain> driven{{.body = mesh, .material = {.young = 1000}}};
  for (auto* side : {"left", "right"}) loaded.hold(side, 0), driven.hold(side, 0);
  loaded.hold("bottom", 1);
  driven.hold("bottom", 1).drive("top", 1, [](Real t) { return -0.3 * t; });
  REQUIRE(bool(loaded.march({.end = 1, .steps = 3, .tolerance = 1e-12}).finish()));
  REQUIRE(bool(driven.march({.end = 1, .steps = 3, .tolerance = 1e-12}).finish()));
  const Real factor = loaded.displacement()[std::get<0>(loaded.terms()).own()];
  CHECK(factor == doctest::Approx(loaded.reaction("bottom", 1)).epsilon(1e-9));
  // Loads alike on all nodes do not leave the top flat, but the mean is what it was to be.
  Real mean = 0;
  for (const Index n : mesh.side("top").nodes) mean += loaded.displacement(n)[1] / Real(mesh.side("top").nodes.size());
  CHECK(mean == doctest::Approx(-0.3).epsilon(1e-11));
  CHECK(factor == doctest::Approx(-driven.reaction("top", 1)).epsilon(0.05));
}

struct Elastic {
  using Element = FullyIntegrated<Quad4>;
  using Material = Hencky;
};
template <class Solver>
struct Pieces : Model<Solver, Frictionless, Hencky, PlaneStrain, FullyIntegrated<Quad4>, NoContact> {
  using Bodies = BodyTypes<Elastic>;
};

TEST_CASE_TEMPLATE("two meshes tied node by node are one, whatever the storage", Solver, EigenLu, EigenLdlt) {
  Problem<Pieces<Solver>> tied{
      {.bodies = {{.name = "low", .mesh = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}), .material = elastic},
                  {.name = "high",
                   .mesh = mesh::rectangle({.origin = {0, 1}, .size = {2, 1}, .cells = {4, 2}}),
                   .material = elastic}}}};
  const auto low = tied.bodies().side_nodes("low.top"), high = tied.bodies().side_nodes("high.bottom");
  for (const Index h : high)
    for (const Index l : low)
      if (tied.bodies().positions()[std::size_t(h)] == tied.bodies().positions()[std::size_t(l)])
        for (Index i = 0; i < 2; ++i) tied.constrain({.dependent = {h * 2 + i, {{l * 2 + i, 1}}}});
  tied.hold("low.bottom", 0).hold("low.bottom", 1).drive("high.top", 0, [](Real t) { return 0.3 * t; });
  Problem<Lone<Solver, Hencky, PlaneStrain, FullyIntegrated<Quad4>>> whole{
      {.body = mesh::rectangle({.size = {2, 2}, .cells = {4, 4}}), .material = elastic}};
  whole.hold("bottom", 0).hold("bottom", 1).drive("top", 0, [](Real t) { return 0.3 * t; });
  auto march = tied.march({.end = 1, .steps = 3, .tolerance = 1e-12});
  for (const StepReport& step : march) CHECK(step.iterations <= 5);
  REQUIRE(bool(march.outcome()));
  REQUIRE(bool(whole.march({.end = 1, .steps = 3, .tolerance = 1e-12}).finish()));
  CHECK(tied.unknowns() == whole.unknowns());
  CHECK(tied.reaction("high.top", 0) == doctest::Approx(whole.reaction("top", 0)).epsilon(1e-10));
  CHECK(tied.reaction("low.bottom", 1) == doctest::Approx(whole.reaction("bottom", 1)).epsilon(1e-9).scale(1));
}

TEST_CASE("a constraint with weights, an offset and driven masters is kept, and its forces do no work of their own") {
  Problem<Plain> p{{.body = mesh::rectangle(block()), .material = elastic}};
  const auto& top = p.body().mesh().side("top").nodes;
  p.hold("bottom", 1).drive("left", 0, [](Real t) { return 0.1 * t; });
  // The right end of the top follows the mean of two others, one of them driven, and an offset in time.
  const Index dependent = top.front() * 2, free = top[4] * 2, driven = top.back() * 2;  // from right to left
  p.constrain({.dependent = {dependent, {{free, 0.5}, {driven, 0.5}}}, .offset = [](Real t) { return 0.05 * t; }});
  REQUIRE(bool(p.march({.end = 1, .steps = 4, .tolerance = 1e-12}).finish()));
  const Field& u = p.displacement();
  CHECK(u[dependent] == doctest::Approx(0.5 * u[free] + 0.5 * u[driven] + 0.05).epsilon(1e-13));
  const Field& balance = p.system().forces().reaction;
  CHECK(balance[free] + 0.5 * balance[dependent] == doctest::Approx(0).scale(10).epsilon(1e-10));
  CHECK(std::abs(balance[dependent]) > 1e-2);
}

TEST_CASE("faults of linear constraints are named") {
  const auto make = [] {
    auto p = std::make_unique<Problem<Plain>>(
        Problem<Plain>::Parameters{.body = mesh::rectangle({.cells = {1, 1}}), .material = elastic});
    p->hold("bottom", 0).hold("bottom", 1);
    return p;
  };
  auto held = make();
  held->constrain({.dependent = {held->body().mesh().side("bottom").nodes[0] * 2, {{5, 1}}}});
  CHECK_THROWS_WITH_AS(held->march({.end = 1}), doctest::Contains("has a support as well"), std::invalid_argument);
  const Index a = held->body().mesh().side("top").nodes[0] * 2, b = held->body().mesh().side("top").nodes[1] * 2;
  auto twice = make();
  twice->constrain({.dependent = {a, {{b, 1}}}}).constrain({.dependent = {a, {{b + 1, 1}}}});
  CHECK_THROWS_WITH_AS(twice->march({.end = 1}), doctest::Contains("depends on others twice"), std::invalid_argument);
  auto chain = make();
  chain->constrain({.dependent = {a, {{b, 1}}}}).constrain({.dependent = {b, {{b + 1, 1}}}});
  CHECK_THROWS_WITH_AS(chain->march({.end = 1}), doctest::Contains("depends on others itself"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(chain->constrain({.dependent = {99, {{b, 1}}}}), "linear constraint: there is no component 99",
                       std::invalid_argument);
}

}  // namespace terms
