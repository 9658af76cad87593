// SPDX-License-Identifier: BSL-1.0
// test_stability [--full] [--table FILE] [--only PART]: runs the hard cases, or those with PART in "group: name", a
// line each, and ends with their sums. The table goes into a file that has a place for it.
#include "suite.hpp"

#include <chrono>
#include <cstdio>
#include <exception>
#include <fstream>
#include <sstream>

namespace stability {

std::vector<Entry>& entries() {
  static std::vector<Entry> all;
  return all;
}

namespace {

const char* const marker = "<!-- what follows is written by ./check --stability -->";
const char* const head =
    "| group | case | model | outcome | steps / iterations / cut | worst balance | worst answer | asserted |\n"
    "|---|---|---|---|---|---|---|---|\n";

// Puts the text behind the marker of a file.
bool write(const std::string& path, const std::string& text) {
  std::stringstream before;
  before << std::ifstream(path).rdbuf();
  const auto place = before.str().find(marker);
  if (place == std::string::npos) return false;
  std::ofstream file(path);
  file << before.str().substr(0, place) << marker << "\n\n" << text;
  return bool(file);
}

}  // namespace
}  // namespace stability

int main(int argc, char** argv) {
  using namespace stability;
  bool full = false;
  std::string table, only;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--full")
      full = true;
    else if (option == "--table" && i + 1 < argc)
      table = argv[++i];
    else if (option == "--only" && i + 1 < argc)
      only = argv[++i];
    else {
      std::fprintf(stderr, "test_stability: \"%s\" is not an option, or lacks its value\n", option.c_str());
      return 2;
    }
  }

  std::vector<Entry> cases = entries();
  std::stable_sort(cases.begin(), cases.end(), [](const Entry& a, const Entry& b) { return a.group < b.group; });
  std::string rows;
  int converged = 0, refused = 0, wrong = 0;
  for (const Entry& entry : cases) {
    if (entry.form == Form::full && !full) continue;
    if ((entry.group + ": " + entry.name).find(only) == std::string::npos) continue;
    Case judged(entry.name);
    const auto begin = std::chrono::steady_clock::now();
    try {
      entry.run(judged);
    } catch (const std::exception& error) {
      judged.require(false, std::string("threw: ") + error.what());
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    (!judged.wrong().empty() ? wrong : judged.refused() ? refused : converged)++;
    std::printf("%s: %s | %s | %s | %d steps, %d iterations, %d cut | balance %s, answer %s | %s | %.1f s\n",
                entry.group.c_str(), entry.name.c_str(), entry.model.c_str(), judged.outcome().c_str(), judged.steps(),
                judged.iterations(), judged.rejected(), Case::number(judged.balance()).c_str(),
                Case::number(judged.worst()).c_str(), entry.asserted.c_str(), seconds);
    if (!judged.noted().empty()) std::printf("    %s\n", judged.noted().c_str());
    for (const std::string& claim : judged.wrong()) std::printf("    WRONG: %s\n", claim.c_str());
    std::fflush(stdout);
    rows += "| " + entry.group + " | " + entry.name + " | " + entry.model + " | " + judged.outcome() + " | " +
            std::to_string(judged.steps()) + " / " + std::to_string(judged.iterations()) + " / " +
            std::to_string(judged.rejected()) + " | " + Case::number(judged.balance()) + " | " +
            Case::number(judged.worst()) + " | " + entry.asserted +
            (judged.noted().empty() ? "" : "; " + judged.noted()) + " |\n";
  }
  const int tried = converged + refused + wrong;
  char sums[128];
  std::snprintf(sums, sizeof sums, "%d cases: %d converged, %d cleanly refused, %d wrong", tried, converged, refused,
                wrong);
  std::printf("%s\n", sums);
  if (!table.empty() && !write(table, std::string(sums) + ".\n\n" + head + rows)) {
    std::fprintf(stderr, "test_stability: cannot write the table into %s\n", table.c_str());
    return 2;
  }
  return wrong == 0 && tried > 0 ? 0 : 1;
}
