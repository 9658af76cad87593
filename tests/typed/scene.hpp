// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "product.hpp"

namespace typed {

struct Answer {
  Outcome outcome;
  Field u;
  Vec<Real, 2> force;     // of the body on the tool
  Vec<Real, 2> reaction;  // of the supports on the body
  Index steps = 0, iterations = 0, rejected = 0, sliding = 0;
  Real plastic_strain = 0;
};

// What holds for every bundle, and for two bundles that differ in the solver alone. Not templates: they compile once.
void check(const Answer& answer, bool hoop, bool friction, bool plastic);
void check_equal(const Answer& a, const Answer& b);

template <class Material>
constexpr bool is_plastic = requires(Material m) {
  m.hardening;
};

template <class Material>
Material parameters() {
  if constexpr (!is_plastic<Material>)
    return {.young = 1000, .poisson = 0.3};
  else if constexpr (requires(Material m) { m.hardening.modulus; })
    return {.young = 1000, .poisson = 0.3, .hardening = {.yield = 5, .modulus = 20}};
  else
    return {.young = 1000, .poisson = 0.3, .hardening = {.strength = 12, .offset = 1e-2, .exponent = 0.2}};
}

/// Presses a flat tool on a block of 2 x 2 elements in one step and drags it along in two more; checks the
/// answer.
template <class Model>
Answer press_and_drag() {
  Contact<Model> contact{
      .side = "top",
      .tool = rigid::line({0, 1}, {-1, 0}),
      .motion = [](Real t) { return Vec<Real, 2>(0.02 * std::max(0.0, t - 1), -0.03 * std::min(t, 1.0)); },
      .enforcement = {.normal = 2e3, .tangential = 1e3, .per = PenaltyPer::area},
      .name = "tool"};
  if constexpr (has_friction<Model>) contact.friction = {.mu = 0.15};
  Problem<Model> problem{{.body = mesh::rectangle({.origin = {1, 0}, .cells = {2, 2}}),
                          .material = parameters<typename Model::Material>(),
                          .contacts = {contact}}};
  problem.hold("bottom", 0).hold("bottom", 1);
  auto march = problem.march({.end = 3, .steps = 3, .tolerance = 1e-11});
  Answer answer;
  for (const StepReport& step : march) answer.sliding += step.contact.sliding;
  answer.outcome = march.outcome();
  answer.steps = march.report().steps;
  answer.iterations = march.report().iterations;
  answer.rejected = march.report().rejected_steps;
  answer.u = problem.displacement();
  answer.force = problem.contact_force("tool");
  for (int i = 0; i < 2; ++i) answer.reaction[i] = problem.reaction("bottom", i);
  answer.plastic_strain = problem.max_plastic_strain();
  check(answer, Model::Kinematics::hoop, has_friction<Model>, is_plastic<typename Model::Material>);
  return answer;
}

/// Runs the bundles of one material. Of the solvers that a kinematics, element and friction admit, all would cost
/// minutes to compile; two of them run, in turns such that every solver meets every friction law that it can serve, and
/// a solver of each triangle meets one of full matrices. Returns the number of bundles that ran.
template <class Material>
int run_all() {
  using boost::mp11::mp_at_c;
  using boost::mp11::mp_for_each;
  using boost::mp11::mp_identity;
  using boost::mp11::mp_iota_c;
  using boost::mp11::mp_transform;
  using Sections = mp_product<mp_list, AllKinematics, Elements>;
  int count = 0;
  mp_for_each<mp_iota_c<mp_size<Sections>::value>>([&](auto section) {
    using Section = mp_at_c<Sections, section>;
    using Kinematics = mp_at_c<Section, 0>;
    using Element = mp_at_c<Section, 1>;
    mp_for_each<mp_transform<mp_identity, Frictions>>([&](auto friction) {
      using Friction = typename decltype(friction)::type;
      using Admitted = mp_copy_if<
          mp_product<Bundle, mp_list<Kinematics>, mp_list<Element>, mp_list<Material>, mp_list<Friction>, Solvers>,
          IsValid>;
      constexpr std::size_t n = mp_size<Admitted>::value;
      static_assert(n == 3 || n == 6);
      const Answer a = press_and_drag<mp_at_c<Admitted, section % n>>();
      const Answer b = press_and_drag<mp_at_c<Admitted, (section + n / 2) % n>>();
      check_equal(a, b);
      count += 2;
    });
  });
  return count;
}

}  // namespace typed
