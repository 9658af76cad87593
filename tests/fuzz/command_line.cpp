// SPDX-License-Identifier: BSL-1.0
// The examples' command line, an argument a line. What is taken lies in its range; what is refused is refused by
// BadOption, in a sentence.
#include <cmath>
#include <iostream>
#include <vector>

#include "common/options.hpp"
#include "target.hpp"

namespace {

bool among(const std::string& name, const std::vector<std::string>& names) {
  for (const auto& n : names)
    if (n == name) return true;
  return false;
}

void parse(std::vector<std::string> words) {
  static const examples::Program program{
      .name = "program",
      .title = "all kinds of options",
      .frictions = {"coulomb", "quasi-coulomb", "frictionless"},
      .solvers = {"banded", "eigen-ldlt"},
      .mu = 0.15,
      .parameters = {{.name = "travel", .about = "punch travel in mm", .value = 40, .low = 1, .high = 500},
                     {.name = "kind", .about = "of two", .names = {"one", "other"}}}};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const auto within = [](double x, double low, double high) {
    fuzz::require(x >= low && x <= high, "numbers lie in their range");
  };
  try {
    const auto o = examples::parse(static_cast<int>(words.size()), arguments.data(), program);
    if (!o) return;
    fuzz::require(among(o->friction, program.frictions) && among(o->solver, program.solvers), "names are known");
    within(o->mu, 0, 10);
    fuzz::require(o->mu == 0 || o->friction != "frictionless", "no friction, no coefficient");
    within(o->refine, 1, 1000);
    within(o->steps, 0, 10'000'000);
    within(o->tolerance, 1e-14, 0.1);
    within(o->parameters.at("travel"), 1, 500);
    fuzz::require(o->parameters.at("kind") == 0 || o->parameters.at("kind") == 1, "names are known");
  } catch (const examples::BadOption& error) {
    fuzz::require_sentence(error.what());
  } catch (const std::exception& error) {
    fuzz::broken(std::string("an error of another kind: ") + error.what());
  }
}

// --help writes to the standard output.
struct Silence {
  std::streambuf* before = std::cout.rdbuf(nullptr);
  Silence() = default;
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() {
    std::cout.rdbuf(before);
    std::cout.clear();
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words{"program"};
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string word; std::getline(in, word);) words.push_back(word.substr(0, word.find('\0')));
  const Silence silence;
  parse(std::move(words));
  return 0;
}
