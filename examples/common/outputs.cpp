// SPDX-License-Identifier: BSL-1.0
#include "outputs.hpp"

#include <unistd.h>

#include <iostream>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace examples {

namespace io = stickslip::io;

Outputs::Outputs(const Options& options, std::string program)
    : program_(std::move(program)), on_line_(!options.quiet && isatty(STDERR_FILENO) != 0) {
  if (!options.output.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.output, error);
    if (error) throw std::runtime_error("cannot write " + options.output.string() + ": " + error.message());
    folder_.emplace(options.output / "stickslip.lock", options.output);
    io::remove_partials(options.output);
  }
  if (options.json == "-")
    check_standard_output();
  else if (!options.json.empty())
    io::check_writable(options.json, io::Target::any);
  if (!options.checkpoint.empty()) {
    auto lock = options.checkpoint;
    lock += ".lock";
    io::check_writable(options.checkpoint);
    checkpoint_.emplace(lock, options.checkpoint);
    io::remove_partials(options.checkpoint.parent_path(), options.checkpoint.filename());
  }
}

void Outputs::note(const std::string& what) {
  if (missing_.empty()) std::cerr << (on_line_ ? "\n" : "") << program_ << ": " << what << '\n';
  missing_.push_back(what);
}

}  // namespace examples
