// SPDX-License-Identifier: BSL-1.0
// From names on the command line to models put together at compile time: what a wrong one is told, and the list.
#pragma once

#include "options.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/run_time.hpp>

#include <algorithm>
#include <iostream>
#include <string>

namespace examples {

/// Calls run.template operator()<Model>() for the model that the options name.
template <class Base, class Offered, class Frictions, class Run>
int dispatch(const Options& options, const Frictions& frictions, Run&& run) {
  try {
    return stickslip::run_time::dispatch<Base, Offered>(frictions, options.friction, options.solver, run);
  } catch (const stickslip::run_time::NotOffered& e) {
    const std::string text = e.what(), subject = "linear solver";
    throw BadOption(text.starts_with(subject) ? "--solver" + text.substr(subject.size()) : text);
  }
}

/// The option --element: the paper's, or the one that bends.
inline Parameter element_option() {
  return {.name = "element", .about = "element", .names = element_names};
}

/// `Base` with the element that bends.
template <class Base>
struct Bending : Base {
  using Element = stickslip::AssumedStrain<typename Base::Element::Cell>;
};

/// The laws that are instantiated with that element as well: those that the elements are compared with.
inline constexpr stickslip::run_time::Choices bending_laws{
    stickslip::run_time::Named<stickslip::Coulomb>{"coulomb"},
    stickslip::run_time::Named<stickslip::QuasiCoulomb>{"quasi-coulomb"}};

/// The same for either element.
template <class Base, class Offered, class Frictions, class Run>
int dispatch_element(const Options& options, const Frictions& frictions, Run&& run) {
  if (options.parameters.at("element") == 0) return dispatch<Base, Offered>(options, frictions, run);
  const auto laws = bending_laws.list();
  if (std::find(laws.begin(), laws.end(), options.friction) == laws.end())
    throw BadOption("--friction: \"" + options.friction + "\" is not offered with --element assumed-strain; it takes " +
                    joined(laws));
  return dispatch<Bending<Base>, Offered>(options, bending_laws, run);
}

/// What --list prints: every friction law with the solvers that take it. Returns the exit code.
template <class Base, class Offered, class Frictions>
int print_list(const Frictions& frictions) {
  frictions.for_each([]<class Friction>(stickslip::run_time::Named<Friction> law) {
    std::cout << law.name << ":";
    for (const std::string& solver : stickslip::run_time::solvers_for<Base, Offered, Friction>())
      std::cout << ' ' << solver;
    std::cout << '\n';
  });
  return 0;
}

}  // namespace examples
