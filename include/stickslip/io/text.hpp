// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/types.hpp>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <istream>
#include <locale>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

/// Common parts of the readers. Readers trust no count in a file: memory grows with the bytes read, never with a
/// claimed count.
namespace stickslip::io::detail {

/// All bytes of a stream. Throws std::runtime_error, naming the stream and, if known, the reason.
inline std::string read_all(std::istream& in, const std::string& name) {
  std::string bytes;
  std::array<char, 1 << 12> block{};
  errno = 0;
  while (in.read(block.data(), block.size()), in.gcount() > 0)
    bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
  if (in.bad() || !in.eof())
    throw std::runtime_error("cannot read " + name + (errno != 0 ? ": " + std::generic_category().message(errno) : ""));
  return bytes;
}

/// All bytes of a regular file; a device or a pipe might never end. Throws std::runtime_error, naming file and reason.
inline std::string read_all(const std::filesystem::path& path) {
  const auto refuse = [&](const std::string& why) {
    throw std::runtime_error("cannot read " + path.string() + ": " + why);
  };
  std::error_code error;
  const bool regular = std::filesystem::is_regular_file(path, error);
  if (error) refuse(error.message());
  if (!regular) refuse("it is no regular file");
  std::ifstream in;
  in.imbue(std::locale::classic());  // without conversion of bytes
  errno = 0;
  in.open(path, std::ios::binary);
  if (!in.is_open()) refuse(std::generic_category().message(errno));
  return read_all(in, path.string());
}

/// The bytes without a leading byte order mark of UTF-8.
inline std::string_view without_mark(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  return bytes;
}

/// Bytes of a file as quoted in a message: cut to length, with ? for bytes that are not printable.
inline std::string shown(std::string_view bytes, std::size_t longest = 20) {
  std::string text(bytes.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return bytes.size() > longest ? text + "..." : text;
}

/// Reader of a text that counts lines; messages give the name of the text and the line.
class Text {
 public:
  Text(std::string name, std::string_view text) : name_(std::move(name)), text_(text) {}

  std::size_t line() const { return line_; }

  [[noreturn]] void fail(const std::string& what) const { fail(line_, what); }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw std::runtime_error(name_ + ", line " + std::to_string(line) + ": " + what);
  }
  /// For a fault of the whole file.
  [[noreturn]] void fail_whole(const std::string& what) const { throw std::runtime_error(name_ + ": " + what); }
  /// Fails because `word`, empty at the end of the file, is not what was `wanted`.
  [[noreturn]] void unexpected(std::string_view word, const std::string& wanted) const {
    if (word.empty()) fail("the file ends where " + wanted + " should stand");
    fail("found \"" + shown(word) + "\" where " + wanted + " should stand");
  }

  /// `word` as a finite number.
  Real real(std::string_view word, const char* wanted = "a number") const {
    const char *first = word.data(), *last = first + word.size();
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') ++first;  // from_chars accepts no plus sign
    Real value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc::result_out_of_range) fail("the number \"" + shown(word) + "\" is out of range");
    if (error != std::errc() || end != last) unexpected(word, wanted);
    if (!std::isfinite(value)) fail("the number \"" + shown(word) + "\" is not finite");
    return value;
  }
  /// `word` as an integer from `low` to `high`.
  template <class Integer>
  Integer integer(std::string_view word, Integer low, Integer high, const char* wanted) const {
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::invalid_argument || end != word.data() + word.size()) unexpected(word, wanted);
    if (error == std::errc::result_out_of_range || value < low || value > high)
      fail("the number \"" + shown(word) + "\" is out of range");
    return value;
  }

  /// The next word; empty at the end of the file.
  std::string_view word() {
    skip_blanks();
    const std::size_t first = at_;
    while (at_ < text_.size() && !blank(text_[at_])) ++at_;
    return text_.substr(first, at_ - first);
  }
  /// The rest of the line, without its end-of-line characters.
  std::string_view rest_of_line() {
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    std::string_view rest = text_.substr(first, at_ - first);
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    return rest;
  }
  /// Moves to the beginning of the next line, at the first call of the first line; false at the end of the text.
  bool next_line() {
    if (begun_) {
      rest_of_line();
      if (at_ == text_.size()) return false;
      ++at_, ++line_;
    }
    begun_ = true;
    return at_ < text_.size();
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v'; }
  void skip_blanks() {
    for (; at_ < text_.size() && blank(text_[at_]); ++at_) line_ += text_[at_] == '\n';
  }

  std::string name_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool begun_ = false;
};

}  // namespace stickslip::io::detail
