// SPDX-License-Identifier: BSL-1.0
#include "element_check.hpp"

#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>

namespace element_hypoelastic_j2 {

using namespace element_check;
using Material = HypoelasticJ2<LinearHardening>;
const std::vector<std::vector<U>> paths{{displacement(1)}, {displacement(0.2), displacement(-0.3), displacement(0.9)}};

TEST_CASE("elements of hypoelastic J2 in flow have exact tangents") {
  const Material material{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 30, .modulus = 260}};
  for (const auto& path : paths) {
    CHECK(flows<MeanDilatation<Quad4>>(material, path));
    CHECK(flows<FullyIntegrated<Quad4>>(material, path));
  }
  check_all(material, paths);
}

TEST_CASE("elastic elements of hypoelastic J2 have exact tangents that are not symmetric") {
  const Material hard{.young = 69e3, .poisson = 0.33, .hardening = {.yield = 1e6, .modulus = 260}};
  CHECK_FALSE(flows<MeanDilatation<Quad4>>(hard, paths[1]));
  check_all(hard, paths);
  const verify::SingleElement<MeanDilatation<Quad4>, PlaneStrain, Material> element{.material = hard, .X = distorted()};
  CHECK(verify::element_tangent(element, paths[1]).asymmetry > 1e-3);
}

}  // namespace element_hypoelastic_j2
