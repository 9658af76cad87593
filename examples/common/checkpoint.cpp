// SPDX-License-Identifier: BSL-1.0
#include "checkpoint.hpp"

#include <stickslip/io/checkpoint.hpp>

#include <csignal>
#include <iostream>

namespace examples {

namespace {

volatile std::sig_atomic_t stop_signal = 0;

extern "C" void note_signal(int signal) {
  stop_signal = signal;
}

}  // namespace

Checkpoints::Checkpoints(const Options& options) : options_(options) {
  if (!kept()) return;
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);  // what is being written is written to its end
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup means it
  }
}

bool Checkpoints::due(int step) const {
  return kept() && step % options_.checkpoint_every == 0;
}

bool Checkpoints::stop() const {
  return kept() && stop_signal != 0;
}

void Checkpoints::write(const stickslip::Archive& state) const {
  stickslip::io::write_checkpoint(options_.checkpoint, state);
}

stickslip::Archive read_restart(const Options& options) {
  return stickslip::io::read_checkpoint(options.restart);
}

int conclude_stopped(const Options& options, const std::string& program, int step, bool kept) {
  if (!kept) {
    std::cerr << program << ": stopped by signal " << stop_signal << " after step " << step
              << "; the state could not be kept\n";
    return 1;
  }
  std::cerr << program << ": stopped by signal " << stop_signal << " after step " << step << "; --restart "
            << options.checkpoint.string() << " continues from there\n";
  return stopped_by_signal;
}

void require_same(stickslip::Archive& archive, const Options& options) {
  using stickslip::round_trip;
  archive.check_equal("friction law", options.friction);
  archive.check_equal("linear solver", options.solver);
  archive.check_equal("mu", round_trip(options.mu));
  archive.check_equal("refinement", std::to_string(options.refine));
  archive.check_equal("tolerance", round_trip(options.tolerance));
  archive.check_equal("lag tolerance", round_trip(options.lag_tolerance));
  archive.check_equal("step tolerance", round_trip(options.step_tolerance));
  archive.check_equal("interval of the mesh's error", std::to_string(options.mesh_error_interval));
  for (const auto& [name, value] : options.parameters) archive.check_equal(name, round_trip(value));
  archive.check_equal("output", options.output.empty() ? "none" : "a folder");
}

}  // namespace examples
