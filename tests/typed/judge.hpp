// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "axes.hpp"

#include <vector>

namespace typed {

/// Which models of the product a solver serves, in the order of mp_product over the other axes.
struct Judgement {
  Solver_ solver;
  std::vector<bool> valid;
};
std::vector<Judgement> judge_eigen(), judge_suitesparse(), judge_banded(), judge_mumps(), judge_iterative();

// In two stages: one list of all models would take gigabytes to compile.
using Bodies = mp_product<mp_list, AllKinematics, Treatments, Materials>;
using Contacts_ = mp_product<mp_list, Bounds, Sources, Enforcements, Inertias>;

template <class Solver, class Body, class Contacts>
struct Verdicts;
template <class Solver, class... B, class... C>
struct Verdicts<Solver, mp_list<B...>, mp_list<C...>> {
  template <class Contact>
  struct With;
  template <class... P>
  struct With<mp_list<P...>> : std::bool_constant<valid_model<Bundle<B..., P..., Solver>>> {};
  static constexpr bool all[] = {With<C>::value...};
};

/// Holds every bundle of one solver against the contracts.
template <Solver_ solver>
Judgement judge() {
  Judgement judgement{solver, {}};
  [&]<class... Body>(mp_list<Body...>) {
    using Solver = typename SolverType<solver>::type;
    (judgement.valid.insert(judgement.valid.end(), std::begin(Verdicts<Solver, Body, Contacts_>::all),
                            std::end(Verdicts<Solver, Body, Contacts_>::all)),
     ...);
  }(Bodies{});
  return judgement;
}

}  // namespace typed
