// SPDX-License-Identifier: BSL-1.0
// What cannot be solved says so: where, when and why, at once, and leaves everything as it was.
#include "../physics/scene.hpp"
#include "run_case.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>

namespace failures {

using namespace stability;

constexpr Real nan = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();

// What the policies below get wrong, and how often they have been asked since.
struct Faults {
  bool stress = false, tangent = false, bound = false, solution = false, motion = false, drive = false, load = false;
  Real value = nan;
  Index evaluations = 0, solutions = 0;
};
Faults faults;

struct FaultyHencky : Hencky {
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>& F,
                                                                      const State<S, TensorPattern>& old,
                                                                      Real dt) const {
    auto out = Hencky::respond(F, old, dt);
    if (faults.stress) out.P(0, 0) = S(faults.value);
    if (faults.tangent) out.dP_dF(1, 1) = S(faults.value);
    return out;
  }
};
struct FaultyCoulomb : Coulomb {
  using Law = FaultyCoulomb;
  using Pressure = LastConverged;
  template <class S>
  FrictionBound<S> bound(const InterfaceState<S>& at) const {
    return faults.bound ? FrictionBound<S>{S(faults.value), S(0), S(0)} : Coulomb::bound(at);
  }
};
class FaultySolver : public EigenLdlt {
 public:
  bool solve(const Real* b, Real* x) {
    ++faults.solutions;
    const bool good = EigenLdlt::solve(b, x);
    if (faults.solution) x[0] = faults.value;
    return good;
  }
};
using Faulty = scene::Model<FaultySolver, FaultyCoulomb, FaultyHencky>;

std::unique_ptr<Problem<Faulty>> pressed() {
  faults = {};
  auto p = std::make_unique<Problem<Faulty>>(Problem<Faulty>::Parameters{
      .body = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}),
      .material = {{.young = 1000, .poisson = 0.3}},
      .contacts = {{.side = "bottom",
                    .tool = rigid::line({0, 0}, {1, 0}),
                    .motion = [](Real t) { return V(faults.motion && t > 0.5 ? faults.value : 0.1 * t, 0); },
                    .friction = {{.mu = 0.2}},
                    .enforcement = {.normal = 1e4, .tangential = 1e3},
                    .name = "tool"}}});
  p->drive("top", 1, [](Real t) { return faults.drive && t > 0.5 ? faults.value : -0.1 * t; }).hold("top", 0);
  p->load("left", 0, [](Real t) { return faults.load && t > 0.5 ? faults.value : t; });
  return p;
}

const HardCase poisoned(
    "failures", "NaN and infinity out of every policy and function of time", "user's policies, EigenLdlt",
    "named at its source without another solution; state intact; goes on once it is mended", [](Case& c) {
      struct Source {
        const char* name;
        bool Faults::*fault;
        FailureCause cause;
        Location::Kind place;
      };
      const Source sources[] = {
          {"stress", &Faults::stress, FailureCause::not_finite, Location::Kind::element},
          {"tangent", &Faults::tangent, FailureCause::not_finite, Location::Kind::element},
          {"bound", &Faults::bound, FailureCause::not_finite, Location::Kind::contact_node},
          {"motion", &Faults::motion, FailureCause::not_finite, Location::Kind::contact_node},
          {"drive", &Faults::drive, FailureCause::not_finite, Location::Kind::node},
          {"load", &Faults::load, FailureCause::not_finite, Location::Kind::node},
          {"solution", &Faults::solution, FailureCause::singular_matrix, Location::Kind::nowhere},
      };
      auto whole = pressed();
      c.completes(whole->march({.end = 0.5, .steps = 5, .tolerance = 1e-10}));
      c.completes(whole->march({.end = 1, .steps = 5, .tolerance = 1e-10}));
      for (const Source& source : sources)
        for (const Real value : {nan, -infinity}) {  // a bound of plus infinity is one: it sticks
          const std::string name = source.name + std::string(std::isnan(value) ? ", NaN" : ", infinity");
          auto p = pressed();
          c.completes(p->march({.end = 0.5, .steps = 5, .tolerance = 1e-10}));
          const Field before = p->displacement();
          const V force = p->contact_force("tool");
          const Real support = p->reaction("top", 1);
          faults.value = value;
          faults.*source.fault = true;
          faults.solutions = 0;
          auto march = p->march({.end = 1, .steps = 5, .smallest = 0.03});
          c.refuses(march, {source.cause});
          const Outcome& outcome = march.outcome();
          c.require(outcome.failure.location.kind == source.place, name + ": the place, " + outcome.message());
          // No solution goes by before it is noticed; a faulty solver is asked twice an attempt, which is tried again
          // once.
          c.require(faults.solutions <= (source.fault == &Faults::solution ? 2 * outcome.attempts : 0),
                    name + ": at once");
          c.require(outcome.attempts > 0 && outcome.tried_step > 0 && outcome.step == 1 && outcome.time == 0.5,
                    name + ": what was tried");
          c.require(p->displacement() == before && p->time() == 0.5 && p->contact_force("tool") == force &&
                        p->reaction("top", 1) == support,
                    name + ": the last state");
          faults = {};
          c.completes(p->march({.end = 1, .steps = 5, .tolerance = 1e-10}));
          c.small((p->displacement() - whole->displacement()).norm() / whole->displacement().norm(), 1e-9,
                  name + ": goes on");
        }
    });

const HardCase limits("failures", "a limit of iterations that is too low, then raised", "user's policies, EigenLdlt",
                      "refused as such; then the field of a run that had it from the start", [](Case& c) {
                        auto p = pressed(), whole = pressed();
                        c.refuses(
                            p->march({.end = 1, .steps = 2, .smallest = 0.2, .tolerance = 1e-10, .max_iterations = 1}),
                            {FailureCause::not_converged});
                        c.require(p->time() == 0 && p->displacement().isZero(0), "nothing has happened");
                        c.completes(p->march({.end = 1, .steps = 2, .tolerance = 1e-10}));
                        c.completes(whole->march({.end = 1, .steps = 2, .tolerance = 1e-10}));
                        c.small((p->displacement() - whole->displacement()).norm(), 0, "to the bit");
                      });

// --- supports

using Alone = scene::Lone<EigenLdlt>;
using Touching = scene::Model<EigenLdlt, Frictionless>;
const HardCase unsupported("failures", "rigid-body motions that nothing resists", "no contact; Frictionless",
                           "named as such", [](Case& c) {
                             const auto lone = [&](auto prepare) {
                               Problem<Alone> p({.body = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}),
                                                 .material = {.young = 1000, .poisson = 0.3}});
                               prepare(p);
                               c.refuses(p.march({.end = 1, .steps = 2, .smallest = 0.1}), {FailureCause::unsupported});
                               c.require(p.displacement().isZero(0), "nothing has happened");
                             };
                             const auto pull = [](Real t) { return 10 * t; };
                             lone([&](auto& p) { p.load("right", 0, pull); });
                             lone([&](auto& p) { p.hold("left", 1).load("right", 0, pull); });
                             // Loads in balance with each other, along the free motion or not, do not hold it either.
                             const auto back = [pull](Real t) { return -pull(t); };
                             lone([&](auto& p) { p.load("right", 0, pull).load("left", 0, back); });
                             lone([&](auto& p) { p.hold("left", 1).load("right", 0, pull).load("left", 0, back); });
                             auto pinned = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}});
                             pinned.sides["pin"].nodes = {pinned.side("left").nodes[1]};
                             {
                               Problem<Alone> p({.body = pinned, .material = {.young = 1000, .poisson = 0.3}});
                               p.hold("pin", 0).hold("pin", 1).load("top", 1, pull);
                               c.refuses(p.march({.end = 1, .steps = 2, .smallest = 0.1}), {FailureCause::unsupported});
                             }
                             // On a smooth floor, pushed sideways.
                             Problem<Touching> p({.body = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}}),
                                                  .material = {.young = 1000, .poisson = 0.3},
                                                  .contacts = {{.side = "bottom",
                                                                .tool = rigid::line({0, 0}, {1, 0}),
                                                                .enforcement = {.normal = 1e4},
                                                                .name = "floor"}}});
                             p.drive("top", 1, [](Real t) { return -0.1 * t; }).load("left", 0, pull);
                             c.refuses(p.march({.end = 1, .steps = 2, .smallest = 0.1}), {FailureCause::unsupported});
                           });
const HardCase supported("failures", "the same with one support more", "no contact", "converges", [](Case& c) {
  auto mesh = mesh::rectangle({.size = {2, 1}, .cells = {4, 2}});
  mesh.sides["pin"].nodes = {mesh.side("bottom").nodes[0]};
  mesh.sides["roller"].nodes = {mesh.side("bottom").nodes[4]};
  Problem<Alone> p({.body = mesh, .material = {.young = 1000, .poisson = 0.3}});
  p.hold("pin", 0).hold("pin", 1).hold("roller", 1).load("top", 1, [](Real t) { return 10 * t; });
  c.completes(p.march({.end = 1, .steps = 2, .tolerance = 1e-10}));
  c.near(p.reaction("pin", 1) + p.reaction("roller", 1), -10, 1e-9, "reactions");
});

const HardCase input(
    "failures", "empty sides, nodes that do not exist, segments of no length, velocities that are no numbers",
    "Frictionless; dynamics", "input errors that name them", [](Case& c) {
      const auto with = [](auto change) {
        Problem<Touching>::Parameters parameters{
            .body = mesh::rectangle({.cells = {2, 2}}),
            .material = {.young = 1000, .poisson = 0.3},
            .contacts = {{.side = "spot", .tool = rigid::line({0, 0}, {1, 0}), .enforcement = {.normal = 1e4}}}};
        change(parameters);
        Problem<Touching> p(std::move(parameters));
        p.hold("held", 0);
      };
      c.complains([&] { with([](auto& p) { p.body.sides["spot"] = {}; }); }, "contact \"spot\": the side has no nodes");
      c.complains([&] { with([](auto& p) { p.body.sides["spot"].nodes = {99}; }); }, "side \"spot\" names a node");
      c.complains([&] { with([](auto& p) { p.body.sides["spot"].nodes = {-1}; }); }, "side \"spot\" names a node");
      c.complains([&] { with([](auto& p) { p.body.sides["spot"].nodes = {0}, p.body.sides["held"] = {}; }); },
                  "\"held\" has no nodes");
      c.complains([&] { with([](auto& p) { p.body.sides["spot"].nodes = {0}, p.body.sides["held"].nodes = {12}; }); },
                  "\"held\" names a node");
      c.complains([] { (void)rigid::path({0, 0}, {1, 0}).straight(0); }, "length");
      c.complains([] { (void)rigid::rounded({{0, 0}, {1, 0}, {1, 0}, {2, 0}}, 0); }, "point 2");
      c.complains([] { (void)rigid::line({0, 0}, {0, 0}); }, "heading");
      CaseSetup s{.body = mesh::rectangle({})};
      s.velocity = [](const V& X) { return V(X[0] > 0.5 ? nan : 0, 0); };
      s.marches = {{.end = 1, .steps = 1}};
      c.complains([&] { (void)moving()[0].run_case(s, {}); }, "start velocity");
    });

}  // namespace failures
