// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/nodal.hpp>
#include <stickslip/contact/facet_tree.hpp>
#include <stickslip/mesh/mesh.hpp>
#include <stickslip/tensor/products.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace stickslip {

/// The facets of a side that touch another surface, in the plane a chain of segments with the body on the left.
class Surface {
 public:
  static constexpr int dim = 2;
  using Point = Vec<Real, dim>;
  using Facet = std::array<Index, 2>;
  static constexpr Index none = -1;

  /// Of the facets of a side, by the numbers of the scene's nodes, at the reference positions X. It must outlive this.
  /// Throws std::invalid_argument, naming the side, where more than two facets meet at a node.
  Surface(std::vector<Facet> facets, const std::vector<Point>& X, const std::string& side)
      : X_(X), facets_(std::move(facets)) {
    connect(side);
    measure();
  }

  std::size_t size() const { return facets_.size(); }
  const Facet& facet(std::size_t f) const { return facets_[f]; }
  const std::vector<Facet>& facets() const { return facets_; }
  const std::vector<Index>& nodes() const { return nodes_; }
  /// The facets that follow and precede one in its chain; `none` at an end.
  Index next(std::size_t f) const { return next_[f]; }
  Index previous(std::size_t f) const { return previous_[f]; }
  /// Reference length of a facet [length].
  Real length(std::size_t f) const { return length_[f]; }
  Real largest_length() const { return *std::max_element(length_.begin(), length_.end()); }
  /// Of the facets at the displacements u.
  Real largest_length(const Field& u) const {
    Real largest = 0;
    for (const Facet& f : facets_) largest = std::max(largest, minus(position(u, f[1]), position(u, f[0])).norm());
    return largest;
  }
  /// How deep a point may lie behind a facet to be in contact with it: half the wall's thickness there, as far as this
  /// surface bounds the wall, and no more than the facet's length [length].
  Real deepest(std::size_t f) const { return deepest_[f]; }
  /// Whether two facets of the surface are the same or closer along it than two facets: no contact between these.
  bool neighbours(std::size_t f, std::size_t g) const {
    const auto same = [&](Index a) { return a == static_cast<Index>(g); };
    if (f == g) return true;
    for (const Index near : {next_[f], previous_[f]})
      if (near != none && (same(near) || same(next_[static_cast<std::size_t>(near)]) ||
                           same(previous_[static_cast<std::size_t>(near)])))
        return true;
    return false;
  }

  /// The same of a facet and the facets of a node.
  bool near(Index node, std::size_t f) const {
    const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), node);
    if (found == nodes_.end() || *found != node) return false;
    for (const Index own : facets_at_[static_cast<std::size_t>(found - nodes_.begin())])
      if (own != none && neighbours(static_cast<std::size_t>(own), f)) return true;
    return false;
  }
  /// How deep a place lies behind the facet that is closest to it; negative in front of it, 0 past an end [length].
  Real depth(const Field& u, const Point& x, const FacetTree& tree) const {
    Real nearest = std::numeric_limits<Real>::infinity(), depth = 0;
    tree.for_each_near(x, 16, [&](std::size_t f) {
      const Point a = position(u, facets_[f][0]), way = minus(position(u, facets_[f][1]), a), from = minus(x, a);
      const Real square = contraction(way, way), xi = contraction(from, way) / square;
      Point away = from;
      add(away, way, -std::clamp(xi, Real(0), Real(1)));
      const Real distance = away.norm();
      if (!(distance < nearest)) return;
      nearest = distance;
      const bool past = (xi < 0 && previous_[f] == none) || (xi > 1 && next_[f] == none);
      depth = past ? 0 : std::copysign(distance, way[0] * from[1] - way[1] * from[0]);
    });
    return depth;
  }
  /// Reference position of a node [length].
  const Point& reference(Index node) const { return X_[static_cast<std::size_t>(node)]; }
  /// Position of a node at the displacements u [length].
  Point position(const Field& u, Index node) const {
    Point x = X_[static_cast<std::size_t>(node)];
    add(x, at_node<dim>(u, node));
    return x;
  }
  /// Outward normal of a facet at the displacements u.
  Point normal(const Field& u, std::size_t f) const {
    const Point along = minus(position(u, facets_[f][1]), position(u, facets_[f][0]));
    const Real length = along.norm();
    return Point(along[1] / length, -along[0] / length);
  }

  /// Takes the configuration at the displacements u as the one whose arc lengths are the places.
  void take_places(const Field& u) {
    start_.assign(size(), 0.0);
    places_length_.resize(size());
    for (const std::size_t first : firsts_) {
      Real along = 0;
      std::size_t f = first;
      do {
        start_[f] = along;
        along += places_length_[f] = minus(position(u, facets_[f][1]), position(u, facets_[f][0])).norm();
        if (next_[f] == none) break;
        f = static_cast<std::size_t>(next_[f]);
      } while (f != first);
      perimeter_[chain_[first]] = along;
    }
  }
  /// Arc length of the point xi of a facet, in 0 to 1, in that configuration [length].
  Real place(std::size_t f, Real xi) const { return start_[f] + xi * places_length_[f]; }
  /// Length of the facet there [length].
  Real places_length(std::size_t f) const { return places_length_[f]; }
  /// The way between two places of facets: the shorter one around a closed chain [length].
  Real way(std::size_t to_facet, Real to, Real from) const {
    Real d = to - from;
    const std::size_t chain = chain_[to_facet];
    if (closed_[chain]) d -= perimeter_[chain] * std::round(d / perimeter_[chain]);
    return d;
  }
  bool same_chain(std::size_t f, std::size_t g) const { return chain_[f] == chain_[g]; }

 private:
  // Sorts the facets along their chains.
  void order(const std::string& side) {
    std::map<Index, Facet> begins;
    std::map<Index, int> ends;
    for (const Facet& f : facets_)
      if (!begins.emplace(f[0], f).second || ++ends[f[1]] > 1)
        throw std::invalid_argument("surface contact: side \"" + side + "\" branches at node " +
                                    std::to_string(ends[f[1]] > 1 ? f[1] : f[0]));
    std::vector<Facet> sorted;
    const auto walk = [&](Index first) {
      for (auto at = begins.find(first); at != begins.end(); at = begins.find(sorted.back()[1])) {
        sorted.push_back(at->second);
        begins.erase(at);
      }
    };
    for (const Facet& f : facets_)
      if (ends[f[0]] == 0) walk(f[0]);
    while (!begins.empty()) walk(begins.begin()->first);
    facets_ = std::move(sorted);
  }
  void connect(const std::string& side) {
    order(side);
    std::map<Index, Index> begins, ends;
    for (std::size_t f = 0; f < size(); ++f) {
      begins[facets_[f][0]] = static_cast<Index>(f);
      ends[facets_[f][1]] = static_cast<Index>(f);
      for (const Index n : facets_[f]) nodes_.push_back(n);
    }
    std::sort(nodes_.begin(), nodes_.end());
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
    for (const Index n : nodes_) {
      const auto begin = begins.find(n), end = ends.find(n);
      facets_at_.push_back({begin == begins.end() ? none : begin->second, end == ends.end() ? none : end->second});
    }
    const auto at = [](const std::map<Index, Index>& list, Index node) {
      const auto found = list.find(node);
      return found == list.end() ? none : found->second;
    };
    for (std::size_t f = 0; f < size(); ++f) {
      next_.push_back(at(begins, facets_[f][1]));
      previous_.push_back(at(ends, facets_[f][0]));
    }
    chain_.assign(size(), size());
    const auto walk = [&](std::size_t first) {
      firsts_.push_back(first);
      std::size_t f = first;
      for (;;) {
        chain_[f] = firsts_.size() - 1;
        if (next_[f] == none) return closed_.push_back(false);
        f = static_cast<std::size_t>(next_[f]);
        if (f == first) return closed_.push_back(true);
      }
    };
    for (std::size_t f = 0; f < size(); ++f)
      if (previous_[f] == none) walk(f);
    for (std::size_t f = 0; f < size(); ++f)
      if (chain_[f] == size()) walk(f);
    perimeter_.assign(firsts_.size(), 0.0);
  }
  // Lengths, and the thickness of the wall by a ray inwards.
  void measure() {
    const Field rest = Field::Zero(X_.empty() ? 0 : static_cast<Index>(X_.size()) * dim);
    for (const Facet& f : facets_) length_.push_back(minus(position(rest, f[1]), position(rest, f[0])).norm());
    const FacetTree tree(size(), [&](std::size_t f) { return box(rest, f, 0); });
    for (std::size_t f = 0; f < size(); ++f) {
      const Point a = position(rest, facets_[f][0]), b = position(rest, facets_[f][1]), N = normal(rest, f);
      const Point from = scaled(Point(a + b), Real(0.5));
      Real thickness = 2 * length_[f];
      Point end = from;
      add(end, N, -thickness);
      FacetTree::Box ray{from.cwiseMin(end), from.cwiseMax(end)};
      tree.for_each_in(ray, [&](std::size_t g) {
        if (g == f) return;
        const Point c = position(rest, facets_[g][0]), d = position(rest, facets_[g][1]), M = normal(rest, g);
        const Real rate = -contraction(M, N);  // of the distance to g along the ray
        if (!(rate > 0.1)) return;             // seen from inside
        const Real reach = -contraction(M, minus(from, c)) / rate;
        Point hit = from;
        add(hit, N, -reach);
        const Point way = minus(d, c);
        const Real xi = contraction(minus(hit, c), way) / contraction(way, way);
        if (reach > 1e-9 * length_[f] && xi > -1e-9 && xi < 1 + 1e-9) thickness = std::min(thickness, reach);
      });
      deepest_.push_back(0.5 * thickness);
    }
  }

 public:
  /// Box of a facet at the displacements u, wider by `reach`.
  FacetTree::Box box(const Field& u, std::size_t f, Real reach) const {
    const Point a = position(u, facets_[f][0]), b = position(u, facets_[f][1]);
    const Point margin(reach, reach);
    return {a.cwiseMin(b) - margin, a.cwiseMax(b) + margin};
  }

 private:
  const std::vector<Point>& X_;
  std::vector<Facet> facets_;
  std::vector<Index> nodes_, next_, previous_;
  std::vector<std::array<Index, 2>> facets_at_;  // of a node, the one that it begins and the one that it ends
  std::vector<std::size_t> chain_, firsts_;      // of a facet; of a chain
  std::vector<bool> closed_;                     // of a chain
  std::vector<Real> length_, deepest_, start_, places_length_, perimeter_;
};

}  // namespace stickslip
