// SPDX-License-Identifier: BSL-1.0
// An element under homogeneous stretch keeps its stiffness against hourglass motions as long as the material bears it.
#include "scene.hpp"

#include <stickslip/element/assumed_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/verify/element.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

namespace hourglass {

using namespace scene;
using Bends = AssumedStrain<Quad4>;
using Mean = MeanDilatation<Quad4>;
using U = Vec<Real, 8>;

// A rectangle in plane strain, stretched along y, its sides free.
template <class Element, class Material>
class Stretched {
 public:
  Stretched(const Material& material, Real width, Real height)
      : element_{.material = material, .X = Mat<Real, 4, 2>{{0, 0}, {width, 0}, {width, height}, {0, height}}} {}

  /// Least eigenvalue of the stiffness against hourglass motions, over the shear modulus, at a stretch along y that is
  /// reached in one step from the last kept one.
  Real stiffness(Real stretch) {
    settle(stretch);
    Mat<Real, 8, 2> modes = Mat<Real, 8, 2>::Zero();
    for (int a = 0; a < 4; ++a) modes(2 * a, 0) = modes(2 * a + 1, 1) = a % 2 == 0 ? 0.5 : -0.5;
    const Mat<Real, 2> block = modes.transpose() * element_.template at<Real>(u_, old_).tangent * modes;
    const Real half = (block(0, 0) + block(1, 1)) / 2;
    const Real least = half - std::hypot((block(0, 0) - block(1, 1)) / 2, block(0, 1));
    return least * 2 * (1 + element_.material.poisson) / element_.material.young;
  }
  /// Keeps the memory of the stretch that was looked at last.
  void keep() { old_ = element_.template at<Real>(u_, old_).states; }

 private:
  // Lets the sides move until they are free of force.
  void settle(Real stretch) {
    for (int iteration = 0; iteration < 30; ++iteration) {
      for (int a = 0; a < 4; ++a) {
        u_[2 * a] = (lateral_ - 1) * element_.X(a, 0);
        u_[2 * a + 1] = (stretch - 1) * element_.X(a, 1);
      }
      const auto result = element_.template at<Real>(u_, old_);
      const Real width = element_.X(1, 0), force = result.residual[2] + result.residual[4];
      const Real slope = result.tangent(2, 2) + result.tangent(2, 4) + result.tangent(4, 2) + result.tangent(4, 4);
      const Real change = -force / slope / width;
      lateral_ += change;
      if (std::abs(change) < 1e-13) return;
    }
    FAIL("the sides do not become free of force");
  }

  verify::SingleElement<Element, PlaneStrain, Material> element_;
  typename decltype(element_)::template Memory<Real> old_{};
  U u_ = U::Zero();
  Real lateral_ = 1;
};

// The stretch on the way to `end` at which the hourglass stiffness vanishes, if it does, by steps and then by
// bisection.
template <class Element, class Material>
std::optional<Real> instability(const Material& material, Real width, Real height, Real end) {
  Stretched<Element, Material> element(material, width, height);
  REQUIRE(element.stiffness(1) > 0);
  constexpr int steps = 200;
  Real good = 1;
  for (int k = 1; k <= steps; ++k) {
    Real bad = 1 + (end - 1) * k / steps;
    const Real stiffness = element.stiffness(bad);
    if (!(stiffness > 0)) {
      while (std::abs(bad - good) > 1e-6) {
        const Real middle = (good + bad) / 2;
        (element.stiffness(middle) > 0 ? good : bad) = middle;
      }
      return bad;
    }
    element.keep();
    good = bad;
  }
  return {};
}

const std::array<std::pair<Real, Real>, 4> shapes{{{1, 1}, {1, 0.25}, {0.25, 1}, {1, 0.1}}};
const FiniteJ2<LinearHardening> soft{.young = 1000, .poisson = 0.3, .hardening = {.yield = 2, .modulus = 5}};

TEST_CASE("an element that bends stays stable when it is compressed to 0.3 of its height") {
  for (const auto& shape : shapes) {
    const Real width = shape.first, height = shape.second;  // copies: bindings cannot be captured
    CAPTURE(width);
    CAPTURE(height);
    for (const Real poisson : {0.3, 0.4999})
      CHECK_FALSE(instability<Bends>(Hencky{.young = 1000, .poisson = poisson}, width, height, 0.3));
    CHECK_FALSE(instability<Bends>(soft, width, height, 0.3));
  }
  // The search finds what is there: a column of one Q1/P0 element.
  const auto stretch = instability<Mean>(Hencky{.young = 1000, .poisson = 0.4999}, 0.25, 1, 0.3);
  REQUIRE(stretch);
  CHECK(std::abs(*stretch - 0.4642) < 1e-3);
}

TEST_CASE("an element that bends becomes unstable in tension where its material does, at Considere's stretch") {
  // Plane strain: the stress 2/sqrt(3) (Y + h e) meets its slope 4/3 h, in the stretch along y.
  const Real slope = 4. / 3 * 5, considere = std::exp((slope - 2 / std::sqrt(3.) * 2) / slope);
  for (const auto& shape : shapes) {
    const Real width = shape.first, height = shape.second;  // copies: bindings cannot be captured
    CAPTURE(width);
    CAPTURE(height);
    const auto stretch = instability<Bends>(soft, width, height, 2.5);
    REQUIRE(stretch);
    MESSAGE(width << " x " << height << ": " << *stretch << ", Considere " << considere);
    CHECK(std::abs(*stretch / considere - 1) < 1e-4);
  }
  CHECK_FALSE(instability<Mean>(soft, 1, 1, 2.5));  // its parasitic shear bears it
}

// Negative pivots of a square block of nearly incompressible material that frictionless plates compress to half its
// height, by steps of 2.5 %.
template <class Element>
std::vector<Index> negative_pivots(Index cells) {
  Problem<Lone<EigenLdlt, Hencky, PlaneStrain, Element>> p(
      {.body = mesh::rectangle({.cells = {cells, cells}}), .material = {.young = 1000, .poisson = 0.4999}});
  p.hold("bottom", 1).hold("left", 0).drive("top", 1, [](Real t) { return -0.5 * t; });
  auto march = p.march({.end = 1, .steps = 20, .tolerance = 1e-8});
  std::vector<Index> pivots;
  for (const StepReport& step : march) pivots.push_back(step.negative_pivots);
  CHECK(bool(march.outcome()));
  return pivots;
}

Index first_negative(const std::vector<Index>& pivots) {
  return Index(std::find_if(pivots.begin(), pivots.end(), [](Index n) { return n > 0; }) - pivots.begin());
}
TEST_CASE("a block of elements that bend has no negative pivot under compression before the body has one") {
  const Index body = first_negative(negative_pivots<Mean>(16));
  CHECK(body == 16);  // at 42.5 %
  CHECK(first_negative(negative_pivots<Bends>(16)) == body);
  CHECK(first_negative(negative_pivots<Bends>(4)) >= body);
}

// A block between plates that hold it sideways, squeezed by steps of 2.5 %: its force over that of Q1/P0, and the step
// that warns of its strain.
std::pair<Real, Index> confined(Index cells, Real poisson, Index steps) {
  const auto squeezed = [&]<class Element>(std::type_identity<Element>, Index& warned) {
    Problem<Lone<EigenLdlt, Hencky, PlaneStrain, Element>> p(
        {.body = mesh::rectangle({.cells = {cells, cells}}), .material = {.young = 1000, .poisson = poisson}});
    p.hold("bottom", 0).hold("bottom", 1).hold("top", 0).drive("top", 1, [](Real t) { return -0.025 * t; });
    auto march = p.march({.end = Real(steps), .steps = steps});
    const Outcome outcome = march.finish();
    CHECK_MESSAGE(outcome, outcome.message());
    for (const Warning& w : march.warnings())
      if (w.name == "varied_strain") warned = w.step;
    return p.reaction("top", 1);
  };
  Index warned = 0, never = 0;
  const Real force = squeezed(std::type_identity<Bends>{}, warned), mean = squeezed(std::type_identity<Mean>{}, never);
  CHECK(never == 0);
  return {force / mean, warned};
}

TEST_CASE("a confined block of elements that bend says when it locks, and only then") {
  // The limit of the element, as a program without this library finds it too: nearly incompressible and coarse.
  const auto [coarse, warned] = confined(4, 0.4999, 18);
  MESSAGE("4 x 4: " << coarse << ", warned in step " << warned);
  CHECK(coarse > 10);
  CHECK(warned == 13);
  CHECK(std::abs(confined(4, 0.4999, 13).first - 1.3) < 0.1);
  const auto [fine, silent] = confined(16, 0.4999, 10);
  CHECK(std::abs(fine - 1) < 0.02);
  CHECK(silent == 0);
  const auto [of_compressible, none] = confined(4, 0.3, 18);
  CHECK(std::abs(of_compressible - 1) < 0.02);
  CHECK(none == 0);
}
}  // namespace hourglass
