// SPDX-License-Identifier: BSL-1.0
// A scene of the plane or of space in run-time terms, result by models that were compiled once: cases instantiate
// nothing.
#pragma once

#include "suite.hpp"

#include <stickslip/geometry/tool.hpp>
#include <stickslip/problem.hpp>
#include <stickslip/run_time.hpp>
#include <stickslip/time_integration/generalized_alpha.hpp>
#include <stickslip/verify/energy.hpp>

#include <optional>

namespace stability {

template <int dim>
struct TouchOf {
  std::string side;
  rigid::Tool<dim> tool;
  rigid::Motion<dim> motion{};
  Real mu = 0;
  Real normal = 1e5, tangential = 1e4;
  PenaltyPer per = PenaltyPer::unit_depth;
  std::string name = "tool";
  Real across = 0;  ///< coefficient across the first axis, where the law has one
};

template <int dim>
struct CaseSetupOf {
  Mesh<dim, (1 << dim)> body;
  Real young = 1000, poisson = 0.3;
  Real yield = 0, hardening = 0, exponent = 1;  ///< strength and exponent of the power law, where that is the material
  std::vector<TouchOf<dim>> contacts{};
  std::vector<SideValue> driven{}, loads{};
  std::vector<MarchOptions> marches{};  ///< one after the other, whatever becomes of them
  Real density = 1, radius = 0.5;       ///< spectral radius of the time scheme
  std::optional<TimeScheme> scheme{};   ///< instead
  std::function<Vec<Real, dim>(const Vec<Real, dim>&)> velocity{};
};

/// What can be seen after a converged step.
template <int dim>
struct ConvergedStateOf {
  const StepReport& step;
  const Field& u;
  const std::vector<const ContactRecord<dim>*>& contacts;
  const std::function<Real(const std::string&, Index)>& reaction;
  const verify::Energies& energies;

  Vec<Real, dim> force(std::size_t contact = 0) const { return contacts[contact]->force(); }
};
template <int dim>
using LookOf = std::function<void(const ConvergedStateOf<dim>&)>;

/// The end of a run.
template <int dim>
struct CaseResultOf {
  std::vector<Outcome> outcomes;
  RunReport report;  ///< sums of all marches
  Field u;
  std::vector<Vec<Real, dim>> forces;
  std::vector<ContactNodeState<dim>> nodes;  ///< of the first contact
  verify::Energies energies;
  Real time = 0, plastic = 0;
  std::vector<Warning> warnings{};  ///< of all marches
  Real unbalanced = 0;              ///< largest error of the energy balance over its largest term

  const Outcome& outcome() const { return outcomes.back(); }
};

template <int dim>
struct TestedModelOf {
  std::string name;
  CaseResultOf<dim> (*run_case)(const CaseSetupOf<dim>&, const LookOf<dim>&);
  bool lags = false;       ///< the bound is that of the last converged pressure
  bool augmented = false;  ///< no penetration is left
};

using Touch = TouchOf<2>;
using CaseSetup = CaseSetupOf<2>;
using ConvergedState = ConvergedStateOf<2>;
using Look = LookOf<2>;
using CaseResult = CaseResultOf<2>;
using TestedModel = TestedModelOf<2>;
/// Coulomb's friction on an elastic body, quasi-static: laws x solvers.
const std::vector<TestedModel>& elastic();
/// The same, one of each law.
const TestedModel &coulomb(), &quasi(), &augmented();
const TestedModel& smooth();               ///< frictionless, elastic
const TestedModel& metal();                ///< J2, linear hardening, Quasi-Coulomb, plane strain
const std::vector<TestedModel>& sheets();  ///< J2, power hardening, axisymmetric: laws
const std::vector<TestedModel>& moving();  ///< elastic with inertia: laws
/// AssumedStrain, Quasi-Coulomb, plane strain: elastic, and J2 with linear hardening.
const TestedModel &bends(), &bending_metal();
const TestedModel& ringing();  ///< frictionless, elastic with inertia, multipliers
const TestedModel& tube();     ///< J2, axisymmetric with inertia

namespace space {
using V = Vec<Real, 3>;
using M3 = Mat<Real, 3>;
using Touch = TouchOf<3>;
using CaseSetup = CaseSetupOf<3>;
using ConvergedState = ConvergedStateOf<3>;
using Look = LookOf<3>;
using CaseResult = CaseResultOf<3>;
using TestedModel = TestedModelOf<3>;
/// Coulomb's friction on an elastic body of hexahedra, quasi-static: laws x solvers.
const std::vector<TestedModel>& elastic();
/// The same, one of each law.
const TestedModel &coulomb(), &quasi(), &augmented();
const TestedModel& smooth();               ///< frictionless, elastic
const TestedModel& anisotropic();          ///< Coulomb's friction with an elliptic bound
const std::vector<TestedModel>& moving();  ///< elastic with inertia: laws
}  // namespace space

/// Counts a run in a case and checks its energy balance against a limit.
template <int dim>
void take(Case& c, const CaseResultOf<dim>& result, Real limit = 1e-6) {
  c.counts(result.report.steps, result.report.iterations, result.report.rejected_steps);
  c.energy_balance(result.unbalanced, limit);
}
/// Plays a scene that must run to its end.
template <int dim>
CaseResultOf<dim> completes(Case& c, const TestedModelOf<dim>& model, const CaseSetupOf<dim>& setup,
                            const std::type_identity_t<LookOf<dim>>& look = {}, Real limit = 1e-6) {
  CaseResultOf<dim> result = model.run_case(setup, look);
  take(c, result, limit);
  for (const Outcome& outcome : result.outcomes) c.require(bool(outcome), model.name + ": " + outcome.message());
  return result;
}

/// A body of height 2 whose last drive presses its top is pressed through itself: refused at an element, as far as it
/// goes.
template <int dim>
void refused_when_inverted(Case& c, const TestedModelOf<dim>& model, CaseSetupOf<dim> setup) {
  setup.driven.back().value = [](Real t) { return -2.2 * t; };
  setup.marches = {{.end = 1, .steps = 20, .smallest = 1e-4}};
  const CaseResultOf<dim> p = model.run_case(setup, {});
  take(c, p, 1e-2);
  c.refused_for(p.outcome().failure.cause,
                {FailureCause::element_inverted, FailureCause::not_converged, FailureCause::stalled},
                p.outcome().message());
  c.require(p.time > 0.8 && p.time < 2 / 2.2, "as far as it goes");
}

inline SideValue held(const char* side, Index component) {
  return {side, component, nullptr};
}

/// One function for all models.
template <class M, int dim = M::Kinematics::dim>
CaseResultOf<dim> run_case(const CaseSetupOf<dim>& setup, const LookOf<dim>& look) {
  typename Problem<M>::Parameters parameters{.body = setup.body};
  auto& material = parameters.material;
  material.young = setup.young;
  material.poisson = setup.poisson;
  if constexpr (requires { material.hardening.modulus; }) {
    material.hardening.yield = setup.yield;
    material.hardening.modulus = setup.hardening;
  } else if constexpr (requires { material.hardening.exponent; }) {
    material.hardening.strength = setup.yield;
    material.hardening.offset = 1e-4;
    material.hardening.exponent = setup.exponent;
  }
  if constexpr (has_inertia<M>) {
    parameters.density = setup.density;
    parameters.time_integration.scheme = setup.scheme.value_or(chung_hulbert(setup.radius));
  }
  if constexpr (has_contact<M>)
    for (const TouchOf<dim>& t : setup.contacts) {
      Contact<M> contact{.side = t.side, .tool = t.tool, .motion = t.motion, .name = t.name};
      contact.enforcement.normal = t.normal;
      contact.enforcement.tangential = t.tangential;
      contact.enforcement.per = t.per;
      if constexpr (requires { contact.friction.mu_across; }) {
        contact.friction.mu_along = t.mu;
        contact.friction.mu_across = t.across;
      } else if constexpr (has_friction<M>) {
        contact.friction.mu = t.mu;
      }
      parameters.contacts.push_back(contact);
    }
  Problem<M> problem(std::move(parameters));
  for (const SideValue& d : setup.driven) problem.drive(d.side, d.component, d.value);
  for (const SideValue& l : setup.loads) problem.load(l.side, l.component, l.value);
  if constexpr (has_inertia<M>)
    if (setup.velocity) problem.start_velocity(setup.velocity);

  CaseResultOf<dim> out;
  std::vector<const ContactRecord<dim>*> records;
  if constexpr (has_contact<M>) problem.visit_contacts([&](const auto& pair) { records.push_back(&pair); });
  const std::function<Real(const std::string&, Index)> reaction = [&](const std::string& side, Index component) {
    return problem.reaction(side, component);
  };
  std::optional<verify::EnergyBalance<M>> balance;
  Real amount = 0, error = 0;
  for (const MarchOptions& options : setup.marches) {
    auto march = problem.march(options);
    if (!balance) balance.emplace(problem);
    for (const StepReport& step : march) {
      balance->update(step);
      const verify::Energies& e = balance->energies();
      amount = std::max({amount, std::abs(e.external), e.kinetic, e.elastic + e.penalty, e.plastic, e.friction});
      error = std::max(error, std::abs(e.unbalanced()));
      if (look) look({step, problem.displacement(), records, reaction, e});
    }
    out.outcomes.push_back(march.outcome());
    out.warnings.insert(out.warnings.end(), march.warnings().begin(), march.warnings().end());
    out.report.steps += march.report().steps;
    out.report.iterations += march.report().iterations;
    out.report.rejected_steps += march.report().rejected_steps;
    out.report.outer_iterations += march.report().outer_iterations;
    out.report.work.indefinite_factorizations += march.report().work.indefinite_factorizations;
    out.report.max_penetration = std::max(out.report.max_penetration, march.report().max_penetration);
    out.report.max_slip = std::max(out.report.max_slip, march.report().max_slip);
  }
  out.u = problem.displacement();
  for (const auto* record : records) out.forces.push_back(record->force());
  if (!records.empty()) out.nodes = records[0]->states();
  out.energies = balance->energies();
  out.time = problem.time();
  out.plastic = problem.max_plastic_strain();
  out.unbalanced = amount > 0 ? error / amount : 0;
  return out;
}

/// The models of a list, compiled here.
template <class... Models>
auto tested(const run_time::Choices<Models...>& models) {
  constexpr int dim = std::tuple_element_t<0, std::tuple<Models...>>::Kinematics::dim;
  std::vector<TestedModelOf<dim>> all;
  models.for_each([&]<class M>(run_time::Named<M> model) {
    all.push_back({.name = model.name,
                   .run_case = run_case<M>,
                   .lags = has_lag<M>() && !has_outer_iterations<M>(),
                   .augmented = is_augmented<typename M::Enforcement>});
  });
  return all;
}
template <class M>
auto tested(const char* name) {
  return tested(run_time::Choices{run_time::Named<M>{name}}).front();
}

}  // namespace stability
