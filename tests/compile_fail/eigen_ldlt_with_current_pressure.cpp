// SPDX-License-Identifier: BSL-1.0
#include <stickslip/stickslip.hpp>

using namespace stickslip;

struct Press : QuasistaticDefaults {
  using LinearSolver = EigenLdlt;
#ifdef CONTROL
  using Friction = QuasiCoulomb;
#else
  using Friction = Coulomb;
#endif
};

// A whole program of a user: the scene and its march add no error of their own.
int main() {
  Problem<Press> press{{.body = mesh::rectangle({}),
                        .material = {.young = 1, .poisson = 0.3},
                        .contacts = {{.side = "top",
                                      .tool = rigid::line({0, 1}, {-1, 0}),
                                      .friction = {.mu = 0.1},
                                      .enforcement = {.normal = 1, .tangential = 1}}}}};
  press.hold("bottom", 0).hold("bottom", 1);
  return press.march({.end = 1}).finish() ? 0 : 1;
}
