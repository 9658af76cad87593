// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/outcome.hpp>
#include <stickslip/contact/contact_record.hpp>
#include <stickslip/geometry/pose.hpp>
#include <stickslip/geometry/tool.hpp>
#include <stickslip/policy/model.hpp>

#include <list>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace stickslip {

/// The kind of tool of a model: `Model::Tool`, or what there is of its dimension.
template <class Model>
struct ToolKind {
  using type = typename detail::ToolNameOf<Model>::type;
};
template <class Model>
  requires std::is_void_v<typename detail::ToolNameOf<Model>::type>
struct ToolKind<Model> {
  using type = rigid::Tool<Model::Kinematics::dim>;
};
template <class Model>
using ToolOf = typename ToolKind<Model>::type;

/// See Contact.
template <int dim, class Tool, class Enforcement, class Law, bool with_friction>
struct ContactDescription {
  std::string side;             ///< named side of the mesh
  Tool tool;                    ///< in its own frame
  rigid::Motion<dim> motion{};  ///< the frame's pose over time
  /// Parameters of the law.
  [[no_unique_address]] StoredIf<with_friction, Law, ContactDescription> friction{};
  Enforcement enforcement{};  ///< parameters of the enforcement
  Real start_depth = 0;  ///< that a node may lie inside the tool at the start [length]; at least its spacing is allowed
  std::string name = "";  ///< for results; the side's name if empty. Not {}: GCC 12 breaks down where it is left out
};

/// A side of the body against a rigid tool: what the user says of it. `Friction` is the model's, or one of its
/// PerContact list. Of the model it depends on no more than it shows.
template <class Model, class Friction = typename Model::Friction>
using Contact = ContactDescription<Model::Kinematics::dim, ToolOf<Model>, typename Model::Enforcement,
                                   typename Friction::Law, Model::Enforcement::active && Friction::active>;

/// See SurfaceContacts.
template <class Enforcement, class Law, bool with_friction>
struct SurfaceContactDescription {
  std::string side;     ///< the slave: named side of a body; of two bodies the softer one, of two alike the coarser
  std::string against;  ///< the master: another side, or the same for contact with itself
  /// Parameters of the law.
  [[no_unique_address]] StoredIf<with_friction, Law, SurfaceContactDescription> friction{};
  Enforcement enforcement{};  ///< parameters of the enforcement
  Real start_depth = 0;   ///< that a node may lie inside the other body at the start [length]; its spacing is allowed
  std::string name = "";  ///< for results; "side on against" if empty
};

namespace detail {
template <class Model>
struct SurfaceList {
  using type = Empty<SurfaceList>;
};
template <class Model>
  requires has_surfaces<Model>
struct SurfaceList<Model> {
  using Friction = typename SurfacesOf<Model>::Friction;
  using type =
      std::vector<SurfaceContactDescription<typename Model::Enforcement, typename Friction::Law, Friction::active>>;
};
}  // namespace detail

/// The contacts between surfaces of a model, as the user gives them; nothing of a model that has none.
template <class Model>
using SurfaceContacts = typename detail::SurfaceList<Model>::type;

namespace detail {
template <class Model, class Friction, template <class, class> class List>
struct ContactLists {
  using type = List<Model, Friction>;
};
template <class Model, class... Frictions, template <class, class> class List>
struct ContactLists<Model, PerContact<Frictions...>, List> {
  using type = std::tuple<List<Model, Frictions>...>;
};
template <class Model, class Friction>
using ContactList = std::vector<Contact<Model, Friction>>;
}  // namespace detail

/// The contacts of a model as the user gives them: a list, or one list a kind of friction.
template <class Model>
using Contacts = typename detail::ContactLists<Model, typename Model::Friction, detail::ContactList>::type;

/// Calls visit on every entry of Contacts, or of what they become; of a model without contact there is none.
template <class Tag, class Visit>
void for_each_contact(const Empty<Tag>&, Visit&&) {}
template <class Entry, class Visit>
void for_each_contact(std::vector<Entry>& list, Visit&& visit) {
  for (Entry& one : list) visit(one);
}
template <class Entry, class Visit>
void for_each_contact(std::list<Entry>& list, Visit&& visit) {
  for (Entry& one : list) visit(one);
}
template <class Entry, class Visit>
void for_each_contact(const std::list<Entry>& list, Visit&& visit) {
  for (const Entry& one : list) visit(one);
}
template <class... Lists, class Visit>
void for_each_contact(std::tuple<Lists...>& lists, Visit&& visit) {
  std::apply([&](auto&... list) { (for_each_contact(list, visit), ...); }, lists);
}
template <class... Lists, class Visit>
void for_each_contact(const std::tuple<Lists...>& lists, Visit&& visit) {
  std::apply([&](const auto&... list) { (for_each_contact(list, visit), ...); }, lists);
}

/// Calls visit on the pairs with friction.
template <class Pairs, class Visit>
void for_each_friction(Pairs& pairs, Visit&& visit) {
  for_each_contact(pairs, [&](auto& pair) {
    if constexpr (std::remove_cvref_t<decltype(pair)>::with_friction) visit(pair);
  });
}
/// Calls visit on the pairs whose slip bounds lag.
template <class Pairs, class Visit>
void for_each_lagging(Pairs& pairs, Visit&& visit) {
  for_each_contact(pairs, [&](auto& pair) {
    if constexpr (std::remove_cvref_t<decltype(pair)>::lags) visit(pair);
  });
}
/// Calls visit on the pairs that take several outer iterations.
template <class Pairs, class Visit>
void for_each_outer(Pairs& pairs, Visit&& visit) {
  for_each_contact(pairs, [&](auto& pair) {
    if constexpr (std::remove_cvref_t<decltype(pair)>::outer_iterations) visit(pair);
  });
}

/// The first failure that visit(pair) gives for a pair with friction.
template <class Pairs, class Visit>
Failure first_failure(Pairs& pairs, Visit&& visit) {
  Failure failure;
  for_each_friction(pairs, [&](auto& pair) {
    if (!failure) failure = visit(pair);
  });
  return failure;
}

/// What all pairs did in the last evaluation.
template <class Pairs>
ContactSummary contact_summary(const Pairs& pairs) {
  ContactSummary sum;
  for_each_contact(pairs, [&](const auto& pair) { sum.merge(pair.trial_summary()); });
  return sum;
}

}  // namespace stickslip
