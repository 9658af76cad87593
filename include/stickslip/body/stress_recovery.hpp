// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/body/bodies.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <tuple>
#include <utility>
#include <vector>

namespace stickslip {

/// A continuous stress over the nodes, the mean of what the elements around them say, and how far the elements' own are
/// from it: an estimate of the error of the mesh (Zienkiewicz & Zhu 1987; theory.md, eq. 6.20).
template <class Body>
class StressRecovery {
 public:
  using TensorPattern = typename Body::TensorPattern;
  using Stress = Tensor<Real, TensorPattern>;

  explicit StressRecovery(const Body& body)
      : stress_(body.mesh().cells.size()),
        nodal_(body.mesh().nodes.size()),
        share_(body.mesh().nodes.size()),
        error_(body.mesh().cells.size()) {
    const auto rule = quadrature_of<typename Body::Element>();
    for (std::size_t p = 0; p < points; ++p) shape_[p] = Body::Element::Cell::shape(rule[p].xi);
  }

  /// Recovers the Cauchy stress of the converged memory at the displacements u.
  void update(const Body& body, const Field& u) {
    for (Stress& s : nodal_) s.v.setZero();
    std::fill(share_.begin(), share_.end(), 0.0);
    body.visit_points(u, [&](Index cell, int point, const Stress& F, const auto& state, Real weight) {
      const auto e = static_cast<std::size_t>(cell), p = static_cast<std::size_t>(point);
      Stress& cauchy = stress_[e][p];
      cauchy = kirchhoff(body.material().respond(F, state, 0.0).P, F);
      cauchy.v = scaled(cauchy.v, 1 / determinant(F));
      for (std::size_t a = 0; a < nodes; ++a) {
        const auto n = static_cast<std::size_t>(body.mesh().cells[e][a]);
        const Real share = weight * shape_[p][static_cast<int>(a)];
        add(nodal_[n].v, cauchy.v, share);
        share_[n] += share;
      }
    });
    for (std::size_t n = 0; n < nodal_.size(); ++n)
      if (share_[n] > 0) nodal_[n].v = scaled(nodal_[n].v, 1 / share_[n]);
    errors_ = whole_ = 0;
    for (std::size_t e = 0; e < stress_.size(); ++e) {
      error_[e] = 0;
      Real volume = 0;
      for (std::size_t p = 0; p < points; ++p) {
        const Real weight = body.geometry(static_cast<Index>(e))[p].weight;
        Stress off = stress_[e][p];
        whole_ += weight * contraction(off.v, off.v);
        for (std::size_t a = 0; a < nodes; ++a)
          add(off.v, nodal_[static_cast<std::size_t>(body.mesh().cells[e][a])].v, -shape_[p][static_cast<int>(a)]);
        error_[e] += weight * contraction(off.v, off.v);
        volume += weight;
      }
      errors_ += error_[e];
      error_[e] = std::sqrt(error_[e] / volume);
    }
  }

  /// Cauchy stress of a quadrature point, as its element has it [stress].
  const Stress& stress(Index cell, int point) const {
    return stress_[static_cast<std::size_t>(cell)][static_cast<std::size_t>(point)];
  }
  /// Squares of the norms of the estimated error and of the stress, over the body [stress^2 volume].
  Real error_squared() const { return errors_; }
  Real norm_squared() const { return whole_; }
  /// Root mean square of the estimated error by cell [stress].
  const std::vector<Real>& cells() const { return error_; }

 private:
  static constexpr std::size_t points = static_cast<std::size_t>(Body::Element::points);
  static constexpr std::size_t nodes = static_cast<std::size_t>(Body::Element::nodes);
  std::vector<std::array<Stress, points>> stress_;
  std::vector<Stress> nodal_;
  std::vector<Real> share_, error_;
  std::array<Vec<Real, Body::Element::nodes>, points> shape_;
  Real errors_ = 0, whole_ = 0;
};

/// The recovered stresses of all bodies of a scene.
template <class BodiesType>
class StressRecoveries {
 public:
  explicit StressRecoveries(const BodiesType& bodies) {
    bodies.for_each([&](const auto& body) { of(body).emplace_back(body); });
  }
  void update(const BodiesType& bodies, const Field& u) {
    errors_ = whole_ = 0;
    std::apply([](auto&... next) { ((next.second = next.first.begin()), ...); }, recoveries_);
    bodies.for_each([&](const auto& body) {
      auto& next = std::get<ListOf<std::remove_cvref_t<decltype(body)>>>(recoveries_).second;
      next->update(body, u);
      errors_ += next->error_squared();
      whole_ += next->norm_squared();
      ++next;
    });
  }
  /// Norm of the estimated error over that of the stress, over the bodies [-].
  Real relative() const { return whole_ > 0 ? std::sqrt(errors_ / whole_) : 0; }

 private:
  template <class Body>
  using ListOf = std::pair<std::list<StressRecovery<Body>>, typename std::list<StressRecovery<Body>>::iterator>;
  template <class Stored>
  struct Lists;
  template <class... Bodies>
  struct Lists<std::tuple<std::list<Bodies>...>> {
    using type = std::tuple<ListOf<Bodies>...>;
  };
  template <class Body>
  auto& of(const Body&) {
    return std::get<ListOf<Body>>(recoveries_).first;
  }
  typename Lists<typename BodiesType::Stored>::type recoveries_;  // with the next to be updated
  Real errors_ = 0, whole_ = 0;
};

}  // namespace stickslip
