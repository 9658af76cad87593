// SPDX-License-Identifier: BSL-1.0
// Contact between surfaces: the derivatives of feet, the tangent of a whole system, and what must not change forces.
#include <stickslip/contact/surface_contact.hpp>
#include <stickslip/element/mean_dilatation.hpp>
#include <stickslip/element/quad4.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/capped_coulomb.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/friction/slip_weakening.hpp>
#include <stickslip/friction/stribeck.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/kinematics/axisymmetric.hpp>
#include <stickslip/kinematics/plane_strain.hpp>
#include <stickslip/linear_solver/eigen_ldlt.hpp>
#include <stickslip/material/hencky.hpp>
#include <stickslip/solve/system.hpp>
#include <stickslip/time_integration/quasistatic.hpp>
#include <stickslip/verify/system.hpp>

#include <doctest/doctest.h>

#include <random>

namespace {

using namespace stickslip;

struct AnySolver {
  using Role = role::LinearSolver;
  static constexpr Symmetry accepts = Symmetry::general;
  static constexpr Symmetry storage = Symmetry::symmetric;
  void analyze(const SparseView&) {}
  Factorization factorize(const SparseView&) { return Factorization::failed; }
  bool solve(const Real*, Real*) { return false; }
};
template <class Kinematics_, class Friction_, class Enforcement_ = Penalty>
struct Model {
  struct Block {
    using Element = MeanDilatation<Quad4>;
    using Material = Hencky;
  };
  using Bodies = BodyTypes<Block>;
  using Kinematics = Kinematics_;
  using Friction = Frictionless;
  using Surfaces = SurfaceContact<Friction_>;
  using Enforcement = Enforcement_;
  using TimeIntegration = Quasistatic;
  using LinearSolver = AnySolver;
};

// Parameters of the laws with a coefficient mu, or what bears as much.
void give(Coulomb& law, Real mu) {
  law.mu = mu;
}
void give(CappedCoulomb& law, Real mu) {
  law = {.mu = mu, .tau_max = 100 * mu};
}
void give(Tresca& law, Real mu) {
  law.tau = 10 * mu;
}
void give(SlipWeakeningCoulomb& law, Real mu) {
  law = {.mu_static = mu, .mu_dynamic = 0.5 * mu, .length = 0.1};
}
void give(Stribeck& law, Real mu) {
  law = {.mu_static = mu, .mu_dynamic = 0.5 * mu, .speed = 0.1};
}

// Two blocks with a curved interface, of three and four facets, the upper one pressed on the lower and slid along it.
template <class M>
struct TwoBlocks {
  static constexpr bool rubs = SurfacesOf<M>::Friction::active;
  Bodies<M> bodies;
  ContactPairs<M> pairs;
  typename System<M>::Inertia inertia{};
  System<M> system;
  Field u;

  static Mesh<2, 4> block(Real low, Index columns) {
    auto mesh = mesh::rectangle({.origin = {0.2, low}, .size = {2, 1}, .cells = {columns, 1}});
    for (auto& x : mesh.nodes) x[1] += 0.2 * std::sin(1.5 * x[0]);
    return mesh;
  }
  static BodyDescriptions<M> described() {
    BodyDescriptions<M> list(2);
    list[0].name = "low";
    list[0].mesh = block(0, 4);
    list[1].name = "up";
    list[1].mesh = block(1, 3);
    for (auto& b : list) b.material = {.young = 20, .poisson = 0.3};
    return list;
  }
  ContactPairs<M>& paired(Real mu, bool low_is_slave) {
    SurfaceContacts<M> contacts(1);
    contacts[0].side = low_is_slave ? "low.top" : "up.bottom";
    contacts[0].against = low_is_slave ? "up.bottom" : "low.top";
    contacts[0].enforcement = {.normal = 2e3, .tangential = 5e2, .per = PenaltyPer::area};
    if constexpr (rubs) give(contacts[0].friction, mu);
    std::get<1>(pairs).emplace_back(contacts[0], bodies);
    return pairs;
  }
  explicit TwoBlocks(Real mu = 0.2, bool low_is_slave = false)
      : bodies(described(), {}), system(bodies, paired(mu, low_is_slave), inertia, {}, {}) {
    u.setZero(bodies.node_count() * 2);
    REQUIRE(!system.start(u, 0));
    u = moved(0.02, 0.015);
    REQUIRE(!system.evaluate(u, 1, 1));
    system.commit();
    system.update(u, 1, u);
    u = moved(0.05, 0.02);
  }
  // The upper block slid to the right and down, all nodes a little off.
  Field moved(Real slide, Real depth) const {
    std::mt19937 random(7);
    std::uniform_real_distribution<Real> some(-2e-3, 2e-3);
    Field v(bodies.node_count() * 2);
    for (Index n = 0; n < bodies.node_count(); ++n) {
      const bool up = n >= 10;
      v[2 * n] = (up ? slide : 0) + some(random);
      v[2 * n + 1] = (up ? -depth : 0) + some(random);
    }
    return v;
  }
  const auto& pair() const { return std::get<1>(pairs).front(); }
};

TEST_CASE("the derivatives of a foot are those of its gap and place, on a segment and at a vertex") {
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> some(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    Vec<Real, 8> z;  // slave nodes, master nodes
    for (int i = 0; i < 8; ++i) z[i] = 0.3 * some(random);
    z[0] -= 1, z[2] += 1, z[4] -= 1.3, z[6] += 1.2;
    z[5] += some(random), z[7] += some(random);
    const Real eta = 0.3, length = 2.2;
    const bool vertex = trial % 4 == 3, inside = trial % 8 == 3;
    const auto foot = [&](const Vec<Real, 8>& y) {
      const auto at = [&](int a) { return Vec<Real, 2>(y[2 * a], y[2 * a + 1]); };
      const Vec<Real, 2> x = (1 - eta) * at(0) + eta * at(1);
      return vertex ? SegmentFoot::at_vertex(x, eta, at(3), true, inside, {0, 1})
                    : SegmentFoot(x, eta, at(2), at(3), length);
    };
    const SegmentFoot here = foot(z);
    const Real normal = 1.7, along = -0.6, h = 1e-4;
    for (int i = 0; i < 8; ++i) {
      const auto at = [&](Real step) {
        Vec<Real, 8> y = z;
        y[i] += step;
        return foot(y);
      };
      const auto slope = [&](auto&& value) {
        return (8 * (value(at(h)) - value(at(-h))) - (value(at(2 * h)) - value(at(-2 * h)))) / (12 * h);
      };
      const auto p = static_cast<std::size_t>(i / 2);
      CHECK(here.gap_gradient(p)[i % 2] ==
            doctest::Approx(slope([](const SegmentFoot& f) { return f.gap(); })).epsilon(1e-9));
      const Real place = slope([&](const SegmentFoot& f) { return length * f.xi(); });
      CHECK(std::abs((vertex ? 0 : here.place_gradient(p)[i % 2]) - place) < 1e-9);
      for (std::size_t q = 0; q < 4; ++q)
        for (int j = 0; j < 2; ++j) {
          const Real curvature = slope([&](const SegmentFoot& f) {
            return normal * f.gap_gradient(q)[j] + (vertex ? 0 : along * f.place_gradient(q)[j]);
          });
          CHECK(std::abs(here.curvature(q, p, normal, vertex ? 0 : along)(j, i % 2) - curvature) < 1e-8);
        }
    }
  }
}

TEST_CASE_TEMPLATE(
    "the tangent of surfaces in contact is the derivative of their forces, and symmetric where it says so", M,
    Model<PlaneStrain, Frictionless>, Model<PlaneStrain, Coulomb>, Model<Axisymmetric, QuasiCoulomb>,
    Model<PlaneStrain, QuasiCoulomb, AugmentedLagrangian>, Model<Axisymmetric, Coulomb>,
    Model<PlaneStrain, CappedCoulomb>, Model<Axisymmetric, Tresca>,
    Model<PlaneStrain, WithPressure<SlipWeakeningCoulomb, Extrapolated>>,
    Model<Axisymmetric, WithPressure<Stribeck, LagIterated>>, Model<PlaneStrain, Stribeck>) {
  for (const bool low_is_slave : {false, true})
    for (const Real mu : {0.2, 5.0}) {  // slides, sticks
      TwoBlocks<M> blocks(mu, low_is_slave);
      const auto report = verify::system_tangent(blocks.system, blocks.u, 2, 1, 1e-6);
      CHECK(report.by_differences < 1e-8);
      CHECK(blocks.pair().trial_summary().touching > 2);
      if (TwoBlocks<M>::rubs) CHECK((blocks.pair().trial_summary().sliding > 0) == (mu < 1));
      const bool general = system_symmetry<M> == Symmetry::general && mu < 1;
      CHECK((report.asymmetry > 1e-3) == general);
      if (!general) CHECK(report.asymmetry < 1e-15);
    }
}

TEST_CASE("contact between surfaces is balanced in force and moment, and does not feel a common rigid motion") {
  using M = Model<PlaneStrain, Coulomb>;
  TwoBlocks<M> blocks;
  REQUIRE(!blocks.system.evaluate(blocks.u, 2, 1));
  const Field forces = blocks.system.forces().contact;
  Real moment = 0, largest = forces.lpNorm<Eigen::Infinity>();
  Vec<Real, 2> sum = Vec<Real, 2>::Zero();
  for (Index n = 0; n < blocks.bodies.node_count(); ++n) {
    const Vec<Real, 2> x = blocks.bodies.positions()[static_cast<std::size_t>(n)] + at_node<2>(blocks.u, n),
                       f = at_node<2>(forces, n);
    sum += f;
    moment += x[0] * f[1] - x[1] * f[0];
  }
  CHECK(largest > 1);
  CHECK(sum.norm() < 1e-13 * largest);
  CHECK(std::abs(moment) < 1e-13 * largest);

  // Turned by 0.7 rad and shifted, at the same points.
  Field turned = blocks.u;
  Mat<Real, 2> Q;
  Q << std::cos(0.7), -std::sin(0.7), std::sin(0.7), std::cos(0.7);
  for (Index n = 0; n < blocks.bodies.node_count(); ++n) {
    const Vec<Real, 2> X = blocks.bodies.positions()[static_cast<std::size_t>(n)];
    const Vec<Real, 2> x = Q * (X + at_node<2>(blocks.u, n)) + Vec<Real, 2>(0.4, -1.3);
    for (int i = 0; i < 2; ++i) turned[2 * n + i] = x[i] - X[i];
  }
  REQUIRE(!blocks.system.evaluate(turned, 2, 1));
  for (Index n = 0; n < blocks.bodies.node_count(); ++n)
    CHECK((at_node<2>(blocks.system.forces().contact, n) - Q * at_node<2>(forces, n)).norm() < 1e-12 * largest);
}

}  // namespace
