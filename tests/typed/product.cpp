// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <doctest/doctest.h>

namespace typed {

using Product = mp_product<Bundle, AllKinematics, Elements, Materials, Frictions, Solvers>;
using Valid = mp_copy_if<Product, IsValid>;

template <class Model>
using IsCoulomb = std::is_same<typename Model::Friction, Coulomb>;

TEST_CASE("the product of all choices, and how much of it the rules admit") {
  static_assert(mp_size<Product>::value == 2 * 2 * 5 * 3 * 6);
  // Out of the 6 solvers, Coulomb's law with the current pressure bears 3, and so does the hypoelastic material with
  // any law; the rest bears all.
  static_assert(mp_size<Valid>::value == 2 * 2 * (4 * (2 * 6 + 3) + 3 * 3));
  static_assert(mp_size<mp_copy_if<Valid, IsCoulomb>>::value == 2 * 2 * 5 * 3);
  MESSAGE(mp_size<Product>::value << " bundles, " << mp_size<Valid>::value << " valid");
}

using Rubbing = mp_product<WithPressure, Bounds, Sources>;
template <class Friction>
using IsGeneral = std::bool_constant<friction_symmetry<Friction>() == Symmetry::general>;

TEST_CASE("any bound takes any pressure source, and the two decide on the solvers together") {
  using All =
      mp_product<Bundle, mp_list<PlaneStrain>, mp_list<MeanDilatation<Quad4>>, mp_list<Hencky>, Rubbing, Solvers>;
  using Admitted = mp_copy_if<All, IsValid>;
  static_assert(mp_size<Rubbing>::value == 5 * 3);
  // Of the bounds only Tresca's is symmetric at the current pressure.
  constexpr std::size_t general = mp_size<mp_copy_if<Rubbing, IsGeneral>>::value;
  static_assert(general == 4);
  static_assert(mp_size<Admitted>::value == general * 3 + (15 - general) * 6);
  MESSAGE(mp_size<Rubbing>::value << " friction policies, " << mp_size<Admitted>::value << " with a solver");
}

void check(const Answer& answer, bool hoop, bool friction, bool plastic) {
  REQUIRE_MESSAGE(answer.outcome, answer.outcome.message());
  CHECK(answer.steps == 3);
  CHECK(answer.rejected == 0);
  const Real scale = answer.force.norm();
  CHECK(answer.force[1] > 1);
  CHECK(std::abs(answer.reaction[1] - answer.force[1]) < 1e-9 * scale);
  // In axisymmetry the hoop stress bears radial force as well.
  if (!hoop) CHECK(std::abs(answer.reaction[0] - answer.force[0]) < 1e-9 * scale);
  if (friction) {
    CHECK(-answer.force[0] > 0.01 * scale);  // the body holds the tool back
    CHECK(answer.sliding > 0);
  } else {
    CHECK(std::abs(answer.force[0]) < 1e-12 * scale);
  }
  CHECK((answer.plastic_strain > 1e-3) == plastic);
}

void check_equal(const Answer& a, const Answer& b) {
  CHECK((a.u - b.u).norm() < 1e-9 * a.u.norm());
  CHECK((a.force - b.force).norm() < 1e-9 * a.force.norm());
  CHECK(a.iterations == b.iterations);
  CHECK(a.sliding == b.sliding);
}

}  // namespace typed
