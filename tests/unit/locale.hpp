// SPDX-License-Identifier: BSL-1.0
// A global locale as it is in half of the world: decimal commas, and points between thousands.
#pragma once

#include <locale>
#include <string>

/// While it lives the global locale writes 1.681 and 0,5.
class WithCommas {
 public:
  WithCommas() : before_(std::locale::global(std::locale(std::locale::classic(), new Punctuation))) {}
  WithCommas(const WithCommas&) = delete;
  WithCommas& operator=(const WithCommas&) = delete;
  ~WithCommas() { std::locale::global(before_); }

 private:
  struct Punctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
    std::string do_truename() const override { return "wahr"; }
  };
  std::locale before_;
};
