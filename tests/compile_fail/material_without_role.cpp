// SPDX-License-Identifier: BSL-1.0
#include "bundle.hpp"

struct Rubber {
#ifdef CONTROL
  using Role = role::Material;
#endif
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  template <class S, class Shape>
  struct State {};
  template <class S, class Shape>
  MaterialResponse<S, Shape, State<S, Shape>> respond(const Tensor<S, Shape>&, const State<S, Shape>&, Real) const;
};
struct Bundle : Sound {
  using Material = Rubber;
};

static_assert(CheckModel<Bundle>::ok);
