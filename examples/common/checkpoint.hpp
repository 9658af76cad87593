// SPDX-License-Identifier: BSL-1.0
// Restart files of a benchmark's run, and the signals that end it. What needs Boost is compiled once, in the source.
#pragma once

#include "options.hpp"

#include <stickslip/base/archive.hpp>

namespace examples {

/// Exit code of a run that a signal has ended, with its state in the file of --checkpoint.
inline constexpr int stopped_by_signal = 3;

/// Watches for SIGTERM, SIGINT and SIGHUP, where they are not ignored, and keeps restart files, if the options ask for
/// that. A second signal ends the program at once.
class Checkpoints {
 public:
  explicit Checkpoints(const Options& options);

  /// Whether a file is to be written after this step, whatever comes.
  bool due(int step) const;
  /// Whether a signal has come.
  bool stop() const;
  void write(const stickslip::Archive& state) const;
  bool kept() const { return !options_.checkpoint.empty(); }

 private:
  const Options& options_;
};

/// The state that --restart names.
stickslip::Archive read_restart(const Options& options);

/// Says where a run that a signal ended has been left, if its state was `kept`. Returns the exit code.
int conclude_stopped(const Options& options, const std::string& program, int step, bool kept);

/// What a restarted run must have been asked for as well: everything that its results depend on.
void require_same(stickslip::Archive& archive, const Options& options);

}  // namespace examples
