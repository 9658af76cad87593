// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/brief.hpp>
#include <stickslip/body/parts.hpp>
#include <stickslip/body/rigid_body_modes.hpp>
#include <stickslip/solve/system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace stickslip {

/// Names the contacts with friction whose summary of the last evaluation passes a test.
template <class Pairs, class Test>
std::string contacts_with(const Pairs& pairs, Test&& test) {
  std::string names;
  for_each_friction(pairs, [&](const auto& pair) {
    if (pair.trial_summary().touching > 0 && test(pair.trial_summary()))
      names += (names.empty() ? "contact \"" : ", contact \"") + pair.name() + "\"";
  });
  return names;
}
/// Names the contacts all of whose touching nodes slid in the last evaluation, or else those of which some did, or else
/// those that touched; empty if there is friction at none.
template <class Pairs>
std::string sliding_contacts(const Pairs& pairs) {
  std::string names = contacts_with(pairs, [](const ContactSummary& of) { return of.sliding == of.touching; });
  if (names.empty()) names = contacts_with(pairs, [](const ContactSummary& of) { return of.sliding > 0; });
  return names.empty() ? contacts_with(pairs, [](const ContactSummary&) { return true; }) : names;
}
/// Names the contacts whose slip turned within the last step by more than the step can resolve.
template <class Pairs>
std::string turning_contacts(const Pairs& pairs) {
  std::string names;
  for_each_friction(pairs, [&](const auto& pair) {
    if (pair.slip_turns_too_far()) names += (names.empty() ? "contact " : ", ") + pair.name();
  });
  return names;
}

/// Why a system has no solution, or many: what does not hold a part of the body, and what makes round-off of its
/// forces.
template <class Model>
class Diagnosis {
 public:
  static constexpr int dim = Model::Kinematics::dim;

  explicit Diagnosis(System<Model>& system)
      : system_(system), parts_(system.bodies()), modes_(system.bodies().positions(), parts_) {
    constexpr Index first = Model::Kinematics::hoop ? dim - 1 : 0;  // in axisymmetry the shift along the axis alone
    const IndexMap& dofs = system.dofs();
    std::vector<bool> held(static_cast<std::size_t>(parts_.count() * dim), false);
    for (Index c = 0; c < dofs.components(); ++c)
      if (dofs.equation(c) == IndexMap::constrained)
        held[static_cast<std::size_t>(parts_.at(c / dim) * dim + c % dim)] = true;
    for (Index part = 0; part < parts_.count(); ++part)
      for (Index i = first; i < dim; ++i)
        if (!held[static_cast<std::size_t>(part * dim + i)]) {
          unsupported_.push_back(part);
          break;
        }
  }

  /// A part of the body with a rigid-body mode at the displacements u that neither supports nor the tangent of the last
  /// evaluation resist. With `moved`, one that has moved so in that displacement besides: a motion that balance leaves
  /// open. -1 if there is none; see `part_name`.
  Index free_part(const Field& u, const Field* moved = nullptr) {
    modes_.take(u, system_.dofs(), system_.matrix());
    for (Index part = 0; part < parts_.count(); ++part) {
      const std::vector<Field> free = modes_.zero_energy_modes(part, moved ? 10 * system_.forces().norm : 0);
      if (free.empty()) continue;
      if (!moved) return part;
      Real share = 0, whole = 0;
      for (const Field& r : free) share = std::hypot(share, r.dot(*moved));
      for (Index c = 0; c < moved->size(); ++c)
        if (parts_.at(c / dim) == part) whole = std::hypot(whole, (*moved)[c]);
      if (share > 1e-6 * whole) return part;
    }
    return -1;
  }
  /// A part of the body that may shift in some direction, for it has no support there and touches no tool; at the start
  /// of a run (`ever`), for it has no node that could. -1 if there is none. Deformation resists no shift.
  Index loose_part(bool ever) const {
    for (const Index part : unsupported_) {
      bool held = false;
      for_each_contact(system_.pairs(), [&](const auto& pair) {
        for (std::size_t k = 0; k < pair.nodes().size() && !held; ++k)
          held = parts_.at(pair.nodes()[k]) == part && (ever || pair.touches(k));
      });
      if (!held) return part;
    }
    return -1;
  }
  /// The name of a part in a sentence; empty where the body is of one.
  std::string part_name(Index part) const { return parts_.name(part, system_.bodies()); }

  /// Whether friction alone resists some rigid-body mode at the displacements u and `time`. Spoils the last evaluation.
  bool held_by_friction(const Field& u, Real time) {
    return !system_.evaluate(u, time, 0, Want::frictionless_tangent) && free_part(u) >= 0;
  }

  /// What the round-off of the gaps makes of the pressures, at the stiffness of the penalty or the body, whichever is
  /// softer (theory.md, eq. 6.5) [force].
  Real gap_roundoff() const {
    Real square = 0, share = 1;  // of the stiffness that a body shows whose volume may go aside
    for_each_poisson([&](Real nu, const auto&) { share = std::min(share, (1 - 2 * nu) / (1 - nu)); });
    for_each_contact(system_.pairs(), [&](const auto& pair) { square += pair.gap_roundoff_squared(share); });
    return std::sqrt(square);
  }
  /// What of the scene makes round-off of the forces, in words: a stiffness more than `worst` times another one, if
  /// there is any; with `by_gaps` else the coordinates, to whose round-off the body answers. Spoils the last
  /// evaluation.
  std::string roundoff_source(const Field& u, bool by_gaps, Real worst) {
    std::string words;
    const auto accuse = [&](Real ratio, const std::string& text) {
      if (!(ratio > worst)) return;
      worst = ratio;
      words = text;
    };
    for_each_poisson([&](Real nu, const std::string& name) {
      const Real ratio = 2 * (1 + nu) / (3 * (1 - 2 * nu));
      accuse(ratio, "the bulk modulus" + (name.empty() ? "" : " of body \"" + name + "\"") + " is " + brief(ratio, 2) +
                        " times the shear modulus, at a Poisson's ratio " + brief(0.5 - nu, 2) + " below 0.5");
    });
    if (by_gaps) {
      if (!words.empty()) return words;
      const Real reach = system_.bodies().extent() + u.lpNorm<Eigen::Infinity>();
      return "coordinates of up to " + brief(reach, 2) + ", of a body that measures " + brief(modes_.extent(), 2) +
             " from its centre, give gaps to no better than " + brief(std::numeric_limits<Real>::epsilon() * reach, 2);
    }
    const Real stiffness = has_contact<Model> ? system_.body_stiffness(u) : 0;
    if (stiffness > 0)
      for_each_contact(system_.pairs(), [&](const auto& pair) {
        const Real ratio = pair.largest_stiffness() / stiffness;
        accuse(ratio,
               "the penalty of contact \"" + pair.name() + "\" is " + brief(ratio, 2) + " times the body's stiffness");
      });
    return words;
  }

 private:
  // Calls visit(nu, name) for the bodies whose material tells its Poisson's ratio.
  template <class Visit>
  void for_each_poisson(Visit&& visit) const {
    system_.bodies().for_each([&](const auto& body) {
      if constexpr (requires { body.material().poisson; }) visit(body.material().poisson, body.name());
    });
  }

  System<Model>& system_;
  Parts parts_;
  RigidBodyModes<typename Model::Kinematics> modes_;
  std::vector<Index> unsupported_;  // parts that only a tool could hold against some shift
};

}  // namespace stickslip
