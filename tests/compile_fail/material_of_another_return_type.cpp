// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Rubber {
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  template <class S, class Shape>
  struct State {};
  template <class S, class Shape>
#ifdef CONTROL
  MaterialResponse<S, Shape, State<S, Shape>> respond(const Tensor<S, Shape>&, const State<S, Shape>&, Real) const;
#else
  Tensor<S, Shape> respond(const Tensor<S, Shape>&, const State<S, Shape>&, Real) const;
#endif
};
struct Bundle : Sound {
  using Material = Rubber;
};

static_assert(CheckModel<Bundle>::ok);
