// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Rubber {
#ifdef CONTROL
  using Role = role::Material;
#endif
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  template <class S, class TensorPattern>
  struct State {};
  template <class S, class TensorPattern>
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>&,
                                                                      const State<S, TensorPattern>&, Real) const;
};
struct Model : Sound {
  using Material = Rubber;
};

static_assert(CheckModel<Model>::ok);
