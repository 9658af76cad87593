// SPDX-License-Identifier: BSL-1.0
// What the targets share. A target is one function of the bytes of an input; it comes back if the reader kept its word,
// whether it took the input or refused it, and ends the process if not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fuzz {

/// The end of a run: a reader broke its word. Fuzzers see an abort.
[[noreturn]] inline void broken(const std::string& word) {
  std::fprintf(stderr, "broken word: %s\n", word.c_str());
  std::abort();
}
inline void require(bool kept, const std::string& word) {
  if (!kept) broken(word);
}

/// One sentence: not empty, on one line, and of characters that a terminal can show.
inline void require_sentence(const std::string& text) {
  require(!text.empty() && text.size() < 1000, "a complaint is a sentence: " + text);
  for (const char c : text)
    require(static_cast<unsigned char>(c) >= ' ' && c != '\x7f', "a complaint can be shown: " + text);
}

/// Hands `bytes` to a reader of files, read(stream, name), and what comes of it to use(result). A refusal must be an
/// `Error` that begins with the name of the file and is a sentence.
template <class Error, class Read, class Use>
void reader(std::string_view bytes, const std::string& name, Read&& read, Use&& use) {
  std::istringstream in{std::string(bytes)};
  decltype(read(in, name)) result;
  try {
    result = read(in, name);
  } catch (const Error& error) {
    const std::string text = error.what();
    require_sentence(text);
    require(text.starts_with(name), "a complaint begins with the name of the file: " + text);
    return;
  } catch (const std::exception& error) {
    broken(std::string("an error of another kind: ") + error.what());
  }
  use(result);
}

}  // namespace fuzz
