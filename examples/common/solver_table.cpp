// SPDX-License-Identifier: BSL-1.0
#include "solver_table.hpp"

#include <stickslip/io/new_file.hpp>

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>

// The shadow memory of AddressSanitizer takes more addresses than any limit leaves. GCC tells of it by a macro, Clang
// by a feature.
#ifdef __SANITIZE_ADDRESS__
#define ADDRESSES_CANNOT_BE_LIMITED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ADDRESSES_CANNOT_BE_LIMITED
#endif
#endif

namespace examples {

namespace {

std::string read_all(int from) {
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(from, buffer, sizeof(buffer))) > 0;) text.append(buffer, static_cast<std::size_t>(n));
  return text;
}

// What the process does that runs one solver. Nothing may leave it but through the exit code.
[[noreturn]] void work(const Options& options, double gigabytes, double seconds, int words,
                       const std::function<int(const Options&)>& run) {
  const auto bytes = static_cast<rlim_t>(gigabytes * 1073741824.0);
  const rlimit memory{bytes, bytes};
  setrlimit(RLIMIT_AS, &memory);
  dup2(words, STDERR_FILENO);
  alarm(static_cast<unsigned>(std::ceil(seconds)));
  int code = 1;
  try {
    code = run(options);
  } catch (const std::bad_alloc&) {
    std::cerr << "no memory is left";
  } catch (const std::exception& e) {
    std::cerr << e.what();
  }
  std::cout.flush();
  std::cerr.flush();
  _exit(code);
}

}  // namespace

int print_solver_table(const Options& options, const std::vector<std::string>& solvers, double gigabytes,
                       double seconds, const std::function<int(const Options&)>& run) {
#ifdef ADDRESSES_CANNOT_BE_LIMITED
  throw BadOption("--solver-table on limits the memory of its solvers, which AddressSanitizer does not let it");
#endif
  bool any = false, first = true;
  for (const std::string& solver : solvers) {
    int results[2], words[2];
    if (pipe(results) != 0 || pipe(words) != 0)
      throw std::runtime_error("cannot make a pipe: " + stickslip::io::detail::reason(errno));
    std::cout.flush();
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot start a process: " + stickslip::io::detail::reason(errno));
    if (child == 0) {
      Options o = options;
      o.solver = solver;
      o.quiet = true;
      o.output.clear();
      o.checkpoint.clear();
      o.restart.clear();
      o.json = "/dev/fd/" + std::to_string(results[1]);
      work(o, gigabytes, seconds, words[1], run);
    }
    close(results[1]);
    close(words[1]);
    // The results come at the end and in one piece, the words before them are few: neither fills its pipe unread.
    const std::string text = read_all(results[0]);
    std::string said = read_all(words[0]);
    close(results[0]);
    close(words[0]);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);

    const nlohmann::json r = nlohmann::json::parse(text, nullptr, false);
    const bool known = r.is_object() && r["iterations"].get<int>() > 0;
    if (known && first)
      std::printf(
          "%d unknowns, %s, seconds an iteration (the analysis of the pattern, made once, is in the factorisation)\n"
          "%-20s %10s %9s %9s %9s %10s %9s %9s\n",
          r["unknowns"].get<int>(), options.friction.c_str(), "solver", "iterations", "assembly", "contact", "factor",
          "solution", "sum", "peak GiB");
    if (known) {
      first = false;
      const double n = r["iterations"].get<int>();
      const auto each = [&](const char* what) { return r[what].get<double>() / n; };
      std::printf("%-20s %10.0f %9.4f %9.4f %9.4f %10.4f %9.4f %9.3f", solver.c_str(), n, each("seconds_assembly"),
                  each("seconds_contact"), each("seconds_factorization"), each("seconds_solve"), each("seconds_total"),
                  static_cast<double>(usage.ru_maxrss) / 1048576);
      any = any || r["completed"].get<bool>();
    } else {
      std::printf("%-20s", solver.c_str());
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
      std::printf("  not done in %g s", seconds);
    else if (WIFSIGNALED(status))
      std::printf("  ended by signal %d", WTERMSIG(status));
    else if (WEXITSTATUS(status) != 0)
      std::printf("  failed within %g GiB: %s", gigabytes, said.substr(0, said.find('\n')).c_str());
    std::printf("\n");
    std::fflush(stdout);
  }
  return any ? 0 : 1;
}

}  // namespace examples
