// SPDX-License-Identifier: BSL-1.0
// Laws and solvers by name.
#include <stickslip/linear_solver/eigen_iterative.hpp>
#include <stickslip/run_time.hpp>
#include <stickslip/stickslip.hpp>

#include <doctest/doctest.h>

#include <string>

namespace {

using namespace stickslip;
using run_time::Named, run_time::NotOffered, run_time::SolverByName, run_time::Takes;
using Names = std::vector<std::string>;

struct Block : QuasistaticDefaults {};
struct Sheet : Block {
  using Material = HypoelasticJ2<LinearHardening>;
};
constexpr run_time::Choices laws{Named<Frictionless>{"frictionless"}, Named<Coulomb>{"coulomb"},
                                 Named<QuasiCoulomb>{"quasi-coulomb"}};

struct Offered {
  static const run_time::SolverList& solvers() {
    static const run_time::SolverList all = run_time::SolverList()
                                                .add<EigenDirect>("eigen")
                                                .add<EigenLdlt>("ldlt")
                                                .add<EigenLu>("lu")
                                                .add<Corrected<EigenLdlt>>("corrected")
                                                .add<ConjugateGradients>("hasty", {.iterations = 1})
                                                .add<ConjugateGradients>("iterative");
    return all;
  }
};

static_assert(run_time::takes_of<EigenLdlt> == Takes::triangle && run_time::takes_of<EigenLu> == Takes::full &&
              run_time::takes_of<Corrected<EigenLdlt>> == Takes::corrections);
static_assert(LinearSolverPolicy<SolverByName<Offered, Takes::triangle>>);

template <class Model>
Problem<Model> block() {
  Contact<Model> contact{.side = "top",
                         .tool = rigid::disc({0, 4}, 4),
                         .motion = [](Real t) { return Vec<Real, 2>(0.1 * t, -0.3 * t); },
                         .enforcement = {.normal = 1e4, .tangential = 1e3}};
  if constexpr (has_friction<Model>) contact.friction = {.mu = 0.2};
  return Problem<Model>{{.body = mesh::rectangle({.origin = {-3, -3}, .size = {6, 3}, .cells = {8, 4}}),
                         .material = {.young = 1000, .poisson = 0.3},
                         .contacts = {contact}}};
}
template <class Model>
Field pressed(const SolverParametersOf<Model>& solver) {
  Problem<Model> problem = block<Model>();
  problem.hold("bottom", 0).hold("bottom", 1);
  CHECK(problem.march({.end = 1, .steps = 4, .tolerance = 1e-10}, solver).finish());
  return problem.displacement();
}

// Whether it throws NotOffered with all of these words.
template <class Function>
void refuses(Function&& function, const Names& words) {
  std::string said;
  try {
    function();
  } catch (const NotOffered& e) {
    said = e.what();
  }
  for (const std::string& word : words) CHECK_MESSAGE(said.find(word) != std::string::npos, said, " lacks ", word);
}
constexpr auto nothing = []<class Model>() {};

TEST_CASE("names give the models that they stand for") {
  const auto press = [&](const char* law, const std::string& solver) {
    return run_time::dispatch<Block, Offered>(laws, law, solver,
                                              [&]<class Model>() { return pressed<Model>({.name = solver}); });
  };
  struct Exact : Block {
    using Friction = Coulomb;
    using LinearSolver = EigenLu;
  };
  struct Lagging : Block {
    using Friction = QuasiCoulomb;
    using LinearSolver = EigenLdlt;
  };
  const Field exact = pressed<Exact>({}), lagging = pressed<Lagging>({});
  CHECK(press("coulomb", "lu") == exact);  // bit for bit
  CHECK(press("coulomb", "eigen") == exact);
  CHECK((press("coulomb", "corrected") - exact).norm() < 1e-8 * exact.norm());
  CHECK(press("quasi-coulomb", "ldlt") == lagging);
  CHECK(press("quasi-coulomb", "eigen") == lagging);
  CHECK((press("quasi-coulomb", "iterative") - lagging).norm() < 1e-8 * lagging.norm());
  CHECK((press("frictionless", "eigen") - lagging).norm() > 1e-3 * lagging.norm());
}

TEST_CASE("two marches of one problem may have two solvers") {
  struct Model : Block {
    using LinearSolver = SolverByName<Offered, Takes::triangle>;
  };
  Problem<Model> problem = block<Model>();
  problem.hold("bottom", 0).hold("bottom", 1);
  auto hasty = problem.march({.end = 0.5, .steps = 1, .smallest = 0.2}, {.name = "hasty"});
  CHECK_FALSE(hasty.finish());
  CHECK(hasty.outcome().failure.cause == FailureCause::singular_matrix);
  CHECK(problem.march({.end = 0.5, .steps = 1}, {.name = "ldlt"}).finish());
  CHECK(problem.march({.end = 1, .steps = 1}, {.name = "iterative"}).finish());
  refuses([&] { problem.march({.end = 2}, {.name = "lu"}); }, {"\"lu\"", "eigen, ldlt, hasty, iterative"});
  refuses([&] { problem.march({.end = 2}); }, {"\"\"", "eigen, ldlt, lu, corrected, hasty, iterative"});
}

TEST_CASE("a run goes on with the solver of its name alone") {
  struct Model : Block {
    using LinearSolver = SolverByName<Offered, Takes::triangle>;
  };
  Problem<Model> problem = block<Model>(), other = block<Model>();
  for (auto* p : {&problem, &other}) p->hold("bottom", 0).hold("bottom", 1);
  auto march = problem.march({.end = 1, .steps = 4}, {.name = "ldlt"});
  march.begin();
  Archive state = Archive::of(march);
  auto wrong = other.march({.end = 1, .steps = 4}, {.name = "eigen"});
  CHECK_THROWS_WITH_AS(state.restore(wrong), doctest::Contains("\"ldlt\""), std::runtime_error);
  auto right = other.march({.end = 1, .steps = 4}, {.name = "ldlt"});
  state.restore(right);
  CHECK(right.finish());
  CHECK(march.finish());
  CHECK(other.displacement() == problem.displacement());
}

TEST_CASE("names that are not there, or do not go together, are refused with those that do") {
  const auto go = [](const char* law, const char* solver) {
    return [=] { run_time::dispatch<Block, Offered>(laws, law, solver, nothing); };
  };
  refuses(go("coulob", "lu"), {"friction", "\"coulob\"", "frictionless, coulomb, quasi-coulomb"});
  refuses(go("coulomb", "magic"), {"linear solver", "\"magic\"", "eigen, ldlt, lu, corrected, hasty, iterative"});
  refuses(go("coulomb", "ldlt"), {"\"ldlt\" takes symmetric systems only", "\"coulomb\"", "eigen, lu, corrected"});
  refuses(go("quasi-coulomb", "lu"),
          {"\"lu\" takes non-symmetric", "a symmetric one", "eigen, ldlt, hasty, iterative"});
  refuses(go("quasi-coulomb", "corrected"), {"\"corrected\" takes non-symmetric"});
  refuses([] { (void)Offered::solvers().only({"lu", "magic"}); }, {"\"magic\""});
  CHECK_THROWS_AS(run_time::SolverList().add<EigenLu>("a").add<EigenLdlt>("a"), std::invalid_argument);
  CHECK_THROWS_WITH_AS(run_time::SolverList().add<ConjugateGradients>("a", {.tolerance = 0}).make("a", Takes::triangle),
                       "ConjugateGradients: the tolerance must lie between 0 and 1", std::invalid_argument);
}

TEST_CASE("lists tell their names, and what goes together") {
  CHECK(laws.list() == Names{"frictionless", "coulomb", "quasi-coulomb"});
  CHECK(Offered::solvers().only({"lu", "eigen"}).names() == Names{"lu", "eigen"});
  CHECK(Offered::solvers().names(Takes::full) == Names{"eigen", "lu"});
  CHECK(run_time::solvers_for<Block, Offered, Coulomb>() == Names{"eigen", "lu", "corrected"});
  CHECK(run_time::solvers_for<Block, Offered, QuasiCoulomb>() == Names{"eigen", "ldlt", "hasty", "iterative"});
  CHECK(run_time::solvers_for<Sheet, Offered, Frictionless>() == Names{"eigen", "lu"});  // nothing corrects a material
  std::string visited;
  laws.for_each([&]<class Law>(Named<Law> law) { visited += std::string(law.name) + (Law::active ? "+" : "-"); });
  CHECK(visited == "frictionless-coulomb+quasi-coulomb+");
}

}  // namespace
