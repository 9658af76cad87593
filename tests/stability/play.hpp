// SPDX-License-Identifier: BSL-1.0
// A scene of the plane or of space in run-time terms, played by bundles that were compiled once: cases instantiate
// nothing.
#pragma once

#include "suite.hpp"

#include <stickslip/geometry/tool.hpp>
#include <stickslip/inertia/generalized_alpha.hpp>
#include <stickslip/problem.hpp>
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
struct SceneryOf {
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
struct MomentOf {
  const StepReport& step;
  const Field& u;
  const std::vector<const ContactRecord<dim>*>& contacts;
  const std::function<Real(const std::string&, Index)>& reaction;
  const verify::Energies& energies;

  Vec<Real, dim> force(std::size_t contact = 0) const { return contacts[contact]->force(); }
};
template <int dim>
using LookOf = std::function<void(const MomentOf<dim>&)>;

/// The end of a run.
template <int dim>
struct PlayedOf {
  std::vector<Outcome> outcomes;
  RunReport report;  ///< sums of all marches
  Field u;
  std::vector<Vec<Real, dim>> forces;
  std::vector<ContactNodeState<dim>> nodes;  ///< of the first contact
  verify::Energies energies;
  Real time = 0, plastic = 0;
  std::vector<Warning> warnings{};  ///< of all marches
  Real unbalanced = 0;              ///< largest defect of the energy books over the largest amount in them

  const Outcome& outcome() const { return outcomes.back(); }
};

template <int dim>
struct BundleOf {
  std::string name;
  PlayedOf<dim> (*play)(const SceneryOf<dim>&, const LookOf<dim>&);
  bool lags = false;       ///< the bound is that of the last converged pressure
  bool augmented = false;  ///< no penetration is left
};

using Touch = TouchOf<2>;
using Scenery = SceneryOf<2>;
using Moment = MomentOf<2>;
using Look = LookOf<2>;
using Played = PlayedOf<2>;
using Bundle = BundleOf<2>;
/// Coulomb's friction on an elastic body, quasi-static: laws x solvers.
const std::vector<Bundle>& elastic();
/// The same, one of each law.
const Bundle &coulomb(), &quasi(), &augmented();
const Bundle& smooth();               ///< frictionless, elastic
const Bundle& metal();                ///< J2, linear hardening, Quasi-Coulomb, plane strain
const std::vector<Bundle>& sheets();  ///< J2, power hardening, axisymmetric: laws
const std::vector<Bundle>& moving();  ///< elastic with inertia: laws
const Bundle& ringing();              ///< frictionless, elastic with inertia, multipliers
const Bundle& tube();                 ///< J2, axisymmetric with inertia

namespace space {
using V = Vec<Real, 3>;
using M3 = Mat<Real, 3>;
using Touch = TouchOf<3>;
using Scenery = SceneryOf<3>;
using Moment = MomentOf<3>;
using Look = LookOf<3>;
using Played = PlayedOf<3>;
using Bundle = BundleOf<3>;
/// Coulomb's friction on an elastic body of hexahedra, quasi-static: laws x solvers.
const std::vector<Bundle>& elastic();
/// The same, one of each law.
const Bundle &coulomb(), &quasi(), &augmented();
const Bundle& smooth();               ///< frictionless, elastic
const Bundle& anisotropic();          ///< Coulomb's friction with an elliptic bound
const std::vector<Bundle>& moving();  ///< elastic with inertia: laws
}  // namespace space

/// Counts a run in a case and holds its books to a limit.
template <int dim>
void take(Case& c, const PlayedOf<dim>& played, Real limit = 1e-6) {
  c.counts(played.report.steps, played.report.iterations, played.report.rejected_steps);
  c.books(played.unbalanced, limit);
}
/// Plays a scene that must run to its end.
template <int dim>
PlayedOf<dim> completes(Case& c, const BundleOf<dim>& bundle, const SceneryOf<dim>& scenery,
                        const std::type_identity_t<LookOf<dim>>& look = {}, Real limit = 1e-6) {
  PlayedOf<dim> played = bundle.play(scenery, look);
  take(c, played, limit);
  for (const Outcome& outcome : played.outcomes) c.require(bool(outcome), bundle.name + ": " + outcome.message());
  return played;
}

inline SideValue held(const char* side, Index component) {
  return {side, component, nullptr};
}

/// One function for all bundles.
template <class M, int dim = M::Kinematics::dim>
PlayedOf<dim> play(const SceneryOf<dim>& scenery, const LookOf<dim>& look) {
  typename Problem<M>::Parameters parameters{.body = scenery.body};
  auto& material = parameters.material;
  material.young = scenery.young;
  material.poisson = scenery.poisson;
  if constexpr (requires { material.hardening.modulus; }) {
    material.hardening.yield = scenery.yield;
    material.hardening.modulus = scenery.hardening;
  } else if constexpr (requires { material.hardening.exponent; }) {
    material.hardening.strength = scenery.yield;
    material.hardening.offset = 1e-4;
    material.hardening.exponent = scenery.exponent;
  }
  if constexpr (has_inertia<M>) {
    parameters.inertia.density = scenery.density;
    parameters.inertia.scheme = scenery.scheme.value_or(chung_hulbert(scenery.radius));
  }
  if constexpr (has_contact<M>)
    for (const TouchOf<dim>& t : scenery.contacts) {
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
  for (const SideValue& d : scenery.driven) problem.drive(d.side, d.component, d.value);
  for (const SideValue& l : scenery.loads) problem.load(l.side, l.component, l.value);
  if constexpr (has_inertia<M>)
    if (scenery.velocity) problem.start_velocity(scenery.velocity);

  PlayedOf<dim> out;
  std::vector<const ContactRecord<dim>*> records;
  if constexpr (has_contact<M>) problem.visit_contacts([&](const auto& pair) { records.push_back(&pair); });
  const std::function<Real(const std::string&, Index)> reaction = [&](const std::string& side, Index component) {
    return problem.reaction(side, component);
  };
  std::optional<verify::EnergyLedger<M>> ledger;
  Real amount = 0, defect = 0;
  for (const MarchOptions& options : scenery.marches) {
    auto march = problem.march(options);
    if (!ledger) ledger.emplace(problem);
    for (const StepReport& step : march) {
      ledger->update(step);
      const verify::Energies& e = ledger->energies();
      amount = std::max({amount, std::abs(e.external), e.kinetic, e.elastic + e.penalty, e.plastic, e.friction});
      defect = std::max(defect, std::abs(e.unbalanced()));
      if (look) look({step, problem.displacement(), records, reaction, e});
    }
    out.outcomes.push_back(march.outcome());
    out.warnings.insert(out.warnings.end(), march.warnings().begin(), march.warnings().end());
    out.report.steps += march.report().steps;
    out.report.iterations += march.report().iterations;
    out.report.rejected_steps += march.report().rejected_steps;
    out.report.passes += march.report().passes;
    out.report.work.indefinite_factorizations += march.report().work.indefinite_factorizations;
    out.report.max_penetration = std::max(out.report.max_penetration, march.report().max_penetration);
    out.report.max_slip = std::max(out.report.max_slip, march.report().max_slip);
  }
  out.u = problem.displacement();
  for (const auto* record : records) out.forces.push_back(record->force());
  if (!records.empty()) out.nodes = records[0]->states();
  out.energies = ledger->energies();
  out.time = problem.time();
  out.plastic = problem.max_plastic_strain();
  out.unbalanced = amount > 0 ? defect / amount : 0;
  return out;
}

}  // namespace stability
