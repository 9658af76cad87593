// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/members.hpp>
#include <stickslip/base/types.hpp>

#include <cxxabi.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace stickslip {

/// A part of a state under its name: `count` values of `size` bytes each, without gaps, of a `layout` as in
/// members.hpp.
struct Section {
  std::string name, layout{};
  std::uint64_t size = 0, count = 0;
  std::vector<char> bytes{};
};

class Archive;

namespace detail {
template <class T>
    struct Serializes : std::bool_constant < requires(T& value, Archive& archive) {
  value.serialize(archive);
} > {};
template <class T, std::size_t n>
struct Serializes<std::array<T, n>> : Serializes<T> {};
}  // namespace detail

/// A state in memory, as a list of named sections: what io/checkpoint.hpp writes to a file. What can be archived has a
/// member `void serialize(Archive& archive)` that calls the archive on every part of its state, by name and in one
/// order; the same function is used to take a state, to compare its sections with those of the object that it is to be
/// restored into, and to give it to that. docs/checkpoints.md.
class Archive {
 public:
  /// The state of the parts, one after another.
  template <class... Parts>
  static Archive of(Parts&... parts) {
    Archive archive;
    (parts.serialize(archive), ...);
    return archive;
  }

  /// Gives the state to parts like those that it was taken of. Throws std::runtime_error, one sentence that begins with
  /// the `origin`, where they are not alike; the parts are then as they were.
  template <class... Parts>
  void restore(Parts&... parts) {
    for (const Mode mode : {Mode::comparing, Mode::giving}) {
      mode_ = mode;
      next_ = 0;
      (parts.serialize(*this), ...);
      if (next_ < sections.size()) fail("has \"" + shown(sections[next_].name) + "\", which this run has not");
    }
    mode_ = Mode::taking;
  }

  /// Whether `serialize` is being called to give the object its state, so that what depends on it must follow.
  bool loading() const { return mode_ == Mode::giving; }

  /// A value, or a list of a length that the object knows: of numbers, of structs that list their members, or of what
  /// has a `serialize` itself.
  template <class T>
  void operator()(std::string_view name, T& value) {
    if constexpr (std::same_as<T, Field>)
      exchange_list(name, value.data(), static_cast<std::size_t>(value.size()));
    else
      exchange_list(name, &value, 1);
  }
  template <class T>
  void operator()(std::string_view name, std::vector<T>& list) {
    exchange_list(name, list.data(), list.size());
  }
  /// A list that may have another length than the object's has now.
  template <class T>
  void resizable(std::string_view name, std::vector<T>& list) {
    static_assert(!std::is_same_v<T, bool> && !std::is_empty_v<T>);
    if (mode_ != Mode::taking) {
      const Section& section = expected(name, layout<T>(), detail::packed_size<T>());
      if (mode_ == Mode::comparing) {
        ++next_;
        return;
      }
      list.resize(static_cast<std::size_t>(section.count));
    }
    exchange_list(name, list.data(), list.size());
  }
  /// What must be the same in both, or else the state is of something else.
  [[gnu::cold]] void check_equal(std::string_view name, std::string text) {
    if (mode_ == Mode::taking) return exchange_list(name, text.data(), text.size());
    const Section& section = expected(name, layout<char>(), 1);
    const std::string_view there(section.bytes.data(), section.bytes.size());
    if (there != text)
      fail("its " + std::string(name) + " is \"" + shown(there) + "\", here it is \"" + shown(text) + "\"");
    ++next_;
  }

  std::vector<Section> sections{};
  std::string origin = "the archive";  ///< where it comes from, for complaints: the name of a file

 private:
  enum class Mode { taking, comparing, giving };

  // What a file has, as a sentence may quote it: on one line, and not for ever.
  static std::string shown(std::string_view bytes) {
    constexpr std::size_t longest = 300;
    std::string text(bytes.substr(0, longest));
    for (char& c : text)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    return bytes.size() > longest ? text + "..." : text;
  }
  [[noreturn]] void fail(const std::string& what) {
    mode_ = Mode::taking;
    throw std::runtime_error(origin + " does not fit: " + what);
  }
  // Where two layouts part, from the member on that is not the same.
  static std::pair<std::string, std::string> first_difference(std::string_view there, std::string_view here) {
    const auto [a, b] = std::mismatch(there.begin(), there.end(), here.begin(), here.end());
    const std::string_view common = there.substr(0, static_cast<std::size_t>(a - there.begin()));
    const std::size_t begin = common.find_last_of("(,") == std::string_view::npos ? 0 : common.find_last_of("(,") + 1;
    const auto part = [&](std::string_view text) {
      constexpr std::size_t longest = 60;
      text.remove_prefix(std::min(begin, text.size()));
      if (text.starts_with(' ')) text.remove_prefix(1);
      return shown(text.substr(0, longest)) + (text.size() > longest ? "..." : "");
    };
    return {part(there), part(here)};
  }
  [[gnu::cold]] const Section& expected(std::string_view name, std::string_view layout, std::size_t size) {
    if (next_ == sections.size()) fail("it lacks \"" + std::string(name) + "\"");
    const Section& section = sections[next_];
    if (section.name != name)
      fail("it has \"" + shown(section.name) + "\" where this run has \"" + std::string(name) + "\"");
    if (section.layout != layout) {
      const auto [there, here] = first_difference(section.layout, layout);
      fail("its \"" + std::string(name) + "\" has values of other members or types, \"" + there +
           "\" where this run's have \"" + here + "\"");
    }
    if (section.size != size || section.bytes.size() / size != section.count || section.bytes.size() % size != 0)
      fail("its \"" + std::string(name) + "\" is of values of " + std::to_string(section.size) +
           " bytes, this run's of " + std::to_string(size));
    return section;
  }

  template <class T>
  void exchange_list(std::string_view name, T* values, std::size_t count) {
    if constexpr (detail::Serializes<T>::value) {
      for (std::size_t k = 0; k < count; ++k) serialize_each(values[k]);
    } else if constexpr (std::is_empty_v<T>) {
      // There is nothing to keep, not even a section.
    } else if constexpr (detail::is_gapless<T>()) {
      exchange(name, layout<T>(), values, count, sizeof(T));
    } else {
      static_assert(detail::lists_are_complete<T>(),
                    "stickslip: members() of a struct that is kept leaves a member out or lists one twice; see "
                    "docs/checkpoints.md.");
      std::vector<char> bytes(count * detail::packed_size<T>());
      char* to = bytes.data();
      if (mode_ == Mode::taking)
        for (std::size_t k = 0; k < count; ++k) detail::pack(values[k], to);
      exchange(name, layout<T>(), bytes.data(), count, detail::packed_size<T>());
      const char* from = bytes.data();
      if (mode_ == Mode::giving)
        for (std::size_t k = 0; k < count; ++k) detail::unpack(values[k], from);
    }
  }
  template <class T>
  void serialize_each(T& value) {
    value.serialize(*this);
  }
  template <class T, std::size_t n>
  void serialize_each(std::array<T, n>& values) {
    for (T& value : values) serialize_each(value);
  }

  [[gnu::noinline]] void exchange(std::string_view name, const std::string& layout, void* data, std::size_t count,
                                  std::size_t size) {
    if (mode_ == Mode::taking) {
      const char* bytes = static_cast<const char*>(data);
      sections.push_back({std::string(name), layout, size, count, std::vector<char>(bytes, bytes + count * size)});
      return;
    }
    const Section& section = expected(name, layout, size);
    if (section.count != count)
      fail("its \"" + std::string(name) + "\" has " + std::to_string(section.count) + " values, this run's " +
           std::to_string(count));
    if (mode_ == Mode::giving && count > 0) std::memcpy(data, section.bytes.data(), section.bytes.size());
    ++next_;
  }

  Mode mode_ = Mode::taking;
  std::size_t next_ = 0;
};

/// A number in as many digits as tell it from all others.
inline std::string round_trip(Real x) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof(digits), x).ptr};
}

/// What a type is called, for people and for comparison.
template <class T>
std::string type_name() {
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(typeid(T).name(), nullptr, nullptr, nullptr),
                                                    std::free);
  return name ? name.get() : typeid(T).name();
}

/// A number by which to tell whether two sets of values are the same, to all likelihood (FNV-1a, 64 bits).
class Digest {
 public:
  /// Takes values: numbers, lists of fixed length, and structs that list their members.
  template <class T>
  void add(const T* values, std::size_t count) {
    if constexpr (detail::is_gapless<T>())
      add_bytes(reinterpret_cast<const char*>(values), count * sizeof(T));
    else
      for (std::size_t k = 0; k < count; ++k) {
        const std::vector<char> bytes = packed(values[k]);
        add_bytes(bytes.data(), bytes.size());
      }
  }
  /// In sixteen hexadecimal digits.
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(value_));
    return digits;
  }

 private:
  void add_bytes(const char* bytes, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) value_ = (value_ ^ static_cast<unsigned char>(bytes[k])) * 0x100000001b3;
  }
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace stickslip
