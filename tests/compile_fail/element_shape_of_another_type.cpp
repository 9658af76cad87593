// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Cell : Quad4 {
#ifndef CONTROL
  static Vec<Real, 3> shape(const Vec<Real, 2>&);
#endif
};
struct Quad : FullyIntegrated<Quad4> {
  using Role = role::Element;
  using Cell = ::Cell;
};
struct Model : Sound {
  using Element = Quad;
};

static_assert(CheckModel<Model>::ok);
