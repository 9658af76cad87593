// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

namespace stickslip {

/// The components of a nodal field at a node.
template <int dim>
Vec<Real, dim> at_node(const Field& field, Index node) {
  Vec<Real, dim> v;
  for (int i = 0; i < dim; ++i) v[i] = field[node * dim + i];
  return v;
}

/// Adds to the components of a nodal field at a node.
template <int dim>
void add_at_node(Field& field, Index node, const Vec<Real, dim>& v) {
  for (int i = 0; i < dim; ++i) field[node * dim + i] += v[i];
}

}  // namespace stickslip
