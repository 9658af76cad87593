// SPDX-License-Identifier: BSL-1.0
// Tables of flow curves. What is read makes a hardening law, positive and finite wherever it is asked.
#include <stickslip/io/flow_points.hpp>
#include <stickslip/material/tabulated_hardening.hpp>

#include <cmath>

#include "target.hpp"

using namespace stickslip;

namespace {

void use(const std::vector<FlowPoint>& points) {
  const TabulatedHardening law(points);  // takes what the reader takes
  law.validate();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Real here = points[k].strain, next = k + 1 < points.size() ? points[k + 1].strain : here + 1;
    for (const Real p : {here, 0.5 * here + 0.5 * next}) {
      const auto flow = law.flow(p);
      fuzz::require(flow.value > 0 && std::isfinite(flow.value), "flow stresses are positive and finite");
      fuzz::require(std::isfinite(flow.slope), "slopes are finite");
      fuzz::require(std::isfinite(law.work(p)), "work is finite");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  fuzz::reader<std::runtime_error>(
      bytes, "input.csv", [](std::istream& in, const std::string& name) { return io::read_flow_points(in, name); },
      use);
  return 0;
}
