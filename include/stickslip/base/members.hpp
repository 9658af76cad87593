// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// Lists of members: the one place where a struct says what it consists of. Restart files, comparisons and digests read
/// it, so that none of them sees the padding between members.
namespace stickslip {

namespace detail {
struct IgnoreMember {
  template <class M>
  constexpr void operator()(const char*, M&) const {}
};
}  // namespace detail

/// A struct with a list of its members: calls visit(name, member) for each, in the order of their declaration.
///
///     template <class Self, class Visit>
///     static constexpr void members(Self& self, Visit&& visit) {
///       visit("gap", self.gap);
///       visit("pressure", self.pressure);
///     }
template <class T>
concept ListsMembers = requires(T& value, const T& constant) {
  T::members(value, detail::IgnoreMember{});
  T::members(constant, detail::IgnoreMember{});
};

namespace detail {

template <class T>
inline constexpr bool is_number =
    std::is_integral_v<T> || std::is_enum_v<T> || std::same_as<T, float> || std::same_as<T, double>;

// Lists of fixed length: std::array, and Eigen's matrices of numbers.
template <class T>
struct FixedList : std::false_type {};
template <class E, std::size_t n>
struct FixedList<std::array<E, n>> : std::true_type {
  using Element = E;
  static constexpr std::size_t size = n;
};
template <class T>
  requires(std::derived_from<T, Eigen::PlainObjectBase<T>>&& T::SizeAtCompileTime > 0 && is_number<typename T::Scalar>)
struct FixedList<T> : std::true_type {
  using Element = typename T::Scalar;
  static constexpr std::size_t size = static_cast<std::size_t>(T::SizeAtCompileTime);
};

// Whether the bytes of a value are its numbers and nothing else, and all bytes are valid ones.
template <class T>
constexpr bool is_gapless() {
  if constexpr (FixedList<T>::value)
    return is_gapless<typename FixedList<T>::Element>() &&
           sizeof(T) == FixedList<T>::size * sizeof(typename FixedList<T>::Element);
  else
    return is_number<T> && !std::same_as<T, bool>;
}

// An object that is never made: its members have types and sizes, and no values.
template <class T>
union Unmade {
  constexpr Unmade() : none{} {}
  char none;
  T value;
};
template <class T>
inline constinit Unmade<T> unmade{};

// Bytes of the numbers of a value.
template <class T>
constexpr std::size_t packed_size() {
  if constexpr (is_number<T>) {
    return sizeof(T);
  } else if constexpr (FixedList<T>::value) {
    return FixedList<T>::size * packed_size<typename FixedList<T>::Element>();
  } else if constexpr (std::is_empty_v<T>) {
    return 0;
  } else {
    static_assert(
        ListsMembers<T>,
        "stickslip: a struct is kept and compared by a list of its members, for its bytes may have gaps; give "
        "it template <class Self, class Visit> static constexpr void members(Self& self, Visit&& visit) with "
        "visit(\"x\", self.x) for each member x, or void serialize(Archive&) where it owns memory; see "
        "docs/checkpoints.md.");
    std::size_t sum = 0;
    if constexpr (ListsMembers<T>)
      T::members(unmade<T>.value, [&]<class M>(const char*, M&) { sum += packed_size<M>(); });
    return sum;
  }
}

template <class T>
constexpr std::size_t member_count() {
  std::size_t count = 0;
  T::members(unmade<T>.value, [&]<class M>(const char*, M&) { ++count; });
  return count;
}
struct Anything {
  template <class M>
  constexpr operator M() const;
};
// Whether an aggregate has so many members, or more.
template <class T, std::size_t... k>
constexpr bool has_members(std::index_sequence<k...>) {
  return requires {
    T{(static_cast<void>(k), Anything{})...};
  };
}

// Whether all lists that a value has are complete.
template <class T>
constexpr bool lists_are_complete();

}  // namespace detail

/// Whether the list of a struct is complete: as many members as an aggregate has, of sizes that leave no bytes over but
/// those of alignment. A member that is added and not listed makes it false.
template <ListsMembers T>
constexpr bool lists_all_members() {
  const auto aligned = [](std::size_t at, std::size_t alignment) {
    return (at + alignment - 1) / alignment * alignment;
  };
  std::size_t end = 0;
  bool all = true;
  T::members(detail::unmade<T>.value, [&]<class M>(const char*, M&) {
    all = all && detail::lists_are_complete<M>();
    if constexpr (!std::is_empty_v<M>) end = aligned(end, alignof(M)) + sizeof(M);
  });
  // Members that share the padding at the end of others make a struct smaller than that.
  all = all && sizeof(T) <= std::max(aligned(end, alignof(T)), alignof(T)) && detail::packed_size<T>() <= sizeof(T);
  if constexpr (std::is_aggregate_v<T>) {
    constexpr std::size_t count = detail::member_count<T>();
    all = all && detail::has_members<T>(std::make_index_sequence<count>{}) &&
          !detail::has_members<T>(std::make_index_sequence<count + 1>{});
  }
  return all;
}

template <class T>
constexpr bool detail::lists_are_complete() {
  if constexpr (FixedList<T>::value)
    return lists_are_complete<typename FixedList<T>::Element>();
  else if constexpr (ListsMembers<T>)
    return lists_all_members<T>();
  else
    return true;
}

namespace detail {
// A layout as it is written; its functions are those of all types.
struct LayoutText {
  std::string text{};
  [[gnu::noinline]] void add_number(char kind, std::size_t size) { text += kind + std::to_string(size); }
  [[gnu::noinline]] void add_length(std::size_t length) { text += std::to_string(length) + " "; }
  [[gnu::noinline]] void add_name(const char* name) { (text.back() == '(' ? text : text += ", ").append(name) += ' '; }
};
template <class T>
void add_layout(LayoutText& text) {
  if constexpr (std::is_enum_v<T>) {
    add_layout<std::underlying_type_t<T>>(text);
  } else if constexpr (is_number<T>) {
    constexpr char kind = std::same_as<T, bool>         ? 'b'
                          : std::same_as<T, char>       ? 'c'
                          : std::is_floating_point_v<T> ? 'f'
                          : std::is_signed_v<T>         ? 'i'
                                                        : 'u';
    text.add_number(kind, sizeof(T));
  } else if constexpr (FixedList<T>::value) {
    text.add_length(FixedList<T>::size);
    add_layout<typename FixedList<T>::Element>(text);
  } else {
    text.text += '(';
    if constexpr (ListsMembers<T>)
      T::members(unmade<T>.value, [&]<class M>(const char* name, M&) {
        if constexpr (!std::is_empty_v<M>) {
          text.add_name(name);
          add_layout<M>(text);
        }
      });
    text.text += ')';
  }
}
}  // namespace detail

/// Names and types of what a value consists of: numbers as f8, i4, u8, b1 or c1, lists with their length in front,
/// structs in parentheses: (gap f8, force 2 f8, touching b1).
template <class T>
std::string layout() {
  detail::LayoutText text;
  detail::add_layout<T>(text);
  return text.text;
}

namespace detail {

// Copies the numbers of a value to the bytes at `to`, which goes on behind them.
template <class T>
void pack(const T& value, char*& to) {
  if constexpr (is_number<T>) {
    std::memcpy(to, &value, sizeof(T));
    to += sizeof(T);
  } else if constexpr (FixedList<T>::value) {
    for (std::size_t k = 0; k < FixedList<T>::size; ++k) pack(value.data()[k], to);
  } else if constexpr (ListsMembers<T>) {
    T::members(value, [&](const char*, const auto& member) { pack(member, to); });
  }
}
// The reverse.
template <class T>
void unpack(T& value, const char*& from) {
  if constexpr (std::same_as<T, bool>) {
    value = *from++ != 0;
  } else if constexpr (is_number<T>) {
    std::memcpy(&value, from, sizeof(T));
    from += sizeof(T);
  } else if constexpr (FixedList<T>::value) {
    for (std::size_t k = 0; k < FixedList<T>::size; ++k) unpack(value.data()[k], from);
  } else if constexpr (ListsMembers<T>) {
    T::members(value, [&](const char*, auto& member) { unpack(member, from); });
  }
}

}  // namespace detail

/// The bytes of a value, member after member.
template <class T>
std::vector<char> packed(const T& value) {
  std::vector<char> bytes(detail::packed_size<T>());
  char* to = bytes.data();
  detail::pack(value, to);
  return bytes;
}
/// Whether all members of two values have the same bits.
template <class T>
bool same_bits(const T& a, const T& b) {
  return packed(a) == packed(b);
}

}  // namespace stickslip
