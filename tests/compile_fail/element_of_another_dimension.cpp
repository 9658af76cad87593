// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

// A brick by its contract alone.
struct Brick {
  using Role = role::Element;
  static constexpr int dim = 3, nodes = 8, points = 8;
  struct Cell {
    static Vec<Real, 8> shape(const Vec<Real, 3>&);
    static Mat<Real, 8, 3> gradient(const Vec<Real, 3>&);
    static int quadrature();
  };
};
static_assert(ElementPolicy<Brick>);
struct Model : Sound {
#ifndef CONTROL
  using Element = Brick;
#endif
};

static_assert(CheckModel<Model>::ok);
