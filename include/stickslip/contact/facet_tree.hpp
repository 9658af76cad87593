// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

// Boost 1.74's R-tree includes a deprecated header of Boost's own, which warns in every translation unit.
#pragma push_macro("BOOST_ALLOW_DEPRECATED_HEADERS")
#undef BOOST_ALLOW_DEPRECATED_HEADERS
#define BOOST_ALLOW_DEPRECATED_HEADERS
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/core/cs.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_point_box.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#pragma pop_macro("BOOST_ALLOW_DEPRECATED_HEADERS")

#include <cstddef>
#include <utility>
#include <vector>

namespace stickslip {

/// Boxes of facets in a tree, for those that meet another box.
class FacetTree {
 public:
  /// By its least and its largest coordinates.
  struct Box {
    Vec<Real, 2> low, high;
  };

  template <class BoxOf>
  FacetTree(std::size_t count, BoxOf&& box_of) {
    std::vector<Leaf> leaves;
    leaves.reserve(count);
    for (std::size_t i = 0; i < count; ++i) leaves.emplace_back(in_tree(box_of(i)), i);
    tree_ = Tree(leaves);  // built at once: a packed tree
  }
  /// Calls visit(facet) for those whose boxes meet one.
  template <class Visit>
  void for_each_in(const Box& box, Visit&& visit) const {
    tree_.query(boost::geometry::index::intersects(in_tree(box)),
                boost::make_function_output_iterator([&](const Leaf& leaf) { visit(leaf.second); }));
  }

  /// Calls visit(facet) for those whose boxes are nearest to a place, `count` of them.
  template <class Visit>
  void for_each_near(const Vec<Real, 2>& x, unsigned count, Visit&& visit) const {
    tree_.query(boost::geometry::index::nearest(Point(x[0], x[1]), count),
                boost::make_function_output_iterator([&](const Leaf& leaf) { visit(leaf.second); }));
  }

 private:
  using Point = boost::geometry::model::point<Real, 2, boost::geometry::cs::cartesian>;
  using BoostBox = boost::geometry::model::box<Point>;
  using Leaf = std::pair<BoostBox, std::size_t>;
  using Tree = boost::geometry::index::rtree<Leaf, boost::geometry::index::rstar<8>>;
  static BoostBox in_tree(const Box& box) { return {Point(box.low[0], box.low[1]), Point(box.high[0], box.high[1])}; }
  Tree tree_;
};

}  // namespace stickslip
