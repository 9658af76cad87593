// SPDX-License-Identifier: BSL-1.0
// Every valid model, part by part. What a model keeps falls into its body (kinematics, element, material), its contact
// (kinematics, bound, source, enforcement) and its inertia, each for one of two storages; every part that occurs in a
// valid model is of the size that its theory says. The models that run are held against the same sizes as wholes.
#include "sizes.hpp"

#include <doctest/doctest.h>

namespace typed {

using Solvers = mp_list<DeclaredSolver<Symmetry::symmetric>, DeclaredSolver<Symmetry::general>>;

template <std::size_t... last, class Visit>
constexpr int count(std::index_sequence<last...>, Visit visit) {
  return (0 + ... + visit(std::integral_constant<std::size_t, last>{}));
}
template <class Axis>
using Each = std::make_index_sequence<mp_size<Axis>::value>;

// 1 for a valid model, whose sizes are right then, and 0 for any other.
template <std::size_t k, std::size_t t, std::size_t m, std::size_t b, std::size_t s, std::size_t e, std::size_t i,
          std::size_t l>
constexpr int checked() {
  using Model =
      Combination<mp_at_c<AllKinematics, k>, mp_at_c<Treatments, t>, mp_at_c<Materials, m>, mp_at_c<Bounds, b>,
                  mp_at_c<Sources, s>, mp_at_c<Enforcements, e>, mp_at_c<Inertias, i>, mp_at_c<Solvers, l>>;
  if constexpr (valid_model<Model>) check_sizes<Model, m, b, s, e>();
  return valid_model<Model> ? 1 : 0;
}

TEST_CASE("the parts of every valid model store only the members that they need") {
  constexpr int bodies = count(Each<AllKinematics>{}, [](auto k) {
    return count(Each<Treatments>{}, [k](auto t) {
      return count(Each<Materials>{}, [k, t](auto m) {
        return count(Each<Solvers>{},
                     [k, t, m](auto l) { return checked<k, t, m, smooth, current, free_, still, l>(); });
      });
    });
  });
  static_assert(bodies == 3 * 3 * (6 * 2 + 4));
  constexpr int contacts = count(Each<AllKinematics>{}, [](auto k) {
    return count(Each<Bounds>{}, [k](auto b) {
      return count(Each<Sources>{}, [k, b](auto s) {
        return count(Each<Enforcements>{}, [k, b, s](auto e) {
          return count(Each<Solvers>{}, [k, b, s, e](auto l) { return checked<k, mean, hencky, b, s, e, still, l>(); });
        });
      });
    });
  });
  static_assert(contacts == (2 * 41 + 47) * 2 + (2 * 10 + 12));
  constexpr int inertias = count(Each<AllKinematics>{}, [](auto k) {
    return count(Each<Treatments>{}, [k](auto t) {
      return count(Each<Solvers>{},
                   [k, t](auto l) { return checked<k, t, hencky, smooth, current, free_, moving, l>(); });
    });
  });
  static_assert(inertias == 3 * 3 * 2);
  MESSAGE(bodies << " bodies, " << contacts << " contacts and " << inertias << " with inertia");
}

}  // namespace typed
