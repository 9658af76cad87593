// SPDX-License-Identifier: BSL-1.0
#include <stickslip/base/archive.hpp>

struct Memory {
  double pressure = 0;
  bool touched = false, slid = false;

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("pressure", self.pressure);
    visit("touched", self.touched);
#ifdef CONTROL
    visit("slid", self.slid);
#endif
  }
};

void keep(stickslip::Archive& archive, std::vector<Memory>& nodes) {
  archive("nodes", nodes);
}
