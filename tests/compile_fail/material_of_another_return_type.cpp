// SPDX-License-Identifier: BSL-1.0
#include "model.hpp"

struct Rubber {
  using Role = role::Material;
  static constexpr Symmetry symmetry = Symmetry::symmetric;
  template <class S, class TensorPattern>
  struct State {};
  template <class S, class TensorPattern>
#ifdef CONTROL
  MaterialResponse<S, TensorPattern, State<S, TensorPattern>> respond(const Tensor<S, TensorPattern>&,
                                                                      const State<S, TensorPattern>&, Real) const;
#else
  Tensor<S, TensorPattern> respond(const Tensor<S, TensorPattern>&, const State<S, TensorPattern>&, Real) const;
#endif
};
struct Model : Sound {
  using Material = Rubber;
};

static_assert(CheckModel<Model>::ok);
