// SPDX-License-Identifier: BSL-1.0
// Lists of members: complete, packed without padding, and read back; a value that differs in padding alone is the same.
#include <stickslip/base/archive.hpp>
#include <stickslip/contact/node_kernel.hpp>
#include <stickslip/enforcement/augmented_lagrangian.hpp>
#include <stickslip/enforcement/penalty.hpp>
#include <stickslip/friction/coulomb.hpp>
#include <stickslip/friction/frictionless.hpp>
#include <stickslip/friction/tresca.hpp>
#include <stickslip/material/finite_j2.hpp>
#include <stickslip/material/hardening.hpp>
#include <stickslip/material/hypoelastic_j2.hpp>
#include <stickslip/verify/energy.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

using namespace stickslip;

namespace {

// What is kept or compared lists all its members.
static_assert(lists_all_members<StepReport>());
static_assert(lists_all_members<RunReport>());
static_assert(lists_all_members<WorkCounts>());
static_assert(lists_all_members<Timings>());
static_assert(lists_all_members<ErrorEstimates>());
static_assert(lists_all_members<ContactSummary>());
static_assert(lists_all_members<ContactNodeState<2>>() && lists_all_members<ContactNodeState<3>>());
static_assert(lists_all_members<Energies>());
static_assert(lists_all_members<FiniteJ2<LinearHardening>::State<Real, Planar>>());
static_assert(lists_all_members<FiniteJ2<LinearHardening>::State<Real, Spatial>>());
static_assert(lists_all_members<HypoelasticJ2<LinearHardening>::State<Real, Planar>>());
static_assert(lists_all_members<HypoelasticJ2<LinearHardening>::State<Real, Spatial>>());
static_assert(lists_all_members<LastConverged::Memory<Real>>());
static_assert(lists_all_members<Extrapolated::Memory<Real>>());
static_assert(lists_all_members<AugmentedLagrangian::Memory<Real>>());
template <class Enforcement, class Friction>
constexpr bool remembers_all = lists_all_members<NodeMemory<Real, 2, Enforcement, Friction>>() &&
                               lists_all_members<NodeMemory<Real, 3, Enforcement, Friction>>();
static_assert(remembers_all<Penalty, Frictionless> && remembers_all<AugmentedLagrangian, Frictionless>);
static_assert(remembers_all<Penalty, Coulomb> && remembers_all<AugmentedLagrangian, Coulomb>);
static_assert(remembers_all<Penalty, QuasiCoulomb> && remembers_all<AugmentedLagrangian, ExtrapolatedCoulomb>);
static_assert(remembers_all<Penalty, Tresca>);

// Lists with faults: a member left out where it takes bytes, and where it takes the padding of another; one that is
// listed twice; one that is empty.
struct Sound {
  Vec<Real, 2> force = Vec<Real, 2>::Zero();
  std::array<float, 3> weights{};
  bool touching = false, sliding = false;
  Index count = 0;

  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("force", self.force);
    visit("weights", self.weights);
    visit("touching", self.touching);
    visit("sliding", self.sliding);
    visit("count", self.count);
  }
};
struct LeavesOutALarge {
  Real gap = 0, pressure = 0;
  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("gap", self.gap);
  }
};
struct LeavesOutASmall {
  Real gap = 0;
  bool touching = false, sliding = false;
  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("gap", self.gap);
    visit("touching", self.touching);
  }
};
struct ListsTwice {
  Real gap = 0;
  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("gap", self.gap);
    visit("again", self.gap);
  }
};
struct Holds {
  std::array<LeavesOutASmall, 2> inner{};
  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("inner", self.inner);
  }
};
struct NoAggregate {
  explicit NoAggregate(Real x) : x_(x) {}
  template <class Self, class Visit>
  static constexpr void members(Self& self, Visit&& visit) {
    visit("x", self.x_);
  }
  Real y() const { return y_; }

 private:
  Real x_, y_ = 0;
};
static_assert(lists_all_members<Sound>());
static_assert(!lists_all_members<LeavesOutALarge>());
static_assert(!lists_all_members<LeavesOutASmall>());
static_assert(!lists_all_members<ListsTwice>());
static_assert(!lists_all_members<Holds>());
static_assert(!lists_all_members<NoAggregate>());
static_assert(sizeof(Sound) == 48 && detail::packed_size<Sound>() == 34);

// A value in memory whose padding is full of `byte`.
template <class T>
T& made_in(std::vector<char>& room, char byte, const T& value) {
  room.assign(sizeof(T) + alignof(T), byte);
  void* at = room.data();
  std::size_t size = room.size();
  T* made = new (std::align(alignof(T), sizeof(T), at, size)) T;
  T::members(*made, [&](const char* name, auto& member) {
    T::members(value, [&](const char* other, const auto& of) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(of)>, std::remove_cvref_t<decltype(member)>>)
        if (std::strcmp(name, other) == 0) member = of;
    });
  });
  return *made;
}

TEST_CASE("a layout names the members and their types") {
  CHECK(layout<Real>() == "f8");
  CHECK(layout<std::array<Vec<Real, 3>, 2>>() == "2 3 f8");
  CHECK(layout<Sound>() == "(force 2 f8, weights 3 f4, touching b1, sliding b1, count i4)");
  CHECK(layout<NodeMemory<Real, 2, Penalty, QuasiCoulomb>>() ==
        "(friction (traction 1 f8, surface_coordinate 1 f8, accumulated_slip f8, pressure (pressure f8)))");
}

TEST_CASE("values are kept and compared without their padding") {
  const Sound value{.force = {1, -2}, .weights = {3, 4, 5}, .touching = true, .count = 7};
  std::vector<char> room, other_room;
  Sound &a = made_in(room, '\x55', value), &b = made_in(other_room, '\x2a', value);
  CHECK(same_bits(a, b));
  CHECK(Archive([&] {
          Archive archive;
          archive("value", a);
          return archive;
        }())
            .sections[0]
            .bytes == packed(b));
  Digest one, two;
  one.add(&a, 1);
  two.add(&b, 1);
  CHECK(one.text() == two.text());
  b.sliding = true;
  CHECK(!same_bits(a, b));
  b = a;
  b.weights[2] = 6;
  CHECK(!same_bits(a, b));
  two = {};
  two.add(&b, 1);
  CHECK(one.text() != two.text());
}

struct Kept {
  std::vector<Sound> list;
  Real scale = 0;
  void serialize(Archive& archive) {
    archive("list", list);
    archive("scale", scale);
  }
};

TEST_CASE("structs come back from an archive as they were") {
  Kept kept{{{.force = {1, 2}, .count = 3}, {.weights = {4, 5, 6}, .sliding = true}}, 7};
  Archive archive = Archive::of(kept);
  REQUIRE(archive.sections.size() == 2);
  CHECK(archive.sections[0].size == 34);
  CHECK(archive.sections[0].count == 2);
  Kept back{std::vector<Sound>(2), 0};
  archive.restore(back);
  CHECK((same_bits(back.list[0], kept.list[0]) && same_bits(back.list[1], kept.list[1]) && back.scale == 7));
  // A byte of a file that is no bool is one afterwards.
  archive.sections[0].bytes[28] = 2;
  archive.restore(back);
  CHECK(back.list[0].touching);
  CHECK(packed(back.list[0])[28] == 1);
}

}  // namespace
