// SPDX-License-Identifier: BSL-1.0
// Calls in an order that gives no result end the program, where assertions are on, with a sentence that names the call
// that is missing. Compiled with assertions, whatever the build.
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/solve/diagnosis.hpp>
#include <stickslip/time_integration/quasistatic.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <limits>
#include <string>

#ifdef NDEBUG
#error "assertions must be on"
#endif

namespace {

using namespace stickslip;

struct AnySolver {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::symmetric;
  static constexpr Symmetry storage = Symmetry::symmetric;
  void analyze(const SparseView&) {}
  Factorization factorize(const SparseView&) { return Factorization::failed; }
  bool solve(const Real*, Real*) { return false; }
};
struct Pressed {
  using Kinematics = PlaneStrain;
  using Element = MeanDilatation<Quad4>;
  using Material = Hencky;
  using Friction = Frictionless;
  using Enforcement = AugmentedLagrangian;
  using TimeIntegration = Quasistatic;
  using LinearSolver = AnySolver;
};

// A block whose upper side is up to 0.1 deep in a disc: three of its nodes, at 0.5, 1 and 1.5.
struct Scene {
  Bodies<Pressed> bodies{mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}), {}, {.young = 1000, .poisson = 0.3}};
  ContactPairs<Pressed> pairs;
  System<Pressed>::Inertia inertia{};
  System<Pressed> system;
  Field u;

  Scene() : system(bodies, with_contact(), inertia, {{"bottom", 0, nullptr}, {"bottom", 1, nullptr}}, {}) {
    u.setZero(system.dofs().components());
  }
  ContactPairs<Pressed>& with_contact() {
    const Contact<Pressed> contact{.side = "top", .tool = rigid::disc({1, 3.9}, 3)};
    pairs.emplace_back(contact, bodies);
    return pairs;
  }
  // An evaluation that fails: a node is nowhere.
  void lose() {
    Field lost = u;
    lost[lost.size() - 1] = std::numeric_limits<Real>::quiet_NaN();
    (void)system.evaluate(lost, 0, 0);
  }
};

// What a process says that does something, and how it ends: with SIGABRT, or not.
struct End {
  bool aborted = false;
  std::string said{};
};
template <class Do>
End end_of(Do&& something) {
  int pipes[2];
  REQUIRE(pipe(pipes) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);  // doctest's handler would tell of a test that failed
    dup2(pipes[1], STDERR_FILENO);
    close(pipes[0]);
    something();
    _exit(0);
  }
  close(pipes[1]);
  End end;
  char text[256];
  for (ssize_t count = 0; (count = read(pipes[0], text, sizeof(text))) > 0;)
    end.said.append(text, static_cast<std::size_t>(count));
  close(pipes[0]);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  end.aborted = WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT;
  return end;
}
template <class Do>
void refuses(const std::string& sentence, Do&& misuse) {
  const End end = end_of([&] {
    Scene scene;
    misuse(scene);
  });
  INFO(end.said);
  CHECK(end.aborted);
  CHECK(end.said.find(sentence) != std::string::npos);
}

TEST_CASE("the calls in their order go through") {
  const End end = end_of([] {
    Scene s;
    if (s.system.start(s.u, 0) || s.system.evaluate(s.u, 0, 0)) _exit(1);
    Diagnosis<Pressed> diagnosis(s.system);
    (void)diagnosis.free_part(s.u);
    s.system.commit();
    System<Pressed>::Iterate iterate(s.system);
    if (iterate.evaluate(s.u, 0, 0, Want::residual) || iterate.add_tangent(s.u, 0, 0)) _exit(1);
    (void)s.system.tangent().view();
    (void)contact_summary(s.pairs);
    s.system.commit();
  });
  INFO(end.said);
  CHECK(!end.aborted);
  CHECK(end.said.empty());
}

TEST_CASE("a commit needs an evaluation, and one that did not fail") {
  const std::string sentence = "System::commit needs a System::evaluate without failure since the last commit";
  refuses(sentence, [](Scene& s) { s.system.commit(); });
  refuses(sentence, [](Scene& s) {
    (void)s.system.evaluate(s.u, 0, 0);
    s.system.commit();
    s.system.commit();
  });
  refuses(sentence, [](Scene& s) {
    (void)s.system.evaluate(s.u, 0, 0);
    s.lose();
    s.system.commit();
  });
  refuses("a contact needs a System::evaluate", [](Scene& s) { s.pairs.front().commit(); });
  refuses("History::commit needs History::set_trial since the last commit", [](Scene&) {
    History<Real> history(2);
    history.set_trial(0, 1);
    history.commit();
    history.commit();
  });
}

TEST_CASE("what contacts did is read after an evaluation that did not fail") {
  const std::string summary = "trial_summary needs a System::evaluate without failure since the last commit";
  refuses(summary, [](Scene& s) { (void)contact_summary(s.pairs); });
  refuses(summary, [](Scene& s) {
    (void)s.system.evaluate(s.u, 0, 0);
    s.lose();
    (void)contact_summary(s.pairs);
  });
  refuses("touches needs a System::evaluate without failure since the last commit", [](Scene& s) {
    (void)s.system.evaluate(s.u, 0, 0);
    s.system.commit();
    (void)s.pairs.front().touches(0);
  });
  refuses("touches needs a System::evaluate", [](Scene& s) {
    Diagnosis<Pressed> diagnosis(s.system);
    s.lose();
    (void)diagnosis.gap_roundoff();
  });
}

TEST_CASE("a tangent is that of the last evaluation, or there is none") {
  const std::string sentence =
      "System::tangent needs an evaluation with Want::tangent, or Iterate::add_tangent, as the last one";
  refuses(sentence, [](Scene& s) { (void)s.system.tangent().view(); });
  refuses(sentence, [](Scene& s) {
    (void)s.system.evaluate(s.u, 0, 0);
    (void)s.system.evaluate(s.u, 0, 0, Want::residual);
    (void)s.system.tangent().view();
  });
  refuses(sentence, [](Scene& s) {
    Diagnosis<Pressed> diagnosis(s.system);
    (void)s.system.evaluate(s.u, 0, 0, Want::residual);
    (void)diagnosis.free_part(s.u);
  });
  refuses(sentence, [](Scene& s) {
    (void)s.system.evaluate(s.u, 0, 0);
    (void)s.system.body_stiffness(s.u);
    (void)s.system.tangent().view();
  });
}

TEST_CASE("an iterate goes on from its own evaluations") {
  refuses("Iterate::evaluate needs Iterate::restart after a System::evaluate within the iteration", [](Scene& s) {
    System<Pressed>::Iterate iterate(s.system);
    (void)iterate.evaluate(s.u, 0, 0);
    (void)s.system.evaluate(s.u, 0, 0);
    (void)iterate.evaluate(s.u, 0, 0);
  });
}

// Its penalties are in parts of the body's stiffness, which the first evaluation takes where no start has.
TEST_CASE("multipliers with default penalties press at the first evaluation, without a start") {
  Scene by_hand, started;
  REQUIRE(by_hand.pairs.front().needs_stiffness());
  CHECK(!by_hand.system.evaluate(by_hand.u, 0, 0));
  REQUIRE(!started.system.start(started.u, 0));
  CHECK(!started.pairs.front().needs_stiffness());
  CHECK(!started.system.evaluate(started.u, 0, 0));
  CHECK(contact_summary(by_hand.pairs).touching == 3);
  CHECK(contact_summary(by_hand.pairs).max_penetration == doctest::Approx(0.1));
  by_hand.system.commit();
  started.system.commit();
  const Vec<Real, 2> force = by_hand.pairs.front().force();
  CHECK(force[1] > 0);
  CHECK(std::abs(force[0]) < 1e-10 * force[1]);
  CHECK(force == started.pairs.front().force());
  CHECK((by_hand.system.forces().contact.array() == started.system.forces().contact.array()).all());
  // A node's penalty is ten times the mean of the body's stiffness at its components, here from the body alone.
  Scene alone;
  CHECK(alone.system.body_stiffness(alone.u) > 0);
  const Eigen::MatrixXd stiffness = verify::dense(alone.system.tangent().stored);
  Real expected = 0;
  for (const Index n : alone.pairs.front().nodes()) {
    const Vec<Real, 2> from = alone.bodies.positions()[static_cast<std::size_t>(n)] - Vec<Real, 2>(1, 3.9);
    const Index x = alone.system.dofs().equation(2 * n), y = alone.system.dofs().equation(2 * n + 1);
    const Real depth = 3 - from.norm();
    if (depth > 0) expected += 10 * (stiffness(x, x) + stiffness(y, y)) / 2 * depth * -from[1] / from.norm();
  }
  CHECK(force[1] == doctest::Approx(expected).epsilon(1e-12));
  MESSAGE("force on the tool: ", force[1]);
}

}  // namespace
