// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <stickslip/base/archive.hpp>
#include <stickslip/base/types.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace stickslip {

/// What a run that goes on should be looked at for.
struct Warning {
  std::string name;  ///< the kind, in snake_case: `energy_gained`
  std::string text;  ///< one sentence with names and figures, of the first time
  Index step = 0;    ///< the first step concerned, from 1; 0: the scene itself
  Index count = 0;   ///< how often
};

/// The warnings of a run, in the order of their first times. A kind and what it concerns (a contact, say) is told once
/// and counted afterwards.
class Warnings {
 public:
  /// Tells a warning, or counts it if one of that name about `subject` has been told.
  void add(const std::string& name, const std::string& subject, const std::string& text, Index step) {
    for (std::size_t k = 0; k < list_.size(); ++k)
      if (list_[k].name == name && subjects_[k] == subject) {
        ++list_[k].count;
        return;
      }
    list_.push_back({name, text, step, 1});
    subjects_.push_back(subject);
  }
  const std::vector<Warning>& list() const { return list_; }

  void serialize(Archive& archive) {
    std::vector<char> words;
    std::vector<Times> times;
    for (std::size_t k = 0; k < list_.size(); ++k) {
      for (const std::string* word : {&list_[k].name, &list_[k].text, &subjects_[k]})
        words.insert(words.end(), word->c_str(), word->c_str() + word->size() + 1);
      times.push_back({list_[k].step, list_[k].count});
    }
    archive.resizable("run, warnings", words);
    archive.resizable("run, times of warnings", times);
    if (!archive.loading()) return;
    list_.clear();
    subjects_.clear();
    auto at = words.begin();
    const auto next = [&] {
      const auto end = std::find(at, words.end(), '\0');
      std::string word(at, end);
      at = end == words.end() ? end : end + 1;
      return word;
    };
    for (const Times& told : times) {
      std::string name = next(), text = next(), subject = next();
      list_.push_back({std::move(name), std::move(text), told.step, told.count});
      subjects_.push_back(std::move(subject));
    }
  }

 private:
  struct Times {
    Index step = 0, count = 0;

    template <class Self, class Visit>
    static constexpr void members(Self& self, Visit&& visit) {
      visit("step", self.step);
      visit("count", self.count);
    }
  };

  std::vector<Warning> list_;
  std::vector<std::string> subjects_;
};

}  // namespace stickslip
