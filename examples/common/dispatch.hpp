// SPDX-License-Identifier: BSL-1.0
// From names on the command line to models put together at compile time.
#pragma once

#include "chosen_solver.hpp"
#include "options.hpp"

#include <stickslip/policy/model.hpp>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

namespace examples {

/// A policy under its command-line name.
template <class Policy_>
struct Named {
  using Policy = Policy_;
  const char* name;
};

/// A list of named policies: `constexpr Choices frictions{Named<Coulomb>{"coulomb"}, ...};`
template <class... Policies>
struct Choices {
  explicit constexpr Choices(Named<Policies>... n) : names{n.name...} {}
  const char* names[sizeof...(Policies)];

  std::vector<std::string> list() const { return {std::begin(names), std::end(names)}; }
  /// Calls visit(Named) for each.
  template <class Visit>
  void for_each(Visit&& visit) const {
    std::size_t i = 0;
    (visit(Named<Policies>{names[i++]}), ...);
  }
};

/// `Base` with another friction and solver.
template <class Base, class Friction_, class Solver_>
struct With : Base {
  using Friction = Friction_;
  using LinearSolver = Solver_;
};

/// The models that programs offer: every valid one, but for a symmetric system no full matrix and nothing to correct.
template <class Model>
constexpr bool is_offered() {
  using namespace stickslip;
  if constexpr (!valid_model<Model>)
    return false;
  else
    return system_symmetry<Model> == Symmetry::general ||
           (matrix_storage<Model> == Symmetry::symmetric && !accepts_couplings<SolverOf<Model>>);
}

/// The solvers that take the system of the options' friction law.
template <class Base, class Frictions, class Solvers>
std::vector<std::string> able(const Options& options, const Frictions& frictions, const Solvers& solvers) {
  std::vector<std::string> found;
  frictions.for_each([&]<class F>(Named<F> friction) {
    if (options.friction != friction.name) return;
    solvers.for_each([&]<class S>(Named<S> solver) {
      if constexpr (is_offered<With<Base, F, S>>()) found.emplace_back(solver.name);
    });
  });
  return found;
}

/// Calls run.template operator()<Model>() for the model that the options name.
template <class Base, class Frictions, class Solvers, class Run>
int dispatch(const Options& options, const Frictions& frictions, const Solvers& solvers, Run&& run) {
  int code = -1;
  chosen_solver = options.solver;
  frictions.for_each([&]<class F>(Named<F> friction) {
    if (options.friction != friction.name) return;
    solvers.for_each([&]<class S>(Named<S> solver) {
      if constexpr (is_offered<With<Base, F, S>>()) {
        // A family's member itself, so that it and the family make one model.
        using Model = With<Base, F, stickslip::SolverOf<With<Base, F, S>>>;
        if (options.solver == solver.name) code = run.template operator()<Model>();
      }
    });
  });
  if (code < 0) {
    const auto others = able<Base>(options, frictions, solvers);
    const bool symmetric = std::find(others.begin(), others.end(), "cholmod") != others.end();
    throw BadOption("--solver: \"" + options.solver + "\" takes " +
                    (symmetric ? "non-symmetric systems and --friction " : "symmetric systems only and --friction ") +
                    options.friction + " makes a " + (symmetric ? "symmetric" : "non-symmetric") + " one; it takes " +
                    joined(others));
  }
  return code;
}

/// What --list prints: every friction law with the solvers that take it. Returns the exit code.
template <class Base, class Frictions, class Solvers>
int print_list(const Frictions& frictions, const Solvers& solvers) {
  frictions.for_each([&]<class F>(Named<F> friction) {
    std::cout << friction.name << ":";
    solvers.for_each([&]<class S>(Named<S> solver) {
      if constexpr (is_offered<With<Base, F, S>>()) std::cout << ' ' << solver.name;
    });
    std::cout << '\n';
  });
  return 0;
}

}  // namespace examples
