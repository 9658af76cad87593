// SPDX-License-Identifier: BSL-1.0
// Tools that move by many element lengths a step, through or past the body if nothing looked at the way.
#include "../physics/scene.hpp"
#include "suite.hpp"

#include <stickslip/linear_solver/eigen_ldlt.hpp>

namespace tunnelling {

using namespace scene;
using stability::Case;
using stability::HardCase;
using Smooth = Model<EigenLdlt, Frictionless>;

// A block of 4 x 2, its bottom held, and a tool above.
std::unique_ptr<Problem<Smooth>> block(const rigid::Profile& tool, rigid::Motion<2> motion, Real penalty = 1e5) {
  auto p = std::make_unique<Problem<Smooth>>(Problem<Smooth>::Parameters{
      .body = mesh::rectangle({.size = {4, 2}, .cells = {8, 4}}),
      .material = material<Hencky>(),
      .contacts = {
          {.side = "top", .tool = tool, .motion = motion, .enforcement = {.normal = penalty}, .name = "tool"}}});
  p->hold("bottom", 0).hold("bottom", 1);
  return p;
}

// The answer of many small steps against that of few large ones, or of large ones that start far away.
void same(Case& c, const rigid::Profile& tool, const rigid::Motion<2>& motion, Index few, Index many) {
  auto coarse = block(tool, motion), fine = block(tool, motion);
  auto quick = coarse->march({.end = 1, .steps = few, .tolerance = 1e-10});
  c.completes(quick);
  auto slow = fine->march({.end = 1, .steps = many, .tolerance = 1e-10});
  c.completes(slow);
  c.require(fine->contact_force("tool").norm() > 100, "the tool presses");
  c.small((coarse->contact_force("tool") - fine->contact_force("tool")).norm() / fine->contact_force("tool").norm(),
          1e-7, "force of small steps");
  c.small((coarse->displacement() - fine->displacement()).norm() / fine->displacement().norm(), 1e-7,
          "displacements of small steps");
}

const HardCase approach("tunnelling", "a disc from 100 element lengths away in one step", "Frictionless, EigenLdlt",
                        "force and field of 200 small steps", [](Case& c) {
                          same(
                              c, rigid::disc({2, 57}, 5), [](Real t) { return V(0, -50.2 * t); }, 1, 200);
                        });

// A plate as thick as an element: its other face is soon the nearer one.
rigid::Profile plate(Real thickness) {
  const Real half = 0.5 * thickness;
  return rigid::path({-6, -half}, {-1, 0}).right(half, pi).straight(12).right(half, pi).straight(12).close();
}
const HardCase plates("tunnelling", "a plate as thick as an element, from 120 element lengths away",
                      "Frictionless, EigenLdlt", "force and field of 250 small steps, for 1, 2, 3 and 7 steps",
                      [](Case& c) {
                        for (const Index few : {1, 2, 3, 7})
                          same(
                              c, plate(0.5), [](Real t) { return V(2, 62.25 - 60.6 * t); }, few, 250);
                      });
const HardCase paddle("tunnelling", "a paddle that turns by a quarter onto the body in one step",
                      "Frictionless, EigenLdlt", "force and field of 100 small steps", [](Case& c) {
                        same(
                            c, plate(0.5),
                            [](Real t) {
                              return rigid::turned(-0.5 * pi * (1 - t), {-10, 0}, {-4, 1.9});
                            },
                            1, 100);
                      });

const HardCase through("tunnelling", "a punch that would fly on 100 element lengths behind the body",
                       "Frictionless, EigenLdlt", "refused while it presses; its force is that of the supports",
                       [](Case& c) {
                         for (const Index steps : {1, 2, 5}) {
                           auto p = block(
                               rigid::disc({2, 27}, 5), [](Real t) { return V(0, -100 * t); }, 1e6);
                           auto march = p->march({.end = 1, .steps = steps, .tolerance = 1e-9});
                           c.refuses(march, {FailureCause::tunnelled, FailureCause::element_inverted,
                                             FailureCause::stalled, FailureCause::not_converged});
                           c.require(march.outcome().time == p->time() && march.outcome().attempts > 0,
                                     "it tells what was tried");
                           c.require(p->time() > 0.201 && p->time() < 0.23, "it ends while it presses");
                           c.require(p->contact_force("tool")[1] > 1e5, "it presses");
                           c.near(p->contact_force("tool")[1], p->reaction("bottom", 1), 1e-8, "force of the supports");
                         }
                       });
const HardCase sweep("tunnelling", "a roller that sweeps over the whole body within a step", "Frictionless, EigenLdlt",
                     "it is felt on the way; afterwards the body is at rest", [](Case& c) {
                       auto p = block(rigid::disc({0, 0}, 1), [](Real t) { return V(-48 + 100 * t, 2.8); });
                       auto march = p->march({.end = 1, .steps = 1});
                       Real largest = 0;
                       for ([[maybe_unused]] const auto& step : march)
                         largest = std::max(largest, p->contact_force("tool").norm());
                       c.completes(march);
                       c.require(largest > 1e3, "it is felt");
                       c.small(p->displacement().norm(), 1e-8, "at rest");
                     });

}  // namespace tunnelling
