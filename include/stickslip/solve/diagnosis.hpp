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

/// Names the contacts with friction whose summary of the last evaluation passes a test; none where that failed.
template <class Pairs>
std::string contacts_with(const Pairs& pairs, bool (*test)(const ContactSummary&)) {
  std::string names;
  for_each_friction(pairs, [&](const auto& pair) {
    if (pair.evaluated() && pair.trial_summary().touching > 0 && test(pair.trial_summary()))
      names += joined({names.empty() ? "contact \"" : ", contact \"", pair.name(), "\""});
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
    if (pair.slip_turns_too_far()) names += joined({names.empty() ? "contact " : ", ", pair.name()});
  });
  return names;
}

namespace detail {
// What of a scene makes the most round-off, in words.
struct RoundoffSource {
  Real worst;  // ratio of stiffnesses that is still sound, or the worst found
  std::string words{};

  [[gnu::cold]] void consider_bulk_modulus(Real nu, const std::string& body) {
    const Real ratio = 2 * (1 + nu) / (3 * (1 - 2 * nu));
    if (!(ratio > worst)) return;
    worst = ratio;
    words = "the bulk modulus" + (body.empty() ? "" : " of body \"" + body + "\"") + " is " + brief(ratio, 2) +
            " times the shear modulus, at a Poisson's ratio " + brief(0.5 - nu, 2) + " below 0.5";
  }
  [[gnu::cold]] void consider_sticking(Real ratio, const std::string& contact) {
    if (!(ratio > worst)) return;
    worst = ratio;
    words =
        "the tangential penalty of contact \"" + contact + "\" is " + brief(ratio, 2) + " times the body's stiffness";
  }
  [[gnu::cold]] static std::string coordinates(Real reach, Real extent) {
    return "coordinates of up to " + brief(reach, 2) + ", of a body that measures " + brief(extent, 2) +
           " from its centre, give gaps to no better than " + brief(std::numeric_limits<Real>::epsilon() * reach, 2);
  }
};

// What holds the parts of bodies, whatever contact and solver of the model.
template <class Kinematics>
class PartSupports {
 public:
  static constexpr int dim = Kinematics::dim;

  template <class BodiesType>
  PartSupports(const BodiesType& bodies, const IndexMap& dofs)
      : parts_(bodies, dofs), modes_(bodies.positions(), parts_) {
    constexpr Index first = Kinematics::hoop ? dim - 1 : 0;  // in axisymmetry the shift along the axis alone
    std::vector<bool> held(static_cast<std::size_t>(parts_.count() * dim), false);
    for (Index c = 0; c < parts_.nodes() * dim; ++c)
      if (dofs.supported(c)) held[static_cast<std::size_t>(parts_.at(c / dim) * dim + c % dim)] = true;
    for (Index part = 0; part < parts_.count(); ++part)
      for (Index i = first; i < dim; ++i)
        if (!held[static_cast<std::size_t>(part * dim + i)]) {
          unsupported_.push_back(part);
          break;
        }
  }
  PartSupports(const PartSupports&) = delete;
  PartSupports& operator=(const PartSupports&) = delete;

 protected:
  // See Diagnosis::free_part; `imbalance` is the norm of the residual.
  Index free_part(const Field& u, const IndexMap& dofs, const SparseView& tangent, Real imbalance, const Field* moved) {
    modes_.take(u, dofs, tangent);
    for (Index part = 0; part < parts_.count(); ++part) {
      const std::vector<Field> free = modes_.zero_energy_modes(part, moved ? 10 * imbalance : 0);
      if (free.empty()) continue;
      if (!moved) return part;
      Real share = 0, whole = 0;
      for (const Field& r : free) share = std::hypot(share, r.dot(*moved));
      for (Index c = 0; c < parts_.nodes() * dim; ++c)
        if (parts_.at(c / dim) == part) whole = std::hypot(whole, (*moved)[c]);
      if (share > 1e-6 * whole) return part;
    }
    return -1;
  }

  Parts parts_;
  RigidBodyModes<Kinematics> modes_;
  std::vector<Index> unsupported_;  // parts that only a tool could hold against some shift
};
}  // namespace detail

/// Why a system has no solution, or many: what does not hold a part of the body, and what makes round-off of its
/// forces.
template <class Model>
class Diagnosis : public detail::PartSupports<typename Model::Kinematics> {
 public:
  using Base = detail::PartSupports<typename Model::Kinematics>;

  explicit Diagnosis(System<Model>& system) : Base(system.bodies(), system.dofs()), system_(system) {}

  /// A part of the body with a rigid-body mode at the displacements u that neither supports nor the tangent of the last
  /// evaluation resist. With `moved`, one that has moved so in that displacement besides: a motion that balance leaves
  /// open. -1 if there is none; see `part_name`.
  Index free_part(const Field& u, const Field* moved = nullptr) {
    return Base::free_part(u, system_.dofs(), system_.tangent().view(), system_.forces().norm, moved);
  }
  /// A part of the body that may shift in some direction, for it has no support there and touches no tool; at the start
  /// of a run (`ever`), for it has no node that could. -1 if there is none. Deformation resists no shift.
  Index loose_part(bool ever) const {
    for (const Index part : unsupported_) {
      bool held = false;
      for_each_contact(system_.pairs(), [&](const auto& pair) {
        pair.for_each_held(ever, [&](Index node) { held = held || parts_.at(node) == part; });
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
    detail::RoundoffSource source{worst};
    for_each_poisson([&](Real nu, const std::string& name) { source.consider_bulk_modulus(nu, name); });
    if (by_gaps)
      return source.words.empty()
                 ? source.coordinates(system_.bodies().extent() + u.lpNorm<Eigen::Infinity>(), modes_.extent())
                 : source.words;
    const Real stiffness = has_contact<Model> ? system_.body_stiffness(u) : 0;
    if (stiffness > 0)
      for_each_contact(system_.pairs(), [&](const auto& pair) {
        source.consider_sticking(pair.largest_stick_stiffness() / stiffness, pair.name());
      });
    return source.words;
  }

 private:
  using Base::parts_, Base::modes_, Base::unsupported_;

  // Calls visit(nu, name) for the bodies whose material tells its Poisson's ratio.
  template <class Visit>
  void for_each_poisson(Visit&& visit) const {
    system_.bodies().for_each([&](const auto& body) {
      if constexpr (requires { body.material().poisson; }) visit(body.material().poisson, body.name());
    });
  }

  System<Model>& system_;
};

}  // namespace stickslip
