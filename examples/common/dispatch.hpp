// SPDX-License-Identifier: BSL-1.0
// From names on the command line to models put together at compile time: what a wrong one is told, and the list.
#pragma once

#include "options.hpp"

#include <stickslip/run_time.hpp>

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
