// SPDX-License-Identifier: BSL-1.0
#include <stickslip/contact/slip_reversals.hpp>

#include <doctest/doctest.h>

namespace {
using namespace stickslip;
using T = Vec<Real, 1>;

TEST_CASE("a node that slides to and fro from search to search is linearised as sticking, once for each iterate") {
  SlipReversals<1, false> nodes(1);
  nodes.begin_iteration();
  const auto evaluate = [&](Real force) {
    const bool sticks = nodes.sticks(0, 1, false);
    nodes.note(0, T(force), true, true);
    return sticks;
  };
  CHECK_FALSE(evaluate(1));
  nodes.next_search(false);
  CHECK_FALSE(evaluate(-1));  // the first reversal
  nodes.next_search(false);
  CHECK_FALSE(evaluate(1));               // the second one is seen at this iterate
  CHECK_FALSE(nodes.sticks(0, 1, true));  // whose tangent may be asked for again
  CHECK(nodes.sticks(0, 1, false));       // and counts from the next one on
  nodes.begin_iteration();
  CHECK_FALSE(nodes.sticks(0, 1, false));
}

TEST_CASE("a retry makes nodes stick that lose their pressure, or all of them") {
  SlipReversals<1, false> nodes(2);
  nodes.begin_iteration();
  nodes.retry(false);
  nodes.note(0, T(1.0), true, true);
  nodes.note(1, T(1.0), true, false);
  nodes.next_search(false);
  CHECK(nodes.sticks(0, 0, false));        // its gap asked for a pressure, the iteration has none
  CHECK_FALSE(nodes.sticks(0, 1, false));  // it has one
  CHECK_FALSE(nodes.sticks(1, 0, false));  // its gap asked for none
  nodes.begin_iteration();
  nodes.retry(true);
  CHECK(nodes.sticks(1, 0, false));
}

}  // namespace
