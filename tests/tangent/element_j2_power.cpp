// SPDX-License-Identifier: BSL-1.0
#include "element_check.hpp"

#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>

namespace element_j2_power {

using namespace element_check;
using Material = FiniteJ2<PowerHardening>;
const Material material{
    .young = 69004, .poisson = 0.3, .hardening = {.strength = 589, .offset = 1e-4, .exponent = 0.216}};

TEST_CASE("elements of J2 with power hardening in flow have exact tangents") {
  const std::vector<std::vector<U>> plastic{{displacement(1)},
                                            {displacement(0.2), displacement(-0.3), displacement(0.9)}};
  for (const auto& path : plastic) {
    CHECK(flows<MeanDilatation<Quad4>>(material, path));
    CHECK(flows<FullyIntegrated<Quad4>>(material, path));
  }
  check_all(material, plastic);
}

TEST_CASE("elastic elements of J2 with power hardening have exact tangents") {
  const Material hard{
      .young = 69004, .poisson = 0.3, .hardening = {.strength = 1e7, .offset = 1e-4, .exponent = 0.216}};
  CHECK_FALSE(flows<MeanDilatation<Quad4>>(hard, {displacement(1)}));
  check_all(hard, {{displacement(1)}});
}

}  // namespace element_j2_power
